// Where along their rays the pixels of one depth image touch the map: tiles of about 80x60 an
// image, each with the interval of depths that its pixels' bands cover. Answers which blocks to
// visit and which of a block's voxels to look at.
#pragma once

#include <vector>

#include "vision/core/camera.hpp"
#include "vision/core/pose.hpp"
#include "vision/mapping/block.hpp"
#include "vision/mapping/depth_planes.hpp"
#include "vision/mapping/sensor_model.hpp"
#include "vision/mapping/update_block.hpp"

namespace armsreach::mapping {

class DepthBand {
 public:
  // `planes` and every length here are in voxel edges; `voxel` is one in metres.
  DepthBand(const DepthPlanes& planes, const Camera& camera, const SensorModel& sensor,
            double voxel);

  // Every block that meets a pixel's band inside that pixel's cone: sorted, each once, with a few
  // neighbours that only come close.
  std::vector<BlockKey> blocks(const Pose& world_from_camera) const;

  // Of the pixels that a sphere may cover: the union of their bands; and all that lies in front of
  // the farthest of them (empty for a sphere at the camera, which would cover everything).
  DepthInterval around(const Eigen::Vector3f& centre_in_camera, float radius) const;
  DepthInterval in_front(const Eigen::Vector3f& centre_in_camera, float radius) const;

 private:
  // Part of a square of pixels' cone.
  struct Cone {
    float u, v;    // px, its axis
    float pixels;  // its width
    DepthInterval depths;
  };

  DepthInterval pixel_interval(int u, int v) const;
  void add_tile(int column, int row);
  template <class F>
  void for_tiles(const Eigen::Vector3f& centre, float radius, F&& f) const;

  const DepthPlanes& planes_;
  Camera camera_;
  SensorModel sensor_;
  double voxel_;
  int tile_;  // px
  int columns_;
  int rows_;
  std::vector<DepthInterval> tiles_;
  std::vector<Cone> cones_;
};

}  // namespace armsreach::mapping
