// The colour camera that agrees best with a set of views, and how far that can be relied on.
#pragma once

#include <vector>

#include "vision/core/camera.hpp"
#include "vision/registration/agreement.hpp"
#include "vision/registration/color_hypothesis.hpp"

namespace armsreach {

struct ColorSearchResult {
  ColorHypothesis best = ColorHypothesis::Zero();
  double displacement = 0;  // px rms: from where coinciding cameras would put the scene
  // Of where `best` puts the scene, px rms: the jackknife's standard deviation over parts of the
  // image.
  double uncertainty = 0;
  double contrast = 0;  // agreement of `best` over that of hypotheses all around it
  // Agreement as a share of that contrast: 0 is that of hypotheses all around the best, 1 that of
  // the best.
  double registered_share = 0;  // of coinciding cameras
  double rival_share = 0;       // of the best hypothesis elsewhere
};

// `assumed` is the colour camera that registered images would have. `views` must not be empty.
ColorSearchResult search_color_camera(const std::vector<ContourView>& views, const Camera& assumed);

}  // namespace armsreach
