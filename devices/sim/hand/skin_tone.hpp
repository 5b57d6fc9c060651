// Skins, from pale to dark.
#pragma once

#include <optional>
#include <string_view>

#include <Eigen/Core>

namespace armsreach::sim {

enum class SkinTone { pale, light, medium, tan, brown, dark };
inline constexpr int kSkinToneCount = 6;
std::string_view name(SkinTone tone);
std::optional<SkinTone> skin_tone_named(std::string_view name);

struct SkinColors {      // sRGB 0..1, red first
  Eigen::Vector3f back;  // of hand and arm
  Eigen::Vector3f palm;
  Eigen::Vector3f nail;
};
const SkinColors& colors_of(SkinTone tone);

}  // namespace armsreach::sim
