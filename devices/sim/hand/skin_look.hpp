// The colours of skin, nails and sleeve, and how light falls on a posed hand.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "devices/sim/hand/hand_surface.hpp"
#include "devices/sim/hand/skin_tone.hpp"
#include "devices/sim/world.hpp"

namespace armsreach::sim {

// Of every vertex: sRGB 0..1, red first.
std::vector<Eigen::Vector3f> colors_of(const HandSurface& surface, SkinTone tone,
                                       const Color& sleeve);

// Light that reaches a posed surface, of a right hand in its own frame: the share of what comes
// from all sides that the hand itself lets through to each vertex.
std::vector<float> openness(const HandSkeleton& skeleton, const HandAnatomy& anatomy,
                            const PosedSurface& posed);

// `light` and `eye` are in the frame of the surface that is lit; `up` is where Light::above comes
// from.
struct Lighting {
  Light light;
  Eigen::Vector3f up{0, 0, 1};
  Eigen::Vector3f eye{0, 0, 0};
};
// Of every vertex as it is seen: B G R in 0..255; black where it is turned away.
std::vector<Eigen::Vector3f> lit(const std::vector<Eigen::Vector3f>& colors,
                                 const std::vector<float>& openness, const PosedSurface& placed,
                                 const Lighting& lighting);

}  // namespace armsreach::sim
