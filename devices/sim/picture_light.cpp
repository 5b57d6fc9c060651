#include "devices/sim/picture_light.hpp"

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace armsreach::sim {
namespace {

constexpr double kGrey = 0.3;
constexpr double kFollow = 0.1;   // share of the way to a new frame's light
constexpr double kColored = 0.5;  // a room of wood is not lit by red light: half of its hue is

// Shares of the light that falls on a surface which faces the key.
constexpr double kKey = 0.6;
constexpr double kAbove = 0.5;
constexpr double kBelow = 0.35;

}  // namespace

void PictureLight::look_at(const cv::Mat& picture) {
  cv::Mat small;
  cv::resize(picture, small, {32, 24}, 0, 0, cv::INTER_AREA);
  if (small.channels() == 1) cv::cvtColor(small, small, cv::COLOR_GRAY2BGR);
  // Levels are about square roots of light.
  cv::Mat level;
  small.convertTo(level, CV_32F, 1.0 / 255);
  const cv::Scalar mean = cv::mean(level.mul(level));
  const Color color(mean[2], mean[1], mean[0]);
  const Color even = Color::Constant(color.mean());
  const Color now = ((even + kColored * (color - even)) / kGrey).cwiseMax(0.12).cwiseMin(1.6);
  light_ = seen_ ? Color(light_ + kFollow * (now - light_)) : now;
  seen_ = true;
}

Lighting PictureLight::lighting(const Pose& world_from_camera) const {
  Lighting lighting;
  const auto turned = [&](const Eigen::Vector3d& v) {
    return Eigen::Vector3d(world_from_camera.rotation() * v.normalized());
  };
  lighting.light.towards = turned({-0.4, -0.8, -0.45});
  lighting.light.key = kKey * light_;
  lighting.light.above = kAbove * light_;
  lighting.light.below = kBelow * light_;
  lighting.up = turned({0, -1, 0}).cast<float>();
  lighting.eye = world_from_camera.translation().cast<float>();
  return lighting;
}

}  // namespace armsreach::sim
