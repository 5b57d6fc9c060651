// What hands look like inside of their outline: creases between fingers, knuckles, roundness. Wood,
// walls and boxes of skin's colour may have a hand's outline, but are smooth or grained.
//
// Histograms of oriented gradients [Dalal and Triggs 2005] of the hand turned upright and brought
// to one size; what is around it is painted over, so that no room is learnt with the hands in it.
#pragma once

#include <array>
#include <cstddef>
#include <istream>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "vision/core/result.hpp"
#include "vision/gesture/hand_observation.hpp"

namespace armsreach::gesture {

constexpr int kTextureSide = 48;  // px of the patch, twice the root of the hand's area
constexpr int kTextureCell = 8;
constexpr int kTextureBins = 9;  // of half a turn
constexpr int kTextureCells = kTextureSide / kTextureCell;
constexpr int kTextureBlocks = kTextureCells - 1;  // of two by two cells, overlapping
constexpr std::size_t kTextureSize =
    std::size_t{kTextureBlocks} * kTextureBlocks * 4 * kTextureBins;

using TextureFeatures = std::array<float, kTextureSize>;  // [block row][block][cell][bin]

// The hand as the features see it: CV_32FC1 of kTextureSide, brightness 0..255.
cv::Mat texture_patch(const cv::Mat& bgr, const HandObservation& hand);
// `bgr`: CV_8UC3, in which the hand was seen.
TextureFeatures texture_features(const cv::Mat& bgr, const HandObservation& hand);

// Of the other hand: what the features of the image in a mirror are.
TextureFeatures mirrored(const TextureFeatures& features);

// A logistic model: how much likelier such a texture is of a hand than of something else.
struct TextureModel {
  double constant = 0;
  TextureFeatures weights{};

  double log_odds(const TextureFeatures& features) const;
};

// As text: a line that names the format, the constant, then a line of weights for each block.
Result<TextureModel> read_texture_model(std::istream& in, const std::string& where);
void write_texture_model(std::ostream& out, const TextureModel& model);

}  // namespace armsreach::gesture
