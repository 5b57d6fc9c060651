// An infra-red camera with a ring of lamps around its lens, and what a hand wears for it, as plain
// data.
#pragma once

#include <optional>

#include "devices/sim/infrared/worn.hpp"
#include "vision/core/camera.hpp"
#include "vision/core/pose.hpp"

namespace armsreach::sim {

// Light is measured in grey levels that it would give without noise or saturation (255 is white).
// Everything that sends back light is lit with the square of its distance less of it; a picture's
// brightness does not depend on the distance that it then has to come back.
struct InfraredDescription {
  Camera camera;
  Pose world_from_camera;
  double rate = 60;  // Hz
  // Lamps at 880 nm flash for 0.5 ms while the whole sensor is exposed: motion in it is not drawn
  // (a hand at 1 m/s moves 0.4 px at 0.8 m).
  double tape_level = 1500;  // of tape that faces the camera at 1 m
  double white_level = 8;    // of a white wall instead
  double noise = 1;          // of the sensor, in units of its usual; 0: none

  std::optional<BraceletDescription> bracelet;  // worn by the world's first hand, a right one
  std::optional<GloveDescription> glove;
};

}  // namespace armsreach::sim
