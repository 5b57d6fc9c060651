// The light that an infra-red camera receives: from tape that sends it straight back, and a little
// from everything else.
#pragma once

#include <vector>

#include <opencv2/core/mat.hpp>

#include "devices/sim/hand/raster.hpp"
#include "devices/sim/infrared/infrared_description.hpp"
#include "devices/sim/infrared/infrared_hand.hpp"
#include "devices/sim/infrared/tape.hpp"
#include "devices/sim/world.hpp"

namespace armsreach::sim {

// The share of its light that tape sends back when it arrives at an angle: nearly all up to 45 deg,
// half at 55, next to nothing at 70, as makers of glass-bead tape describe it.
double tape_returns(double incidence);

// One camera that stays where it is, before things that do.
class InfraredView {
 public:
  InfraredView(const World& world, const InfraredDescription& description);

  void clear();  // begins a picture with what always stands there
  void draw_hand(const InfraredHand& hand, const InfraredHand::Moment& moment);
  // Returns the share of the tape that is seen (MarkerTruth::visible). After the hand.
  double draw_tape(const TapePiece& piece_in_camera);

  const cv::Mat& light() const { return light_; }  // CV_32F grey levels

 private:
  struct Look {
    float albedo = 0;  // at 880 nm
    float shine = 0;   // as Material::shine
  };
  void draw_things(const World& world);
  // `looks`: of the surfaces with ids 1, 2, ...
  void shade(const Raster::Images& images, const std::vector<Look>& looks);
  // Adds a facet's light; returns its area in px that is seen.
  double add_facet(const std::vector<Eigen::Vector2d>& outline, double depth, float level);

  InfraredDescription description_;
  Raster raster_;
  cv::Mat rays_;  // CV_32FC2: x and y of the ray of every pixel, z = 1
  cv::Mat still_light_;
  cv::Mat still_depth_;
  cv::Mat light_;
  cv::Mat depth_;  // CV_32F m, NaN where nothing is
};

}  // namespace armsreach::sim
