// Colour models as small readable files:
//
//   cells: 128             # along U and V of BT.601 in full range
//   with_luma: false       # whether brightness tells classes apart too
//   level: [B, G, R]       # the first class's, 0..255, for colour balance; may be left out
//   balance: [B, G, R]     # gains applied to each channel first; may be left out
//   background: {luma: [16 numbers], uv: [[v, u, count, count, ...], ...]}
//   classes: [{name: skin, luma: ..., uv: ...}, ...]
//
// A row of `uv` holds the counts of cells u, u + 1, ... of row v. Counts are shares: only their
// ratios within one class matter; written are parts in a million.
#pragma once

#include <istream>
#include <ostream>
#include <string>

#include "vision/core/result.hpp"
#include "vision/gesture/color_model.hpp"

namespace armsreach::gesture {

Result<ColorModel> read_color_model(std::istream& in, const std::string& where);
void write_color_model(std::ostream& out, const ColorModel& model);

}  // namespace armsreach::gesture
