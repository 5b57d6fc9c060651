// The look: a dark calm theme with one accent colour. sRGB.
#pragma once

#include <array>
#include <cstdint>

#include <Eigen/Core>

namespace armsreach::render::theme {

using Color = std::array<std::uint8_t, 4>;

inline constexpr Color kAccent{88, 214, 190, 255};
inline constexpr Color kGood{104, 211, 145, 255};
inline constexpr Color kWarning{246, 190, 92, 255};
inline constexpr Color kBad{240, 108, 108, 255};
inline constexpr Color kInk{232, 236, 240, 255};
inline constexpr Color kQuiet{146, 156, 168, 255};
inline constexpr Color kDesk{16, 19, 23, 255};
inline constexpr Color kPanel{25, 29, 35, 255};
inline constexpr Color kRaised{37, 43, 51, 255};
inline constexpr Color kLine{52, 60, 70, 255};
inline constexpr Color kGlass{13, 16, 20, 200};  // behind text on the video

inline constexpr float kTextSize = 17;  // px
inline constexpr float kRounding = 8;   // px, of panels and views
inline constexpr float kSmallRounding = 5;

inline Eigen::Vector3f rgb(const Color& color) {
  return Eigen::Vector3f(color[0], color[1], color[2]) / 255.F;
}
inline Eigen::Vector4f rgba(const Color& color) {
  return Eigen::Vector4f(color[0], color[1], color[2], color[3]) / 255.F;
}

}  // namespace armsreach::render::theme
