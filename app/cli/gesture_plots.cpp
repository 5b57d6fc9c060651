#include "app/cli/gesture_plots.hpp"

#include <algorithm>
#include <array>
#include <iomanip>
#include <set>

namespace armsreach::app {
namespace {

constexpr double kPlot = 400;  // px, side of the curves' square
constexpr double kLeft = 60;
constexpr double kTop = 30;
constexpr double kCell = 56;      // px, of the matrix
constexpr double kMostFalse = 1;  // shown range of false detections
constexpr std::array<const char*, 6> kColors{"#0b5fff", "#d1495b", "#2e8b57",
                                             "#b8860b", "#7b4fb0", "#444444"};

void begin(std::ostream& out, double width, double height) {
  out << std::fixed << std::setprecision(1);
  out << "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" << width << "\" height=\"" << height
      << "\" viewBox=\"0 0 " << width << ' ' << height
      << "\" font-family=\"Inter, sans-serif\" font-size=\"13\">\n"
      << "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n";
}

void text(std::ostream& out, double x, double y, const char* anchor, const std::string& what) {
  out << "<text x=\"" << x << "\" y=\"" << y << "\" text-anchor=\"" << anchor << "\">";
  for (const char c : what) {
    if (c == '<')
      out << "&lt;";
    else if (c == '&')
      out << "&amp;";
    else
      out << c;
  }
  out << "</text>\n";
}

void axes(std::ostream& out) {
  for (int tenth = 0; tenth <= 10; tenth += 2) {
    const double at = kPlot * tenth / 10;
    out << "<path d=\"M" << kLeft + at << ' ' << kTop << "v" << kPlot << "M" << kLeft << ' '
        << kTop + at << "h" << kPlot << "\" stroke=\"#dddddd\"/>\n";
    std::string number = tenth == 10 ? "1" : "0." + std::to_string(tenth);
    text(out, kLeft + at, kTop + kPlot + 18, "middle", number);
    text(out, kLeft - 8, kTop + kPlot - at + 4, "end", number);
  }
  text(out, kLeft + kPlot / 2, kTop + kPlot + 40, "middle", "false positive rate");
  out << "<g transform=\"translate(18 " << kTop + kPlot / 2 << ") rotate(-90)\">";
  text(out, 0, 0, "middle", "detection rate");
  out << "</g>\n";
}

}  // namespace

void write_curves_svg(std::ostream& out, const std::vector<NamedCurve>& curves) {
  begin(out, kLeft + kPlot + 30, kTop + kPlot + 60);
  axes(out);
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const char* color = kColors[i % kColors.size()];
    out << "<path fill=\"none\" stroke-width=\"2\" stroke=\"" << color << "\" d=\"";
    for (std::size_t p = 0; p < curves[i].curve.size(); ++p) {
      const auto& point = curves[i].curve[p];
      out << (p == 0 ? 'M' : 'L') << kLeft + kPlot * point.false_rate / kMostFalse << ' '
          << kTop + kPlot * (1 - point.true_rate);
    }
    out << "\"/>\n";
    const double y = kTop + kPlot - 24 - 20 * static_cast<double>(curves.size() - 1 - i);
    out << "<path stroke-width=\"3\" stroke=\"" << color << "\" d=\"M" << kLeft + kPlot - 170 << ' '
        << y - 4 << "h20\"/>\n";
    text(out, kLeft + kPlot - 142, y, "start", curves[i].name);
  }
  out << "</svg>\n";
}

void write_confusion_svg(std::ostream& out, const Confusion& confusion) {
  std::set<std::string> names;
  for (const auto& [truth, row] : confusion) {
    names.insert(truth);
    for (const auto& [name, count] : row) {
      if (!name.empty()) names.insert(name);
    }
  }
  std::vector<std::string> columns(names.begin(), names.end());
  columns.emplace_back();
  const double left = 90;
  begin(out, left + kCell * static_cast<double>(columns.size()) + 20,
        kTop + kCell * static_cast<double>(confusion.size()) + 40);
  double y = kTop;
  for (const auto& [truth, row] : confusion) {
    int total = 0;
    for (const auto& [name, count] : row) total += count;
    text(out, left - 10, y + kCell / 2 + 4, "end", truth);
    double x = left;
    for (const std::string& column : columns) {
      const auto found = row.find(column);
      const int count = found == row.end() ? 0 : found->second;
      const double share = static_cast<double>(count) / std::max(1, total);
      const char* color = column.empty() ? "#888888" : column == truth ? "#0b5fff" : "#d1495b";
      out << "<rect x=\"" << x << "\" y=\"" << y << "\" width=\"" << kCell - 2 << "\" height=\""
          << kCell - 2 << "\" rx=\"4\" fill=\"#f3f3f3\"/>\n"
          << "<rect x=\"" << x << "\" y=\"" << y << "\" width=\"" << kCell - 2 << "\" height=\""
          << kCell - 2 << "\" rx=\"4\" fill=\"" << color << "\" fill-opacity=\""
          << std::setprecision(3) << 0.8 * share << std::setprecision(1) << "\"/>\n";
      if (count > 0)
        text(out, x + kCell / 2 - 1, y + kCell / 2 + 4, "middle", std::to_string(count));
      x += kCell;
    }
    y += kCell;
  }
  for (std::size_t i = 0; i < columns.size(); ++i) {
    text(out, left + kCell * (static_cast<double>(i) + 0.5), y + 18, "middle",
         columns[i].empty() ? "silent" : columns[i]);
  }
  out << "</svg>\n";
}

}  // namespace armsreach::app
