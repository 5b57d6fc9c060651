// What a run leaves behind and a later one enters again: the dense map with the key frames that a
// lost camera is recognised by, or the sparse map of a plain camera, and the objects that stand in
// it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "vision/core/pose.hpp"
#include "vision/core/result.hpp"
#include "vision/mapping/voxel_map.hpp"
#include "vision/mono_slam/sparse_map.hpp"
#include "vision/relocalisation/relocaliser.hpp"

namespace armsreach::app {

struct SavedObject {
  std::int64_t id = 0;
  std::string mesh;
  Pose world_from_object;
};

struct SavedWorld {
  std::optional<mapping::VoxelMap> map;
  relocalisation::KeyFrames key_frames;
  std::optional<mono_slam::SparseMap> sparse_map;
  std::vector<SavedObject> objects;
};

// A map alone, OctoMap's .ot. A file that does not exist yet, or has nothing in it, is an empty
// world, not an error.
// `options` are for a map to go on with; the file's resolution replaces theirs.
Result<SavedWorld> load_map(const std::string& path, const mapping::VoxelMapOptions& options);
Status save_map(const std::string& path, const mapping::VoxelGrid& grid);

// A session: a folder with map.ot and key_frames.bin, or with sparse_map.bin, and objects.json.
// Without a map the others mean nothing, so they are refused rather than lost; so is a folder with
// both maps, which are of different worlds.
Result<SavedWorld> load_session(const std::string& folder, const mapping::VoxelMapOptions& options);
Status save_session(const std::string& folder, const mapping::VoxelGrid& grid,
                    const relocalisation::KeyFrames& key_frames,
                    const std::vector<SavedObject>& objects);
Status save_session(const std::string& folder, const mono_slam::SparseMap& map,
                    const std::vector<SavedObject>& objects);

// Whether those could be written, before a run whose map would otherwise be lost.
Status check_map_can_be_saved(const std::string& path);
Status check_session_can_be_saved(const std::string& folder);

}  // namespace armsreach::app
