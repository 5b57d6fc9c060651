#include "vision/gesture/ring_signature.hpp"

#include <cmath>
#include <vector>

namespace armsreach::gesture {

RingSignature sample_rings(const cv::Mat& mask, const Eigen::Vector2d& center, double area,
                           const RingLayout& layout, double turn) {
  RingSignature signature;
  const double unit = std::sqrt(area);
  for (int angle = 0; angle < layout.samples; ++angle) {
    const double theta = turn + angle * layout.step();
    const Eigen::Vector2d along(unit * std::cos(theta), unit * std::sin(theta));
    for (int ring = 0; ring < layout.rings(); ++ring) {
      const Eigen::Vector2d point =
          center + static_cast<double>(layout.radii[static_cast<std::size_t>(ring)]) * along;
      const int x = static_cast<int>(std::floor(point.x() + 0.5));
      const int y = static_cast<int>(std::floor(point.y() + 0.5));
      const bool inside = x >= 0 && y >= 0 && x < mask.cols && y < mask.rows;
      if (inside && mask.ptr(y)[x] != 0) signature.set(ring, angle);
    }
  }
  return signature;
}

RingSignature mirrored(const RingSignature& signature, const RingLayout& layout) {
  RingSignature mirror;
  for (std::size_t plane = 0; plane < mirror.planes.size(); ++plane) {
    for (int angle = 0; angle < layout.samples; ++angle) {
      // A sample's angle theta becomes pi - theta.
      const int from = (layout.samples + layout.samples / 2 - angle) % layout.samples;
      mirror.planes[plane][static_cast<std::size_t>(angle)] =
          signature.planes[plane][static_cast<std::size_t>(from)];
    }
  }
  return mirror;
}

double similarity(const RingSignature& seen, const RingSignature& known, int shift,
                  const RingLayout& layout) {
  int sum = 0;
  for (int ring = 0; ring < layout.rings(); ++ring) {
    int dot = 0;
    for (int angle = 0; angle < layout.samples; ++angle) {
      const bool a = seen.at(ring, (angle + shift) % layout.samples);
      dot += a == known.at(ring, angle) ? 1 : -1;
    }
    sum += layout.weights[static_cast<std::size_t>(ring)] * dot;
  }
  return static_cast<double>(sum) / layout.total_weight();
}

}  // namespace armsreach::gesture
