// Curves over time as SVG: panels one below the other on one axis of time.
#pragma once

#include <ostream>
#include <string>
#include <vector>

namespace armsreach::app {

struct TimeCurve {
  std::string label;
  std::vector<double> values;  // as many as times
};

struct TimePanel {
  std::string label;  // of the vertical axis
  std::vector<TimeCurve> curves;
};

struct TimePlot {
  std::string title;
  std::vector<double> times;  // s, rising
  std::vector<TimePanel> panels;
};

void write_svg(std::ostream& out, const TimePlot& plot);

}  // namespace armsreach::app
