#include "app/evaluation/time_plot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <limits>

namespace armsreach::app {
namespace {

constexpr double kWidth = 860;
constexpr double kLeft = 64;
constexpr double kRight = 720;  // the labels stand beyond
constexpr double kTop = 48;
constexpr double kPanel = 170;
constexpr double kGap = 28;
constexpr std::array kColours{"#0b6e4f", "#c8553d", "#4f6d9a", "#9a7b4f"};

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.4g", std::abs(value) < 1e-12 ? 0 : value);
  return text;
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '&' ? "&amp;" : c == '<' ? "&lt;" : std::string(1, c);
  return out;
}

// From values to places on the page.
struct Axis {
  double low, high, from, to;
  double at(double value) const { return from + (to - from) * (value - low) / (high - low); }
  // About five, at 1, 2 or 5 times a power of ten.
  std::vector<double> ticks() const {
    const double rough = (high - low) / 5;
    const double decade = std::pow(10, std::floor(std::log10(rough)));
    double step = decade;
    for (const double factor : {2.0, 5.0, 10.0})
      if (step < rough) step = factor * decade;
    std::vector<double> found;
    for (double tick = std::ceil(low / step) * step; tick <= high; tick += step)
      found.push_back(tick);
    return found;
  }
};

Axis value_axis(const TimePanel& panel, double top) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const TimeCurve& curve : panel.curves) {
    for (const double value : curve.values) {
      low = std::min(low, value);
      high = std::max(high, value);
    }
  }
  if (!(high - low > 1e-9)) {
    low = std::isfinite(low) ? low - 0.5 : 0;
    high = low + 1;
  }
  const double room = 0.05 * (high - low);
  return {low - room, high + room, top + kPanel, top};
}

void text(std::ostream& out, double x, double y, const std::string& anchor,
          const std::string& words, const std::string& more = "") {
  out << "<text x=\"" << number(x) << "\" y=\"" << number(y) << "\" text-anchor=\"" << anchor
      << "\" " << more << ">" << escaped(words) << "</text>\n";
}

void line(std::ostream& out, double x1, double y1, double x2, double y2) {
  out << "<path d=\"M" << number(x1) << " " << number(y1) << "L" << number(x2) << " " << number(y2)
      << "\" stroke=\"#ddd\" fill=\"none\"/>\n";
}

void draw_panel(std::ostream& out, const TimePlot& plot, const TimePanel& panel, const Axis& time,
                double top) {
  const Axis value = value_axis(panel, top);
  for (const double tick : value.ticks()) {
    line(out, kLeft, value.at(tick), kRight, value.at(tick));
    text(out, kLeft - 6, value.at(tick) + 4, "end", number(tick));
  }
  for (const double tick : time.ticks()) line(out, time.at(tick), top, time.at(tick), top + kPanel);
  text(out, kLeft, top - 6, "start", panel.label);
  for (std::size_t i = 0; i < panel.curves.size(); ++i) {
    const TimeCurve& curve = panel.curves[i];
    const char* colour = kColours[i % kColours.size()];
    out << "<path fill=\"none\" stroke-width=\"1.5\" stroke=\"" << colour << "\" d=\"";
    for (std::size_t k = 0; k < curve.values.size(); ++k) {
      out << (k ? "L" : "M") << number(time.at(plot.times[k])) << " "
          << number(value.at(curve.values[k]));
    }
    out << "\"/>\n";
    text(out, kRight + 10, top + 14 + 18 * static_cast<double>(i), "start", curve.label,
         std::string("fill=\"") + colour + "\"");
  }
}

}  // namespace

void write_svg(std::ostream& out, const TimePlot& plot) {
  const auto panels = static_cast<double>(plot.panels.size());
  const double bottom = kTop + 16 + panels * (kPanel + kGap) - kGap;
  const double first = plot.times.empty() ? 0 : plot.times.front();
  const double last = plot.times.empty() ? 1 : plot.times.back();
  const Axis time{first, std::max(last, first + 1e-3), kLeft, kRight};
  out << "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" << kWidth << "\" height=\""
      << number(bottom + 48) << "\" font-family=\"sans-serif\" font-size=\"12\">\n"
      << "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n";
  text(out, kLeft, 24, "start", plot.title, "font-size=\"15\"");
  double top = kTop + 16;
  for (const TimePanel& panel : plot.panels) {
    draw_panel(out, plot, panel, time, top);
    top += kPanel + kGap;
  }
  for (const double tick : time.ticks())
    text(out, time.at(tick), bottom + 18, "middle", number(tick));
  text(out, (kLeft + kRight) / 2, bottom + 38, "middle", "time / s");
  out << "</svg>\n";
}

}  // namespace armsreach::app
