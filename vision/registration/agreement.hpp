// How well the contours of depth images lie on the edges of their colour images.
#pragma once

#include <array>
#include <vector>

#include "vision/core/camera.hpp"
#include "vision/registration/color_edges.hpp"
#include "vision/registration/color_hypothesis.hpp"
#include "vision/registration/occluding_contours.hpp"

namespace armsreach {

// What is kept of one frame.
struct ContourView {
  std::vector<ContourPoint> contours;
  std::vector<Eigen::Vector3d> scene;  // points in the depth camera's frame, all over its image
  cv::Size depth_size;
  ColorEdges edges;
};

class Agreement {
 public:
  // Seen through a Gaussian of `sigma` px of an image 640 wide; of all contours at most about
  // `most` are used.
  Agreement(const std::vector<ContourView>& views, const Camera& assumed, double sigma,
            std::size_t most);

  // The depth image is parted into cells.
  static constexpr int kParts = 8;
  struct Part {
    double sum = 0;
    int count = 0;  // of contours, whatever the hypothesis
  };
  using Parts = std::array<Part, kParts>;
  Parts parts(const ColorHypothesis& hypothesis) const;

  // Mean over the contours, 0..1.
  double operator()(const ColorHypothesis& hypothesis) const { return without(hypothesis, -1); }
  double without(const ColorHypothesis& hypothesis, int left_out) const;

 private:
  struct Placed {
    Eigen::Vector3d point_in_depth;
    Across across;
    int part;
    const EdgeField* field;
  };
  Camera assumed_;
  std::vector<EdgeField> fields_;
  std::vector<Placed> points_;
};

}  // namespace armsreach
