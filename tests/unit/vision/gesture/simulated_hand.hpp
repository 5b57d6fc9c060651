// Outlines of one simulated hand, for tests of what is seen of hands.
#pragma once

#include <opencv2/core/mat.hpp>

#include "devices/sim/hand/gesture.hpp"
#include "devices/sim/hand/silhouette.hpp"

namespace armsreach::test {

constexpr int kHandImage = 240;  // px, width and height

// CV_8UC1, 255 on the hand. `forearm` in metres behind the wrist: 0.28 reaches the image's border,
// 0.02 is a hand cut out.
cv::Mat simulated_hand(sim::Gesture gesture, const sim::HandView& view, double forearm = 0.02);

}  // namespace armsreach::test
