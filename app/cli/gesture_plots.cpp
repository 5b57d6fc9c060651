#include "app/cli/gesture_plots.hpp"

#include <algorithm>
#include <array>
#include <iomanip>
#include <set>
#include <utility>

namespace armsreach::app {
namespace {

constexpr double kPlot = 400;  // px, side of the curves' square
constexpr double kLeft = 60;
constexpr double kTop = 30;
constexpr double kCell = 56;         // px, of the matrix
constexpr double kMatrixLeft = 110;  // px, with the rows' names and their title
constexpr double kMatrixTop = 70;
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

// Read from below, `x` and `y` its middle.
void upright_text(std::ostream& out, double x, double y, const std::string& what) {
  out << "<g transform=\"translate(" << x << ' ' << y << ") rotate(-90)\">";
  text(out, 0, 0, "middle", what);
  out << "</g>\n";
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
  upright_text(out, 18, kTop + kPlot / 2, "detection rate");
}

// All gestures in order, then silence.
std::vector<std::string> columns_of(const Confusion& confusion) {
  std::set<std::string> names;
  for (const auto& [truth, row] : confusion) {
    names.insert(truth);
    for (const auto& [name, count] : row) {
      if (!name.empty()) names.insert(name);
    }
  }
  std::vector<std::string> columns(names.begin(), names.end());
  columns.emplace_back();
  return columns;
}

// The deeper the colour, the larger the share of its row.
void cell(std::ostream& out, double x, double y, const char* color, int count, int total) {
  const double share = static_cast<double>(count) / std::max(1, total);
  for (const auto& [fill, opacity] : {std::pair("#f3f3f3", 1.0), std::pair(color, 0.8 * share)}) {
    out << "<rect x=\"" << x << "\" y=\"" << y << "\" width=\"" << kCell - 2 << "\" height=\""
        << kCell - 2 << "\" rx=\"4\" fill=\"" << fill << "\" fill-opacity=\""
        << std::setprecision(3) << opacity << std::setprecision(1) << "\"/>\n";
  }
  if (count > 0) text(out, x + kCell / 2 - 1, y + kCell / 2 + 4, "middle", std::to_string(count));
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
  const std::vector<std::string> columns = columns_of(confusion);
  const double width = kCell * static_cast<double>(columns.size());
  const double height = kCell * static_cast<double>(confusion.size());
  begin(out, kMatrixLeft + width + 20, kMatrixTop + height + 20);
  text(out, kMatrixLeft + width / 2, 22, "middle", "told");
  upright_text(out, 22, kMatrixTop + height / 2, "shown");
  for (std::size_t i = 0; i < columns.size(); ++i) {
    text(out, kMatrixLeft + kCell * (static_cast<double>(i) + 0.5), kMatrixTop - 12, "middle",
         columns[i].empty() ? "nothing" : columns[i]);
  }
  double y = kMatrixTop;
  for (const auto& [truth, row] : confusion) {
    int total = 0;
    for (const auto& [name, count] : row) total += count;
    text(out, kMatrixLeft - 10, y + kCell / 2 + 4, "end", truth);
    double x = kMatrixLeft;
    for (const std::string& column : columns) {
      const auto found = row.find(column);
      const char* color = column.empty() ? "#888888" : column == truth ? "#0b5fff" : "#d1495b";
      cell(out, x, y, color, found == row.end() ? 0 : found->second, total);
      x += kCell;
    }
    y += kCell;
  }
  out << "</svg>\n";
}

}  // namespace armsreach::app
