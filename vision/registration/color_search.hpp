// The colour camera that agrees best with a set of views, and how far that can be relied on.
#pragma once

#include <array>
#include <vector>

#include "vision/core/camera.hpp"
#include "vision/registration/agreement.hpp"
#include "vision/registration/color_hypothesis.hpp"

namespace armsreach {

// m: arm's length, a table, a room.
inline constexpr std::array<double, 3> kUncertaintyDepths = {0.5, 1, 4};

struct ColorSearchResult {
  ColorHypothesis best = ColorHypothesis::Zero();
  double displacement = 0;  // px rms: from where coinciding cameras would put the scene
  // Standard deviation of where `best` puts the scene, px rms.
  double uncertainty = 0;
  // The same of a scene all at one depth. Contours at a few depths only leave the baseline, which
  // matters up close, and the centre to each other.
  std::array<double, kUncertaintyDepths.size()> uncertainty_at{};
  double nearest = 0;  // m: between these are nine of ten contours
  double farthest = 0;
  double contrast = 0;  // agreement of `best` over that of hypotheses all around it
  // Agreement as a share of that contrast: 0 is that of hypotheses all around the best, 1 that of
  // the best.
  double registered_share = 0;  // of coinciding cameras
  double rival_share = 0;       // of the best hypothesis elsewhere
};

// `assumed` is the colour camera that registered images would have. `views` must not be empty, nor
// any of them be without contours.
ColorSearchResult search_color_camera(const std::vector<ContourView>& views, const Camera& assumed);

}  // namespace armsreach
