#include "devices/sim/hand/skin_tone.hpp"

#include <array>
#include <cstddef>

namespace armsreach::sim {
namespace {

using Eigen::Vector3f;

struct Tone {
  std::string_view name;
  SkinColors colors;
};

Vector3f rgb(int hex) {
  return Vector3f(static_cast<float>(hex >> 16), static_cast<float>((hex >> 8) & 255),
                  static_cast<float>(hex & 255)) /
         255;
}

const std::array<Tone, kSkinToneCount>& tones() {
  static const std::array<Tone, kSkinToneCount> all{
      Tone{"pale", {rgb(0xf0cdb8), rgb(0xf2bfb0), rgb(0xf2bcb4)}},
      Tone{"light", {rgb(0xe3b598), rgb(0xe8ab98), rgb(0xeeb5a9)}},
      Tone{"medium", {rgb(0xcf9a78), rgb(0xdba088), rgb(0xe5ab9c)}},
      Tone{"tan", {rgb(0xb07c58), rgb(0xcb957a), rgb(0xd3a390)}},
      Tone{"brown", {rgb(0x84563c), rgb(0xb98468), rgb(0xb98a78)}},
      Tone{"dark", {rgb(0x563626), rgb(0xa2735b), rgb(0x9c7365)}}};
  return all;
}

}  // namespace

std::string_view name(SkinTone tone) { return tones()[static_cast<std::size_t>(tone)].name; }

const SkinColors& colors_of(SkinTone tone) {
  return tones()[static_cast<std::size_t>(tone)].colors;
}

std::optional<SkinTone> skin_tone_named(std::string_view name) {
  for (std::size_t i = 0; i < tones().size(); ++i) {
    if (tones()[i].name == name) return static_cast<SkinTone>(i);
  }
  return std::nullopt;
}

}  // namespace armsreach::sim
