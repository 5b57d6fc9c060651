#include "app/session/saved_world.hpp"

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <utility>

#include <nlohmann/json.hpp>

#include "app/runtime/output_file.hpp"
#include "vision/mapping/octree_codec.hpp"
#include "vision/relocalisation/codec.hpp"

namespace armsreach::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

// Opens `path` and reads it; nothing when there is no such file.
template <class T, class Read>
Result<std::optional<T>> read_if_there(const fs::path& path, Read read) {
  if (!fs::exists(path)) return std::optional<T>();
  std::ifstream in(path, std::ios::binary);
  if (!in || fs::is_directory(path)) {
    return Error{"cannot be read", path.string(), "check that it is a file and that it is yours"};
  }
  Result<T> value = read(in, path.string());
  if (!value) return value.error();
  return std::optional<T>(*std::move(value));
}

json json_from_object(const SavedObject& object) {
  const Eigen::Vector3d& t = object.world_from_object.translation();
  const Eigen::Quaterniond& q = object.world_from_object.rotation();
  return {{"id", object.id},
          {"object", object.mesh},
          {"world_from_object",
           {{"translation", {t.x(), t.y(), t.z()}}, {"rotation", {q.x(), q.y(), q.z(), q.w()}}}}};
}

SavedObject object_from_json(const json& from) {
  const json& pose = from.at("world_from_object");
  const auto t = pose.at("translation").get<std::array<double, 3>>();
  const auto q = pose.at("rotation").get<std::array<double, 4>>();
  const Eigen::Quaterniond rotation(q[3], q[0], q[1], q[2]);
  if (!(std::abs(rotation.norm() - 1) < 1e-3)) throw std::runtime_error("a rotation is not unit");
  return {from.at("id").get<std::int64_t>(), from.at("object").get<std::string>(),
          Pose(rotation.normalized(), {t[0], t[1], t[2]})};
}

Result<std::vector<SavedObject>> read_objects(std::istream& in, const std::string& where) {
  std::vector<SavedObject> objects;
  try {
    const json list = json::parse(in);
    if (!list.is_array()) throw std::runtime_error("it is no list");
    for (const json& object : list) objects.push_back(object_from_json(object));
  } catch (const std::exception& e) {
    return Error{"not a list of objects: " + std::string(e.what()), where,
                 "remove the file to enter the session without its objects"};
  }
  return objects;
}

fs::path partial_of(const fs::path& path) { return path.string() + ".part"; }

// Written beside and then moved into place: whatever happens, either the old or the new is there.
template <class Write>
Status replace_file(const fs::path& path, Write write) {
  const fs::path partial = partial_of(path);
  if (auto status = write_file(partial.string(), write); !status) return status;
  std::error_code error;
  fs::rename(partial, path, error);
  if (error) {
    return Error{"cannot be replaced: " + error.message(), path.string(),
                 "what was to be written is in " + partial.string()};
  }
  return ok();
}

Status make_folder(const fs::path& root) {
  std::error_code error;
  fs::create_directories(root, error);
  if (!error) return ok();
  return Error{error.message(), root.string(), "give --session a folder that is yours"};
}

Status save_objects(const fs::path& root, const std::vector<SavedObject>& objects) {
  json list = json::array();
  for (const SavedObject& object : objects) list.push_back(json_from_object(object));
  return replace_file(root / "objects.json",
                      [&](std::ostream& out) { out << list.dump(1) << "\n"; });
}

}  // namespace

Result<SavedWorld> load_map(const std::string& path, const mapping::VoxelMapOptions& options) {
  auto map =
      read_if_there<mapping::VoxelMap>(path, [&](std::istream& in, const std::string& where) {
        return mapping::read_octree(in, where, options);
      });
  if (!map) return map.error();
  SavedWorld world;
  if (*map && (*map)->grid().blocks.block_count() > 0) world.map = *std::move(map);
  return world;
}

Status save_map(const std::string& path, const mapping::VoxelGrid& grid) {
  return replace_file(path, [&](std::ostream& out) { mapping::write_octree(out, grid); });
}

Result<SavedWorld> load_session(const std::string& folder,
                                const mapping::VoxelMapOptions& options) {
  const fs::path root(folder);
  if (fs::exists(root) && !fs::is_directory(root)) {
    return Error{"is a file", folder, "give --session a folder"};
  }
  auto world = load_map((root / "map.ot").string(), options);
  if (!world) return world;
  auto sparse_map =
      read_if_there<mono_slam::SparseMap>(root / "sparse_map.bin", mono_slam::read_sparse_map);
  if (!sparse_map) return sparse_map.error();
  world->sparse_map = *std::move(sparse_map);
  if (world->map && world->sparse_map) {
    return Error{"the session has both a map.ot and a sparse_map.bin", folder,
                 "keep the one, and give the other a folder of its own"};
  }
  if (!world->map && !world->sparse_map) {
    if (!fs::exists(root / "key_frames.bin") && !fs::exists(root / "objects.json")) return world;
    return Error{"the session has lost its map.ot or sparse_map.bin", folder,
                 "put the map back, or give --session another folder"};
  }
  auto key_frames = read_if_there<relocalisation::KeyFrames>(root / "key_frames.bin",
                                                             relocalisation::read_key_frames);
  if (!key_frames) return key_frames.error();
  auto objects = read_if_there<std::vector<SavedObject>>(root / "objects.json", read_objects);
  if (!objects) return objects.error();
  world->key_frames = key_frames->value_or(relocalisation::KeyFrames());
  world->objects = objects->value_or(std::vector<SavedObject>());
  return world;
}

Status save_session(const std::string& folder, const mapping::VoxelGrid& grid,
                    const relocalisation::KeyFrames& key_frames,
                    const std::vector<SavedObject>& objects) {
  const fs::path root(folder);
  if (auto status = make_folder(root); !status) return status;
  for (const Status& status :
       {save_map((root / "map.ot").string(), grid),
        replace_file(root / "key_frames.bin",
                     [&](std::ostream& out) { relocalisation::write_key_frames(out, key_frames); }),
        save_objects(root, objects)}) {
    if (!status) return status;
  }
  return ok();
}

Status save_session(const std::string& folder, const mono_slam::SparseMap& map,
                    const std::vector<SavedObject>& objects) {
  const fs::path root(folder);
  if (auto status = make_folder(root); !status) return status;
  for (const Status& status :
       {replace_file(root / "sparse_map.bin",
                     [&](std::ostream& out) { mono_slam::write_sparse_map(out, map); }),
        save_objects(root, objects)}) {
    if (!status) return status;
  }
  return ok();
}

Status check_map_can_be_saved(const std::string& path) {
  const fs::path partial = partial_of(path);
  if (auto status = write_file(partial.string(), [](std::ostream&) {}); !status) {
    return Error{"cannot be written", path, "check that its folder exists and is yours"};
  }
  std::error_code ignored;
  fs::remove(partial, ignored);
  return ok();
}

Status check_session_can_be_saved(const std::string& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) return Error{error.message(), folder, "give --session a folder that is yours"};
  return check_map_can_be_saved((fs::path(folder) / "map.ot").string());
}

}  // namespace armsreach::app
