// Features of an image, each with the ray it lies on, its depth where that is known, and a
// descriptor.
//
// SIFT (Lowe, IJCV 2004) at about 320 pixels' width, its descriptors compared by Hellinger's kernel
// ("RootSIFT": Arandjelovic, Zisserman, CVPR 2012). Measured with OpenCV 4.6 against ORB (Rublee et
// al., ICCV 2011), the rest being the same: pairs of views whose pose was found within 5 cm and
// 5 deg from features alone, and the milliseconds of finding the features of one image:
//
//                    up to 15 cm / 8 deg apart     15-30 / 8-16     30-45 / 16-24     ms
//   three recordings, pairs            122              229               241
//   SIFT, 500 at 320x240               98 %             83 %              50 %      16-28
//   ORB, 500 at 320x240                94 %             75 %              27 %       1-3
//   ORB, 1000 at 640x480               94 %             76 %              38 %       3-7
//
// ORB recalls more per millisecond. SIFT recalls more within the hundred milliseconds there are,
// and a lost camera that gets no answer gets none from the next frame either, so SIFT it is.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

#include "vision/core/camera.hpp"

namespace armsreach::relocalisation {

struct Feature {
  Eigen::Vector2f ray;  // (x, y) of (x, y, 1): the pixel with the lens's distortion taken away
  float depth;          // m along z; NaN unknown
  Eigen::Vector3d point() const {  // in the camera's frame
    return Eigen::Vector3f(ray.x() * depth, ray.y() * depth, depth).cast<double>();
  }
};

using Descriptor = std::array<std::uint8_t, 128>;  // of Euclidean length 400 or so
using Code = std::array<std::uint64_t, 2>;  // bit i: entry i is above the descriptor's median

// Parallel lists, the strongest feature first.
struct Features {
  std::vector<Feature> places;
  std::vector<Descriptor> descriptors;
  std::vector<Code> codes;

  std::size_t size() const { return places.size(); }
  void push_back(const Feature& place, const Descriptor& descriptor);
};

// `grey` is CV_8UC1 of the camera's size; `depth` (CV_32F m, NaN unknown) too, or empty.
Features find_features(const cv::Mat& grey, const cv::Mat& depth, const Camera& camera,
                       int most_features);

Code code_of(const Descriptor& descriptor);

}  // namespace armsreach::relocalisation
