// Names a silhouette by the most similar one of a bank. Knows nothing of hands.
#pragma once

#include <array>
#include <bitset>
#include <vector>

#include <opencv2/core/mat.hpp>

namespace armsreach::sim {

class SilhouetteMatcher {
 public:
  // `mask`: CV_8U, not 0 inside.
  void add(int label, const cv::Mat& mask);
  // The label of the silhouette with the largest intersection over union, of equal area, centroid
  // on centroid, turned by up to 15 degrees.
  int name(const cv::Mat& mask) const;

 private:
  static constexpr int kSide = 64;
  using Bits = std::bitset<kSide * kSide>;
  static Bits normalised(const cv::Mat& mask, double degrees);

  struct Entry {
    int label;
    Bits bits;
  };
  std::vector<Entry> entries_;
};

}  // namespace armsreach::sim
