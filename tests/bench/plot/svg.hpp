// A figure as SVG: log-log axes, one colour a curve, each peer's points with its ratio to ours.
#pragma once

#include <ostream>
#include <string>

#include "tests/bench/plot/figure.hpp"

namespace armsreach::plot {

// `footer` says where and when it was measured.
void write_svg(std::ostream& out, const Figure& figure, const std::string& footer);

}  // namespace armsreach::plot
