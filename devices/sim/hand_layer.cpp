#include "devices/sim/hand_layer.hpp"

#include <cmath>

#include <opencv2/core.hpp>

namespace armsreach::sim {
namespace {

// (B, G, R) as a grey camera sees it: Rec. 601 luma.
std::uint8_t grey(const cv::Vec3b& c) {
  return static_cast<std::uint8_t>((114 * c[0] + 587 * c[1] + 299 * c[2] + 500) / 1000);
}

std::uint8_t mixed_value(int below, int above, int coverage) {
  return static_cast<std::uint8_t>((below * (255 - coverage) + above * coverage + 127) / 255);
}

}  // namespace

void hide_behind(const cv::Mat& scene_depth, Raster::Images& hands) {
  if (scene_depth.empty() || hands.place.empty()) return;
  const cv::Mat scene = scene_depth(hands.place);
  for (int y = 0; y < scene.rows; ++y) {
    for (int x = 0; x < scene.cols; ++x) {
      // Thin rims have no depth of their own; they go with what is beside them.
      const float hand = hands.depth.at<float>(y, x);
      if (!(scene.at<float>(y, x) < hand)) continue;
      hands.coverage.at<std::uint8_t>(y, x) = 0;
      hands.ids.at<std::uint8_t>(y, x) = 0;
      hands.depth.at<float>(y, x) = std::nanf("");
    }
  }
}

void lay_color(const Raster::Images& hands, cv::Mat& image) {
  if (hands.place.empty()) return;
  cv::Mat part = image(hands.place);
  for (int y = 0; y < part.rows; ++y) {
    for (int x = 0; x < part.cols; ++x) {
      const int coverage = hands.coverage.at<std::uint8_t>(y, x);
      if (coverage == 0) continue;
      const cv::Vec3b& hand = hands.color.at<cv::Vec3b>(y, x);
      if (part.channels() == 1) {
        std::uint8_t& pixel = part.at<std::uint8_t>(y, x);
        pixel = mixed_value(pixel, grey(hand), coverage);
        continue;
      }
      cv::Vec3b& pixel = part.at<cv::Vec3b>(y, x);
      for (int c = 0; c < 3; ++c) pixel[c] = mixed_value(pixel[c], hand[c], coverage);
    }
  }
}

void lay_depth(const Raster::Images& hands, cv::Mat& depth) {
  if (hands.place.empty()) return;
  hands.depth.copyTo(depth(hands.place), hands.depth == hands.depth);
}

void lay_value(const Raster::Images& hands, int value, cv::Mat& image) {
  if (hands.place.empty()) return;
  image(hands.place).setTo(value, hands.depth == hands.depth);
}

void lay_masks(const Raster::Images& hands, int things, cv::Mat& masks) {
  if (hands.place.empty()) return;
  cv::Mat part = masks(hands.place);
  for (int y = 0; y < part.rows; ++y) {
    for (int x = 0; x < part.cols; ++x) {
      const int id = hands.ids.at<std::uint8_t>(y, x);
      if (id > 0 && !std::isnan(hands.depth.at<float>(y, x)))
        part.at<std::uint16_t>(y, x) = static_cast<std::uint16_t>(things + id);
    }
  }
}

}  // namespace armsreach::sim
