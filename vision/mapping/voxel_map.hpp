// The dense map: occupancy, signed distance and intensity in voxels, grown frame by frame.
//
// Occupancy follows Damen et al. (see sensor_model.hpp) and decides what is surface; the signed
// distance beside it places that surface below the voxel. Poses are the pinhole camera's the images
// belong to.
#pragma once

#include <cstdint>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "vision/core/camera.hpp"
#include "vision/core/pose.hpp"
#include "vision/mapping/sensor_model.hpp"
#include "vision/mapping/voxel_grid.hpp"

namespace armsreach::mapping {

struct FrameEvidence;

struct VoxelMapOptions {
  double resolution = 0.01;  // edge of a voxel, m
  SensorModel sensor;
  double max_range = 8;           // m; measurements beyond say nothing
  double min_trust = 0.1;         // least weight of a pixel that may add surface
  double occupied_above = 0.51;   // probability
  double least_certain = 0.1192;  // clamps of the accumulated probability: OctoMap's, so that what
  double most_certain = 0.971;    // was carried away is forgotten within ten frames
  double max_weight = 5;          // frontal observations from 1 m that the distance remembers; more
                          // keeps early drift in the map that later frames are tracked against
  double intensity_rate = 0.1;  // least share a new intensity has in the mean
  // Every so many insertions also clear what the map still has in front of the band: things that
  // were carried away. 0: never.
  int carve_every = 2;
  // Memory bound: 4.2 kB a block; mapped surface takes about 2 MB a square metre at 1 cm. Beyond
  // it the regions that were seen longest ago are forgotten.
  std::size_t max_blocks = 40'000;
};

class VoxelMap {
 public:
  explicit VoxelMap(const VoxelMapOptions& options);

  // Depth (CV_32F metres along z, NaN unknown) and intensity (CV_32F 0..1, NaN unknown; may be
  // empty) of a pinhole camera. `trust` (CV_32F, may be empty): pixels below min_trust add no
  // surface, though what lies in front of them is still free; NaN was not judged and is trusted.
  void insert(const cv::Mat& depth, const cv::Mat& intensity, const cv::Mat& trust,
              const Camera& camera, const Pose& world_from_camera);

  const VoxelMapOptions& options() const { return options_; }
  const VoxelGrid& grid() const { return grid_; }

  // An immutable copy that shares its blocks with the map.
  VoxelGrid snapshot();
  // Blocks written or dropped since the last call; sorted.
  std::vector<BlockKey> take_changed();

  // For codecs: takes over a block as it was stored.
  void put(const BlockKey& key, const Block& block);

 private:
  void update(const std::vector<BlockKey>& keys, const FrameEvidence& frame,
              const Pose& camera_from_world);

  VoxelMapOptions options_;
  VoxelGrid grid_;
  HitTable hits_;
  std::int64_t insertions_ = 0;
  std::vector<BlockKey> changed_;
};

}  // namespace armsreach::mapping
