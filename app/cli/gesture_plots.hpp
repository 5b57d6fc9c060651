// Figures of how well gestures are told, as SVG.
#pragma once

#include <map>
#include <ostream>
#include <string>
#include <vector>

#include "vision/gesture/detection_curve.hpp"

namespace armsreach::app {

struct NamedCurve {
  std::string name;
  std::vector<gesture::CurvePoint> curve;
};
// Figure 3 of the wearable paper: one curve for each number of samples.
void write_curves_svg(std::ostream& out, const std::vector<NamedCurve>& curves);

// How often each gesture shown (row) was told as which (column; "" is silence).
using Confusion = std::map<std::string, std::map<std::string, int>>;
void write_confusion_svg(std::ostream& out, const Confusion& confusion);

}  // namespace armsreach::app
