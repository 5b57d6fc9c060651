#include "simulated_hand.hpp"

namespace armsreach::test {

cv::Mat simulated_hand(sim::Gesture gesture, const sim::HandView& view, double forearm) {
  sim::HandSurfaceOptions options;
  options.cell = 0.005;
  options.forearm = forearm;
  const sim::HandSurface surface(sim::mean_anatomy(), options);
  sim::SilhouetteCamera camera(kHandImage);
  return camera.draw(surface, sim::pose_of(gesture, surface.anatomy()), view) > 0;
}

}  // namespace armsreach::test
