// Noise for images: unit normal numbers, drawn once into a tile that repeats. A frame reads it from
// an offset of its own.
#pragma once

#include <cstdint>

#include <opencv2/core/mat.hpp>

namespace armsreach::sim {

class NoiseTile {
 public:
  NoiseTile() = default;  // none
  // For images with `row_length` numbers a row. Smooth noise is alike in neighbouring numbers of
  // rows and columns, though still unit normal.
  enum class Kind { white, smooth };
  NoiseTile(int row_length, std::uint64_t seed, Kind kind = Kind::white);

  bool empty() const { return tile_.empty(); }
  // At least `row_length` numbers for row y of a frame.
  const float* row(std::int64_t frame, int y) const;

 private:
  std::uint64_t seed_ = 0;
  cv::Mat tile_;
};

}  // namespace armsreach::sim
