#include "vision/registration/occluding_contours.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace armsreach {
namespace {

constexpr float kFarthest = 4.0F;       // m
constexpr float kRelativeJump = 0.08F;  // of the near surface's depth, and
constexpr float kLeastJump = 0.02F;     // m
constexpr float kSmooth = 0.02F;   // change of depth within a surface near its border, relative
constexpr int kNearRun = 4;        // px of near surface that must be whole behind its border
constexpr int kFarRun = 2;         // px of far surface
constexpr int kWidestShadow = 24;  // px of unknown depth between the two

// One row or column of a depth image.
class Line {
 public:
  Line(const cv::Mat& depth, Across across, int index)
      : first_(across == Across::columns ? depth.ptr<float>(index) : depth.ptr<float>() + index),
        step_(across == Across::columns ? 1 : static_cast<std::ptrdiff_t>(depth.step1())),
        length_(across == Across::columns ? depth.cols : depth.rows) {}

  int length() const { return length_; }
  float operator[](int i) const { return first_[i * step_]; }

  bool near_is_whole(int border, int inwards) const {
    const int end = border + inwards * kNearRun;
    if (end < 0 || end >= length_) return false;
    const float z = (*this)[border];
    for (int i = border; i != end; i += inwards) {
      if (!(std::abs((*this)[i + inwards] - z) < kSmooth * z)) return false;
    }
    return true;
  }

  // All well behind the near surface at depth `near`.
  bool far_is_whole(int border, int inwards, float near) const {
    const int end = border + inwards * kFarRun;
    if (end < 0 || end >= length_) return false;
    const float least = near + 0.6F * ((*this)[border] - near);
    for (int i = border; i != end; i += inwards) {
      if (!((*this)[i + inwards] > least)) return false;
    }
    return true;
  }

 private:
  const float* first_;
  std::ptrdiff_t step_;
  int length_;
};

// Calls found(position, depth) for each border; positions are half-way out of the last near pixel.
template <class Found>
void find_borders(const Line& line, Found found) {
  int last = -1;  // known pixel before the present one
  for (int i = 0; i < line.length(); ++i) {
    const float z = line[i];
    if (!(z > 0)) continue;
    const int before = std::exchange(last, i);
    if (before < 0 || i - before > kWidestShadow) continue;
    const float z_before = line[before];
    const float near = std::min(z, z_before);
    if (near > kFarthest || std::abs(z - z_before) < kRelativeJump * near + kLeastJump) continue;
    const bool near_first = z_before < z;
    const int near_border = near_first ? before : i;
    const int far_border = near_first ? i : before;
    const int outwards = near_first ? 1 : -1;
    if (line.near_is_whole(near_border, -outwards) &&
        line.far_is_whole(far_border, outwards, near)) {
      found(static_cast<float>(near_border) + 0.5F * static_cast<float>(outwards), near);
    }
  }
}

std::vector<ContourPoint> contours(const cv::Mat& depth, const Camera& camera, Across across) {
  std::vector<ContourPoint> points;
  const int lines = across == Across::columns ? depth.rows : depth.cols;
  for (int index = 0; index < lines; ++index) {
    find_borders(Line(depth, across, index), [&](float position, float z) {
      ContourPoint point;
      point.across = across;
      point.pixel = across == Across::columns ? Eigen::Vector2f(position, index)
                                              : Eigen::Vector2f(index, position);
      const Eigen::Vector3d ray = unproject(camera, point.pixel.cast<double>());
      point.point_in_depth = z * ray.cast<float>();
      points.push_back(point);
    });
  }
  return points;
}

}  // namespace

std::vector<ContourPoint> occluding_contours(const cv::Mat& depth, const Camera& camera,
                                             std::size_t most) {
  CV_Assert(depth.type() == CV_32FC1);
  std::vector<ContourPoint> out;
  for (const Across across : {Across::columns, Across::rows}) {
    const std::vector<ContourPoint> all = contours(depth, camera, across);
    const std::size_t taken = std::min(most, all.size());
    for (std::size_t i = 0; i < taken; ++i) out.push_back(all[i * all.size() / taken]);
  }
  return out;
}

}  // namespace armsreach
