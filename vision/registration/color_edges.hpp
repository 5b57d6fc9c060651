// Where brightness changes in a colour image, as fields that a contour can be compared with.
#pragma once

#include <opencv2/core/mat.hpp>

#include "vision/registration/occluding_contours.hpp"

namespace armsreach {

// Magnitudes of the derivatives along columns and rows, at half the image's size.
struct ColorEdges {
  cv::Mat along_x;  // CV_8U grey levels a pixel
  cv::Mat along_y;
};

// `image` is 8-bit colour or grey.
ColorEdges color_edges(const cv::Mat& image);

// How much an edge of either direction stands out from its surroundings, 0..1, as seen through a
// Gaussian: a wide one leads from afar, a narrow one is exact.
class EdgeField {
 public:
  EdgeField(const ColorEdges& edges, double sigma);  // px of the full image

  // Bilinear, at a pixel of the full image; the field's mean where the image does not reach.
  float at(float x, float y, Across across) const;

 private:
  cv::Mat along_x_;  // CV_32F
  cv::Mat along_y_;
  float mean_ = 0;
};

}  // namespace armsreach
