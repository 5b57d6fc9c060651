#include "vision/gesture/hand_texture.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <opencv2/imgproc.hpp>

namespace armsreach::gesture {
namespace {

constexpr double kScale = kTextureSide / 2.0;  // px of the patch, of the root of the hand's area
constexpr double kFill = 6;                    // px: how far brightness spreads beyond the outline
constexpr std::size_t kBlockSize = 4 * kTextureBins;
constexpr float kFaint = 10;   // length of a block whose gradients are noise
constexpr float kMost = 0.2F;  // share that one edge may have of a block [Dalal and Triggs]
constexpr float kNone = 0.1F;  // length of a normalised block that holds nothing

using Cell = std::array<float, kTextureBins>;
using Cells = std::array<std::array<Cell, kTextureCells>, kTextureCells>;

// Patch from image: upright, of one size, the hand's centre in the middle.
cv::Matx23d patch_from_image(const HandObservation& hand) {
  const double scale = kScale / std::sqrt(std::max(1.0, hand.area));
  const double c = scale * std::cos(hand.angle), s = scale * std::sin(hand.angle);
  const double middle = (kTextureSide - 1) / 2.0;
  const double x = hand.center.x(), y = hand.center.y();
  return {c, s, middle - c * x - s * y, -s, c, middle + s * x - c * y};
}

// The part of the image that the patch may show.
cv::Rect seen_of(const cv::Mat& bgr, const HandObservation& hand) {
  const double reach = std::sqrt(2 * std::max(1.0, hand.area)) + 2;  // half the patch's diagonal
  const cv::Point center(cvRound(hand.center.x()), cvRound(hand.center.y()));
  const cv::Point corner(cvCeil(reach), cvCeil(reach));
  return cv::Rect(center - corner, center + corner) & cv::Rect(0, 0, bgr.cols, bgr.rows);
}

// Brightness of the patch. Reduced by whole steps before it is turned, so that nothing is skipped.
cv::Mat brightness_of(const cv::Mat& bgr, const HandObservation& hand,
                      const cv::Matx23d& patch_from) {
  const cv::Rect seen = seen_of(bgr, hand);
  if (seen.empty()) return cv::Mat(kTextureSide, kTextureSide, CV_32FC1, cv::Scalar(0));
  cv::Mat grey;
  cv::cvtColor(bgr(seen), grey, cv::COLOR_BGR2GRAY);
  const int step = std::clamp(static_cast<int>(std::sqrt(hand.area) / kScale), 1,
                              std::min(seen.width, seen.height));
  if (step > 1)
    cv::resize(grey, grey, {seen.width / step, seen.height / step}, 0, 0, cv::INTER_AREA);
  const double step_x = static_cast<double>(seen.width) / grey.cols;
  const double step_y = static_cast<double>(seen.height) / grey.rows;
  const cv::Matx33d image_from_grey(step_x, 0, seen.x + (step_x - 1) / 2, 0, step_y,
                                    seen.y + (step_y - 1) / 2, 0, 0, 1);
  cv::Mat patch;
  cv::warpAffine(grey, patch, patch_from * image_from_grey, {kTextureSide, kTextureSide},
                 cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  patch.convertTo(patch, CV_32F);
  return patch;
}

// 1 inside of the outline but for its edge, which tells of what is behind.
cv::Mat inside_of(const HandObservation& hand, const cv::Matx23d& patch_from) {
  constexpr int kFiner = 2;  // so that the edge is where it is to a fraction of a pixel
  std::vector<cv::Point> outline;
  for (const cv::Point& at : hand.outline) {
    const cv::Vec2d in_patch = patch_from * cv::Vec3d(at.x, at.y, 1);
    outline.emplace_back(cvRound(kFiner * (in_patch[0] + 0.5) - 0.5),
                         cvRound(kFiner * (in_patch[1] + 0.5) - 0.5));
  }
  cv::Mat fine(kFiner * kTextureSide, kFiner * kTextureSide, CV_8UC1, cv::Scalar(0)), inside;
  if (!outline.empty()) cv::fillPoly(fine, std::vector{outline}, cv::Scalar(255));
  cv::resize(fine, inside, {kTextureSide, kTextureSide}, 0, 0, cv::INTER_AREA);
  cv::threshold(inside, inside, 127, 1, cv::THRESH_BINARY);
  cv::erode(inside, inside, cv::Mat());
  inside.convertTo(inside, CV_32F);
  return inside;
}

// The brightness inside, spread over all of the patch; far from the hand it is the hand's mean.
// Smooth, so that half the resolution is enough.
cv::Mat around_of(const cv::Mat& brightness, const cv::Mat& inside) {
  constexpr double kLittle = 1e-3;
  const auto spread = [](const cv::Mat& values) {
    cv::Mat half;
    cv::resize(values, half, {}, 0.5, 0.5, cv::INTER_AREA);
    cv::GaussianBlur(half, half, {}, kFill / 2);
    return half;
  };
  const double mean = cv::mean(brightness, inside > 0)[0];
  cv::Mat around = (spread(brightness.mul(inside)) + kLittle * mean) / (spread(inside) + kLittle);
  cv::resize(around, around, brightness.size(), 0, 0, cv::INTER_LINEAR);
  return around;
}

Cells histograms(const cv::Mat& patch) {
  cv::Mat dx, dy, strength, direction;
  const cv::Mat difference = (cv::Mat_<float>(1, 3) << -1, 0, 1);
  cv::filter2D(patch, dx, CV_32F, difference, {-1, -1}, 0, cv::BORDER_REPLICATE);
  cv::filter2D(patch, dy, CV_32F, difference.t(), {-1, -1}, 0, cv::BORDER_REPLICATE);
  cv::cartToPolar(dx, dy, strength, direction, true);
  Cells cells{};
  for (int y = 0; y < kTextureSide; ++y) {
    for (int x = 0; x < kTextureSide; ++x) {
      Cell& cell = cells[static_cast<std::size_t>(y / kTextureCell)]
                        [static_cast<std::size_t>(x / kTextureCell)];
      // Half turns, in bins whose middles are at halves: parted between the nearest two.
      const float at = direction.at<float>(y, x) / 180 * kTextureBins + (kTextureBins - 0.5F);
      const float below = std::floor(at);
      const auto bin = static_cast<std::size_t>(below);
      cell[bin % kTextureBins] += strength.at<float>(y, x) * (1 - at + below);
      cell[(bin + 1) % kTextureBins] += strength.at<float>(y, x) * (at - below);
    }
  }
  return cells;
}

void normalise(float* block, float least) {
  const float squares = std::inner_product(block, block + kBlockSize, block, 0.0F);
  const float factor = 1 / std::sqrt(squares + least * least);
  for (std::size_t i = 0; i < kBlockSize; ++i) block[i] *= factor;
}

// The hand is as bright as its light: each block by itself.
TextureFeatures blocks_of(const Cells& cells) {
  TextureFeatures features;
  float* block = features.data();
  for (std::size_t row = 0; row < kTextureBlocks; ++row) {
    for (std::size_t column = 0; column < kTextureBlocks; ++column, block += kBlockSize) {
      float* end = block;
      for (const std::size_t y : {row, row + 1})
        for (const std::size_t x : {column, column + 1})
          end = std::copy(cells[y][x].begin(), cells[y][x].end(), end);
      normalise(block, kFaint);
      for (float* value = block; value != end; ++value) *value = std::min(*value, kMost);
      normalise(block, kNone);
    }
  }
  return features;
}

constexpr const char* kFormat = "armsreach-texture 1";

}  // namespace

cv::Mat texture_patch(const cv::Mat& bgr, const HandObservation& hand) {
  CV_Assert(bgr.type() == CV_8UC3);
  const cv::Matx23d patch_from = patch_from_image(hand);
  const cv::Mat brightness = brightness_of(bgr, hand, patch_from);
  const cv::Mat inside = inside_of(hand, patch_from);
  cv::Mat patch = around_of(brightness, inside);
  brightness.copyTo(patch, inside > 0);
  return patch;
}

TextureFeatures texture_features(const cv::Mat& bgr, const HandObservation& hand) {
  return blocks_of(histograms(texture_patch(bgr, hand)));
}

TextureFeatures mirrored(const TextureFeatures& features) {
  TextureFeatures mirror;
  const float* value = features.data();
  for (std::size_t row = 0; row < kTextureBlocks; ++row) {
    for (std::size_t column = 0; column < kTextureBlocks; ++column) {
      float* block = &mirror[(row * kTextureBlocks + kTextureBlocks - 1 - column) * kBlockSize];
      for (std::size_t cell = 0; cell < 4; ++cell)
        for (std::size_t bin = 0; bin < kTextureBins; ++bin)
          block[(cell ^ 1) * kTextureBins + kTextureBins - 1 - bin] = *value++;
    }
  }
  return mirror;
}

double TextureModel::log_odds(const TextureFeatures& features) const {
  return std::inner_product(weights.begin(), weights.end(), features.begin(), constant);
}

Result<TextureModel> read_texture_model(std::istream& in, const std::string& where) {
  constexpr const char* kRemedy = "write it again with `armsreach learn hands`";
  std::string format;
  std::getline(in, format);
  if (format.ends_with('\r')) format.pop_back();  // of a Windows editor
  if (format != kFormat) return Error{"is no model of hands' texture", where, kRemedy};
  TextureModel model;
  in >> model.constant;
  for (float& weight : model.weights) in >> weight;
  std::string more;
  if (!in || in >> more) {
    return Error{"does not hold the " + std::to_string(kTextureSize + 1) + " numbers of its format",
                 where, kRemedy};
  }
  return model;
}

void write_texture_model(std::ostream& out, const TextureModel& model) {
  out << kFormat << '\n' << model.constant << '\n';
  for (std::size_t i = 0; i < kTextureSize; ++i)
    out << model.weights[i] << ((i + 1) % kBlockSize == 0 ? '\n' : ' ');
}

}  // namespace armsreach::gesture
