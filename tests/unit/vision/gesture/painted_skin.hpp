// Pictures of plain colours and models of them, for tests of colour classes.
#pragma once

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "vision/gesture/color_training.hpp"

namespace armsreach::gesture::test {

const cv::Scalar kSkinColor(120, 150, 205);  // B G R
const cv::Scalar kWallColor(70, 110, 60);
const cv::Scalar kBeigeColor(128, 160, 200);  // of walls that a model of many people calls skin

// `color` with noise of `deviation` levels, from a fixed seed.
inline cv::Mat painted(const cv::Size& size, const cv::Scalar& color, double deviation = 4) {
  cv::Mat noise(size, CV_16SC3), picture(size, CV_16SC3, color);
  cv::RNG random(7);
  random.fill(noise, cv::RNG::NORMAL, 0, deviation);
  picture += noise;
  picture.convertTo(picture, CV_8UC3);
  return picture;
}

// Where a fist is, with an arm that leaves through the lower border.
inline cv::Mat fist(const cv::Size& size) {
  cv::Mat mask = cv::Mat::zeros(size, CV_8UC1);
  const cv::Point center(size.width / 2, size.height / 2);
  cv::ellipse(mask, center, {size.width / 8, size.height / 6}, 0, 0, 360, cv::Scalar(255), -1);
  cv::rectangle(mask, {center.x - size.width / 16, center.y},
                {center.x + size.width / 16, size.height - 1}, cv::Scalar(255), -1);
  return mask;
}

inline cv::Mat hand_before(const cv::Scalar& wall, const cv::Size& size = {320, 240}) {
  cv::Mat picture = painted(size, wall);
  painted(size, kSkinColor).copyTo(picture, fist(size));
  return picture;
}

// Skin of many kinds against green things.
inline ColorModel general_model() {
  ColorExamples examples;
  const cv::Mat skins = painted({100, 100}, kSkinColor, 14);
  const cv::Mat others = painted({100, 100}, kWallColor, 25);
  for (int i = 0; i < 100 * 100; ++i) {
    examples.add(skins.at<cv::Vec3b>(i), true);
    examples.add(others.at<cv::Vec3b>(i), false);
  }
  return *general_skin_model({examples}, "test");
}

inline double f1(const cv::Mat& found, const cv::Mat& truth) {
  const double both = cv::countNonZero(found & truth);
  return 2 * both / (cv::countNonZero(found) + cv::countNonZero(truth));
}

}  // namespace armsreach::gesture::test
