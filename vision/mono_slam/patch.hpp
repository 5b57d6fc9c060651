// What a point looks like: a piece of the image it was first seen in, and how that appears from
// elsewhere.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

#include "vision/core/camera.hpp"
#include "vision/core/pose.hpp"

namespace armsreach::mono_slam {

// Of odd size up to 15; whole grey values. `pixel_from_centre`: where, relative to the centre of
// the middle sample, the point itself is.
struct Template {
  int size = 0;
  std::array<float, 15 * 15> samples{};
  Eigen::Vector2d pixel_from_centre = Eigen::Vector2d::Zero();

  int half() const { return size / 2; }
};

// The same pattern on every second pixel, smoothed as SearchImage::half() is; size 7 of 15, 5
// of 11.
Template halved(const Template& pattern);

struct Patch {
  static constexpr int kReach = 16;  // pixels kept around the middle one

  cv::Mat grey;  // CV_8UC1, (2 kReach + 1)^2; beyond the first image's edge, its border repeated
  int size = 15;
  Eigen::Vector2d pixel;            // of the point in the first image
  Pose world_from_camera;           // then
  Eigen::Vector3d normal_in_world;  // of the surface; towards the first camera where unknown

  Template original() const;
};

// Around the whole pixel nearest to `pixel`.
Patch patch_at(const cv::Mat& image, const Eigen::Vector2d& pixel, int size, const Camera& camera,
               const Pose& world_from_camera);
// A small picture as it is, its point at its middle.
Template template_of(const cv::Mat& grey);

// first_from_now: by how many pixels of the first image a place moves when it moves by one pixel of
// an image taken from `world_from_camera`. The surface is taken as a plane through the point.
// Identity where the point or the plane is not seen.
Eigen::Matrix2d warp(const Patch& patch, const Eigen::Vector3d& point_in_world,
                     const Camera& camera, const Pose& world_from_camera);

Template warped(const Patch& patch, const Eigen::Matrix2d& first_from_now);

}  // namespace armsreach::mono_slam
