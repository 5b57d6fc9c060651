// Draws small triangles without a graphics context: four samples a pixel, the nearest surface wins.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <opencv2/core/types.hpp>

#include "devices/sim/hand/near_clip.hpp"
#include "vision/core/camera.hpp"

namespace armsreach::sim {

struct RasterSurface {
  std::span<const Eigen::Vector3f> positions;  // in the camera's frame
  std::span<const Eigen::Vector3f> colors;     // as seen, B G R in 0..255; may be empty
  std::span<const std::array<std::uint32_t, 3>> triangles;
  bool mirrored = false;  // triangles go clockwise seen from outside
  std::uint8_t id = 1;    // 1..255
};

class Raster {
 public:
  explicit Raster(const Camera& camera);

  const Camera& camera() const { return camera_; }

  void clear();
  // Triangles are cut off at the near plane (2 cm). What spans point to must stay until the images
  // have been read.
  void draw(const RasterSurface& surface);

  // Pixels that anything may cover.
  cv::Rect touched() const;
  // CV_8U: the id of the surface that covers at least two of a pixel's four samples, else 0.
  cv::Mat ids() const;
  struct Images {
    cv::Rect place;  // of all of them in the camera's image
    cv::Mat color;   // CV_8UC3
    cv::Mat depth;   // CV_32F m along z at the pixel's centre, NaN where less than half is covered
    cv::Mat coverage;  // CV_8U, share of the pixel in 255ths
    cv::Mat ids;       // CV_8U, of the nearest surface
  };
  Images images() const;

 private:
  struct Corner {  // a vertex as seen
    float x = 0;   // in samples
    float y = 0;
    float inverse_depth = 0;  // 0: not to be drawn
  };
  struct Part {  // one drawn surface
    RasterSurface surface;
    std::size_t first_corner = 0;
    std::uint32_t first_triangle = 0;  // in the numbering of all
  };
  struct Sample {
    float inverse_depth = 0;
    std::uint32_t triangle = 0;  // plus one; 0: nothing
  };
  struct Shade {
    Eigen::Vector3f color;
    float depth;
  };

  void draw_before_near_plane(const RasterSurface& surface);
  void draw_triangle(const std::array<Corner, 3>& corners, std::uint32_t number);
  const Part& part_of(std::uint32_t triangle) const;
  Shade shade(std::uint32_t triangle, float x, float y) const;
  // The samples of a pixel, row by row.
  std::array<Sample, 4> samples_at(int x, int y) const;
  void resolve(int x, int y, Images& images) const;

  Camera camera_;
  int width_;  // in samples
  int height_;
  std::vector<Sample> samples_;
  std::vector<Corner> corners_;
  std::vector<Part> parts_;
  std::deque<ClippedTriangles> cut_;  // by the near plane; parts point to them
  std::uint32_t triangles_ = 0;
  int left_ = 0;  // touched samples: [left, right) x [top, bottom)
  int top_ = 0;
  int right_ = 0;
  int bottom_ = 0;
};

}  // namespace armsreach::sim
