// What to draw of a benchmark run: figures.json names curves, a run's JSON holds their points.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace armsreach::plot {

struct Point {
  double x = 0;
  double y = 0;
};

struct Curve {
  std::string label;
  std::vector<Point> points;  // x rising
};

// Log-log. The first curve is ours; the others are its peers.
struct Figure {
  std::string file;  // without folder and extension
  std::string title;
  std::string x_label;
  std::string y_label;
  std::vector<Curve> curves;
};

// The figure that `spec` describes, from `benchmarks` (Google Benchmark's array of that name).
// Nothing when the run has not two points of each of its curves, as after a filter.
//
// A curve takes the runs of one `family` (the benchmark's name before its arguments) whose
// arguments are as in `where`; `x` and `value` name an argument or a counter. Arguments without a
// name are called by their position, "0" first.
std::optional<Figure> make_figure(const nlohmann::json& spec, const nlohmann::json& benchmarks);

}  // namespace armsreach::plot
