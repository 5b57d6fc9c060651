#include "tests/bench/plot/figure.hpp"

#include <algorithm>
#include <map>
#include <sstream>
#include <stdexcept>

#include <nlohmann/json.hpp>

namespace armsreach::plot {
namespace {

using nlohmann::json;

// "name/mm:10/80" is the family "name" with the arguments {mm: 10, "1": 80}.
struct Run {
  std::string family;
  std::map<std::string, double> values;  // arguments, counters and times
};

Run run_from(const json& benchmark) {
  Run run;
  for (const auto& [key, value] : benchmark.items()) {
    if (value.is_number()) run.values[key] = value.get<double>();
  }
  std::istringstream pieces(benchmark.at("name").get<std::string>());
  std::getline(pieces, run.family, '/');
  int position = 0;
  for (std::string piece; std::getline(pieces, piece, '/'); ++position) {
    const std::size_t colon = piece.find(':');
    const std::string name =
        colon == std::string::npos ? std::to_string(position) : piece.substr(0, colon);
    const std::string number = colon == std::string::npos ? piece : piece.substr(colon + 1);
    try {
      run.values[name] = std::stod(number);
    } catch (const std::invalid_argument&) {
      run.family += "/" + piece;  // a captured name, part of the benchmark's own
    }
  }
  return run;
}

bool fits(const Run& run, const json& curve) {
  if (run.family != curve.at("family").get<std::string>()) return false;
  const json where = curve.value("where", json::object());
  return std::all_of(where.items().begin(), where.items().end(), [&](const auto& entry) {
    const auto found = run.values.find(entry.key());
    return found != run.values.end() && found->second == entry.value().template get<double>();
  });
}

Curve make_curve(const json& spec, const std::string& x, const std::vector<Run>& runs) {
  Curve curve{spec.at("label").get<std::string>(), {}};
  const std::string value = spec.value("value", "cpu_time");
  for (const Run& run : runs) {
    if (!fits(run, spec) || run.values.count(x) == 0 || run.values.count(value) == 0) continue;
    curve.points.push_back({run.values.at(x), run.values.at(value)});
  }
  std::sort(curve.points.begin(), curve.points.end(),
            [](const Point& a, const Point& b) { return a.x < b.x; });
  return curve;
}

}  // namespace

std::optional<Figure> make_figure(const json& spec, const json& benchmarks) {
  std::vector<Run> runs;
  for (const json& benchmark : benchmarks) runs.push_back(run_from(benchmark));
  Figure figure{spec.at("file").get<std::string>(),
                spec.at("title").get<std::string>(),
                spec.at("x_label").get<std::string>(),
                spec.at("y_label").get<std::string>(),
                {}};
  for (const json& curve : spec.at("curves")) {
    figure.curves.push_back(make_curve(curve, spec.at("x").get<std::string>(), runs));
    if (figure.curves.back().points.size() < 2) return std::nullopt;
  }
  return figure;
}

}  // namespace armsreach::plot
