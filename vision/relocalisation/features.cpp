#include "vision/relocalisation/features.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <opencv2/features2d.hpp>

namespace armsreach::relocalisation {
namespace {

// The square roots of a descriptor's shares have Euclidean length one; times this they fill a byte
// (no share of a SIFT descriptor exceeds 0.4 or so).
constexpr float kDescriptorLength = 400;

Descriptor root_sift(const float* sift) {
  const float sum = std::accumulate(sift, sift + Descriptor().size(), 1e-6F);
  Descriptor descriptor;
  for (std::size_t i = 0; i < descriptor.size(); ++i) {
    const float root = kDescriptorLength * std::sqrt(sift[i] / sum);
    descriptor[i] = cv::saturate_cast<std::uint8_t>(root);
  }
  return descriptor;
}

float depth_at(const cv::Mat& depth, const cv::Point2f& pixel) {
  if (depth.empty()) return std::numeric_limits<float>::quiet_NaN();
  const int x = std::clamp(cvRound(pixel.x), 0, depth.cols - 1);
  const int y = std::clamp(cvRound(pixel.y), 0, depth.rows - 1);
  return depth.at<float>(y, x);
}

}  // namespace

void Features::push_back(const Feature& place, const Descriptor& descriptor) {
  places.push_back(place);
  descriptors.push_back(descriptor);
  codes.push_back(code_of(descriptor));
}

Code code_of(const Descriptor& descriptor) {
  Descriptor sorted = descriptor;
  const auto middle = sorted.begin() + sorted.size() / 2;
  std::nth_element(sorted.begin(), middle, sorted.end());
  Code code{};
  for (std::size_t i = 0; i < descriptor.size(); ++i) {
    if (descriptor[i] > *middle) code[i / 64] |= std::uint64_t{1} << (i % 64);
  }
  return code;
}

Features find_features(const cv::Mat& grey, const cv::Mat& depth, const Camera& camera,
                       int most_features) {
  // Layers an octave as Lowe's. The contrast threshold is a tenth of his and edges are let in:
  // plain furniture has few features else, and the strongest are kept anyway.
  constexpr int kLayers = 3;
  constexpr double kContrast = 0.004;
  constexpr double kEdge = 20;
  std::vector<cv::KeyPoint> keypoints;
  cv::Mat sift;
  cv::SIFT::create(most_features, kLayers, kContrast, kEdge)
      ->detectAndCompute(grey, cv::noArray(), keypoints, sift);

  std::vector<int> order(keypoints.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return keypoints[a].response > keypoints[b].response; });
  Features features;
  for (const int i : order) {
    const cv::Point2f& pixel = keypoints[i].pt;
    const Eigen::Vector3d ray = unproject(camera, {pixel.x, pixel.y});
    features.push_back({ray.head<2>().cast<float>(), depth_at(depth, pixel)},
                       root_sift(sift.ptr<float>(i)));
  }
  return features;
}

}  // namespace armsreach::relocalisation
