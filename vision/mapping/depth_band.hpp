// Where along their rays the pixels of one depth image touch the map: tiles of about 80x60 an
// image, each with the interval of depths that its pixels' bands cover. Answers which blocks to
// visit and which of a block's cubes to look at.
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

  // The tiles that the inner loop looks at, for its band or for what lies in front of it: each with
  // the depths of those beside it.
  struct Reach {
    std::vector<DepthInterval> tiles;
    int columns;
    int rows;
    DepthInterval anywhere;
  };
  Reach reach(bool carve) const;
  // Makes the frame look at these tiles, which must live on.
  void aim(FrameEvidence& frame, const Reach& reach, bool carve) const;

 private:
  // Part of a square of pixels' cone.
  struct Cone {
    float u, v;    // px, its axis
    float pixels;  // its width
    DepthInterval depths;
  };

  // Of a pixel, or of all the pixels of a tile.
  struct Depths {
    DepthInterval band;
    float free_to;  // nothing beyond lies in front of the band
  };

  Depths pixel_depths(int u, int v) const;
  void add_tile(int column, int row);

  const DepthPlanes& planes_;
  Camera camera_;
  SensorModel sensor_;
  double voxel_;
  int tile_;  // px
  int columns_;
  int rows_;
  std::vector<Depths> tiles_;
  std::vector<Cone> cones_;
};

}  // namespace armsreach::mapping
