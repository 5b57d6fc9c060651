// Where to search: a span of pixels on each of consecutive lines of the image.
#pragma once

#include <vector>

#include <Eigen/Core>

namespace armsreach::mono_slam {

struct Region {
  struct Span {
    int begin = 0;
    int end = 0;  // one past the last; empty when not above begin
  };
  int top = 0;
  std::vector<Span> spans;

  int area() const;
  bool empty() const { return area() == 0; }
};

// Pixels within `deviations` of the centre, Mahalanobis.
Region ellipse(const Eigen::Vector2d& centre, const Eigen::Matrix2d& covariance, double deviations);
// Pixels within `radius` of the centre in both directions.
Region square(const Eigen::Vector2d& centre, int radius);
// Whole image.
Region everywhere(int width, int height);

// Line by line the span that covers both.
Region merged(const Region& a, const Region& b);
// Cut to pixels at least `border` from the edge of an image.
Region within(const Region& region, int width, int height, int border);
// In an image of half the size.
Region halved(const Region& region);

}  // namespace armsreach::mono_slam
