// Laying drawn hands over what a camera sees without them.
#pragma once

#include <opencv2/core/mat.hpp>

#include "devices/sim/hand/raster.hpp"

namespace armsreach::sim {

// Share of a depth camera's light that skin sends back, in 255ths.
constexpr int kSkinReturns = 190;

// Keeps of the hands what is in front of the scene. `scene_depth`: CV_32F m of the whole image in
// the same camera, NaN where nothing is known, which hides nothing; or empty.
void hide_behind(const cv::Mat& scene_depth, Raster::Images& hands);

// Over an image of the camera's size, CV_8UC3 or CV_8UC1, by coverage.
void lay_color(const Raster::Images& hands, cv::Mat& image);
// Where at least half of a pixel is covered: the hands' depth over the scene's, CV_32F.
void lay_depth(const Raster::Images& hands, cv::Mat& depth);
// A value over those pixels of a CV_8U image.
void lay_value(const Raster::Images& hands, int value, cv::Mat& image);
// Their ids, after those of the scene's things, into a CV_16U image.
void lay_masks(const Raster::Images& hands, int things, cv::Mat& masks);

}  // namespace armsreach::sim
