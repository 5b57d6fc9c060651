// Tools of the painters of patterns.
#pragma once

#include <opencv2/core.hpp>

#include "devices/sim/random.hpp"
#include "devices/sim/world.hpp"

namespace armsreach::sim {

// 0..255, blue first, as OpenCV draws.
cv::Scalar bgr(const Color& color);
// Between two colours, 0: a, 1: b.
Color between(const Color& a, const Color& b, double fraction);

// A plain image of one colour, CV_32FC3, 0..255 BGR.
cv::Mat canvas(int width, int height, const Color& color);

// Smooth noise that repeats without a seam, CV_32F, mean 0 and deviation near 1, with features
// about width / columns and height / rows in size.
cv::Mat noise(int width, int height, int columns, int rows, Random& random);
// Several octaves, each twice as fine and `gain` times as strong as the one before.
cv::Mat clouds(int width, int height, int cells, int octaves, double gain, Random& random);

// Moves each pixel of a CV_32FC3 image towards a colour by a CV_32F share, cut to 0..1.
void blend(cv::Mat& image, const Color& color, const cv::Mat& share);
// Multiplies each pixel by 1 + amount * relief.
void shade(cv::Mat& image, const cv::Mat& relief, double amount);

cv::Mat to_8_bit(const cv::Mat& image);

// Painters of things with print on them, in prints.cpp and pictures.cpp; CV_8UC3.
cv::Mat paint_label(const Material& material, Random& random);
cv::Mat paint_book(const Material& material, Random& random);
cv::Mat paint_landscape(const Material& material, Random& random);
cv::Mat paint_shapes(const Material& material, Random& random);
cv::Mat paint_leaves(const Material& material, Random& random);

}  // namespace armsreach::sim
