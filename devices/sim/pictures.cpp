// Framed pictures for the walls.
#include <cmath>
#include <vector>

#include <opencv2/imgproc.hpp>

#include "devices/sim/paint.hpp"

namespace armsreach::sim {
namespace {

constexpr int kSide = 512;  // px
constexpr int kFrame = kSide * 5 / 100;
constexpr int kMount = kSide * 10 / 100;

cv::Mat framed(const Material& material, const cv::Mat& art, Random& random) {
  cv::Mat wood = canvas(kSide, kSide, material.colors[0]);
  shade(wood, noise(kSide, kSide, 8, 96, random), 0.06);
  cv::Mat image = to_8_bit(wood);
  cv::rectangle(image, cv::Rect(kFrame, kFrame, kSide - 2 * kFrame, kSide - 2 * kFrame),
                bgr(material.colors[1] * 0.72), 3, cv::LINE_AA);
  image(cv::Rect(kFrame + 2, kFrame + 2, kSide - 2 * kFrame - 4, kSide - 2 * kFrame - 4))
      .setTo(bgr(material.colors[1]));
  const int edge = kFrame + kMount;
  art.copyTo(image(cv::Rect(edge, edge, art.cols, art.rows)));
  return image;
}

constexpr int art_side() { return kSide - 2 * (kFrame + kMount); }

// The outline of a leaf from its foot to its tip.
std::vector<cv::Point> leaf(const cv::Point2d& foot, const cv::Point2d& along, double width) {
  const cv::Point2d across(-along.y, along.x);
  std::vector<cv::Point> outline;
  constexpr int kSteps = 20;
  for (int i = 0; i < 2 * kSteps; ++i) {
    const double t =
        i < kSteps ? static_cast<double>(i) / kSteps : 2.0 - static_cast<double>(i) / kSteps;
    const double side = (i < kSteps ? 1 : -1) * width * std::sin(CV_PI * std::pow(t, 0.8));
    const cv::Point2d p = foot + t * along + side * across;
    outline.emplace_back(static_cast<int>(p.x), static_cast<int>(p.y));
  }
  return outline;
}

}  // namespace

// A sun over ranges of hills, the nearer the darker.
cv::Mat paint_landscape(const Material& material, Random& random) {
  const int s = art_side();
  const std::vector<Color>& colors = material.colors;
  cv::Mat art(s, s, CV_8UC3);
  for (int y = 0; y < s; ++y)
    art.row(y).setTo(bgr(between(colors[2], Color(1, 0.96, 0.88), 0.75 * y / s)));
  const cv::Point sun(static_cast<int>(s * random.uniform(0.3, 0.7)), s * 34 / 100);
  cv::circle(art, sun, s * 13 / 100, bgr(colors[3]), cv::FILLED, cv::LINE_AA);
  const int ranges = static_cast<int>(colors.size()) - 4;
  for (int range = 0; range < ranges; ++range) {
    const double level = 0.45 + 0.42 * range / std::max(1, ranges - 1);
    const cv::Mat ridge = clouds(1024, 2, 3, 1, 1, random) + 0.3 * noise(1024, 2, 24, 2, random) +
                          0.1 * noise(1024, 2, 90, 2, random);
    const cv::Scalar color = bgr(colors[static_cast<std::size_t>(4 + range)]);
    for (int x = 0; x < s; ++x) {
      const int top = static_cast<int>(
          s * (level - 0.07 * static_cast<double>(ridge.at<float>(0, x + 100 * range))));
      cv::line(art, {x, std::min(top, s)}, {x, s}, color, 1);
    }
  }
  return framed(material, art, random);
}

// Overlapping discs, half discs, bars and a few thin lines.
cv::Mat paint_shapes(const Material& material, Random& random) {
  const int s = art_side();
  const std::vector<Color>& colors = material.colors;
  cv::Mat art(s, s, CV_8UC3, bgr(colors[2]));
  const int palette = static_cast<int>(colors.size()) - 3;
  for (int i = 0; i < 13; ++i) {
    const cv::Scalar color = bgr(colors[static_cast<std::size_t>(3 + i % palette)]);
    const cv::Point at(s / 10 + random.below(s * 8 / 10), s / 10 + random.below(s * 8 / 10));
    const int size = static_cast<int>(s * random.uniform(0.06, 0.19));
    const double angle = 45 * random.below(8);
    if (i % 3 == 0) {
      cv::circle(art, at, size, color, cv::FILLED, cv::LINE_AA);
    } else if (i % 3 == 1) {
      cv::ellipse(art, at, {size, size}, angle, 0, 180, color, cv::FILLED, cv::LINE_AA);
    } else {
      cv::rectangle(art, cv::Rect(at.x - size / 3, at.y - size, size * 2 / 3, 2 * size), color,
                    cv::FILLED);
    }
  }
  for (int i = 0; i < 7; ++i) {
    const cv::Point from(random.below(s), random.below(s));
    const cv::Point to(random.below(s), random.below(s));
    cv::line(art, from, to, bgr(colors.back()), 2, cv::LINE_AA);
  }
  return framed(material, art, random);
}

// A few stems with leaves in pairs, as in a herbarium.
cv::Mat paint_leaves(const Material& material, Random& random) {
  const int s = art_side();
  const std::vector<Color>& colors = material.colors;
  cv::Mat art(s, s, CV_8UC3, bgr(colors[2]));
  for (int stem = 0; stem < 3; ++stem) {
    const cv::Point2d foot(s * (0.25 + 0.25 * stem), s * 0.95);
    const double lean = random.uniform(-0.25, 0.25);
    const double height = s * random.uniform(0.68, 0.85);
    const int pairs = 5 + random.below(3);
    for (int i = 1; i <= pairs; ++i) {
      const double t = static_cast<double>(i) / pairs;
      const cv::Point2d at = foot + cv::Point2d(lean * height * t * t, -height * t);
      for (const int side : {-1, 1}) {
        const double angle = side * random.uniform(0.6, 1.0) * (1.2 - 0.7 * t);
        const double length = s * (0.19 - 0.09 * t);
        const cv::Point2d along(length * std::sin(angle), -length * std::cos(angle));
        const Color color = between(colors[3], colors[4], random.uniform());
        cv::fillPoly(art, std::vector{leaf(at, along, 0.24)}, bgr(color), cv::LINE_AA);
        cv::line(art, at, at + along, bgr(color * 0.7), 1, cv::LINE_AA);
      }
      const cv::Point2d before =
          foot + cv::Point2d(lean * height * (t - 1.0 / pairs) * (t - 1.0 / pairs),
                             -height * (t - 1.0 / pairs));
      cv::line(art, before, at, bgr(colors[3] * 0.7), 2, cv::LINE_AA);
    }
  }
  return framed(material, art, random);
}

}  // namespace armsreach::sim
