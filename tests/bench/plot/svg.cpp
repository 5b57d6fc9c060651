#include "tests/bench/plot/svg.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <limits>
#include <numeric>
#include <vector>

namespace armsreach::plot {
namespace {

constexpr double kWidth = 760;
constexpr double kHeight = 480;
constexpr double kLeft = 70;
constexpr double kRight = 560;  // the labels stand beyond
constexpr double kTop = 60;
constexpr double kBottom = 410;
// Ours, then the peers.
constexpr const char* kColours[] = {"#0b6e4f", "#c8553d", "#4f6d9a", "#9a7b4f"};

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.4g", value);
  return text;
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    out += c == '&' ? "&amp;" : c == '<' ? "&lt;" : std::string(1, c);
  }
  return out;
}

// One axis from value to place on the page.
class LogAxis {
 public:
  LogAxis(double least, double most, double from, double to)
      : low_(std::log10(least)), high_(std::log10(most)), from_(from), to_(to) {
    const double room = 0.06 * std::max(high_ - low_, 0.1);
    low_ -= room;
    high_ += room;
  }
  double at(double value) const {
    return from_ + (to_ - from_) * (std::log10(value) - low_) / (high_ - low_);
  }
  bool in_sight(double value) const {
    return std::log10(value) >= low_ && std::log10(value) <= high_;
  }
  // 1, 2 and 5 of each decade in sight.
  std::vector<double> ticks() const {
    std::vector<double> found;
    for (double decade = std::floor(low_); decade <= high_; ++decade) {
      for (const double step : {1.0, 2.0, 5.0}) {
        const double value = step * std::pow(10, decade);
        if (in_sight(value)) found.push_back(value);
      }
    }
    return found;
  }

 private:
  double low_, high_, from_, to_;
};

class Drawing {
 public:
  Drawing(std::ostream& out, const Figure& figure)
      : out_(out),
        figure_(figure),
        x_(axis(&Point::x, kLeft, kRight)),
        y_(axis(&Point::y, kBottom, kTop)) {}

  void draw(const std::string& footer) {
    out_ << "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" << kWidth << "\" height=\""
         << kHeight << "\" font-family=\"Inter, Helvetica, Arial, sans-serif\" font-size=\"12\">\n"
         << "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n";
    text(kLeft, 30, "start", "#222", figure_.title, "font-size=\"16\" font-weight=\"600\"");
    grid();
    for (std::size_t i = 0; i < figure_.curves.size(); ++i) curve(i);
    for (std::size_t i = 1; i < figure_.curves.size(); ++i) ratios(i);
    labels();
    text(kLeft, kHeight - 12, "start", "#999", footer, "font-size=\"10\"");
    out_ << "</svg>\n";
  }

 private:
  LogAxis axis(double Point::*value, double from, double to) const {
    double least = std::numeric_limits<double>::infinity();
    double most = 0;
    for (const Curve& curve : figure_.curves) {
      for (const Point& point : curve.points) {
        least = std::min(least, point.*value);
        most = std::max(most, point.*value);
      }
    }
    return {least, most, from, to};
  }

  const char* colour(std::size_t curve) const { return kColours[curve % std::size(kColours)]; }

  void text(double x, double y, const char* anchor, const char* fill, const std::string& content,
            const char* more = "") {
    out_ << "<text x=\"" << x << "\" y=\"" << y << "\" text-anchor=\"" << anchor << "\" fill=\""
         << fill << "\" " << more << ">" << escaped(content) << "</text>\n";
  }

  void line(double x0, double y0, double x1, double y1) {
    out_ << "<line x1=\"" << x0 << "\" y1=\"" << y0 << "\" x2=\"" << x1 << "\" y2=\"" << y1
         << "\" stroke=\"#e4e4e4\"/>\n";
  }

  // The sizes that were measured, where they are whole; else round numbers.
  std::vector<double> x_ticks() const {
    std::vector<double> found;
    for (const Point& point : figure_.curves[0].points) found.push_back(point.x);
    const bool round =
        std::all_of(found.begin(), found.end(), [](double x) { return x == std::round(x); });
    return round && found.size() <= 8 ? found : x_.ticks();
  }

  void grid() {
    for (const double value : x_ticks()) {
      line(x_.at(value), kTop, x_.at(value), kBottom);
      text(x_.at(value), kBottom + 18, "middle", "#555", number(value));
    }
    for (const double value : y_.ticks()) {
      line(kLeft, y_.at(value), kRight, y_.at(value));
      text(kLeft - 8, y_.at(value) + 4, "end", "#555", number(value));
    }
    text((kLeft + kRight) / 2, kBottom + 38, "middle", "#222", figure_.x_label);
    text(kLeft, kTop - 10, "start", "#222", figure_.y_label);
  }

  void curve(std::size_t index) {
    const Curve& curve = figure_.curves[index];
    out_ << "<polyline fill=\"none\" stroke-width=\"2\" stroke=\"" << colour(index)
         << "\" points=\"";
    for (const Point& p : curve.points) out_ << x_.at(p.x) << ',' << y_.at(p.y) << ' ';
    out_ << "\"/>\n";
    for (const Point& p : curve.points) {
      out_ << "<circle r=\"3.5\" fill=\"" << colour(index) << "\" cx=\"" << x_.at(p.x) << "\" cy=\""
           << y_.at(p.y) << "\"/>\n";
    }
  }

  // Beside the curves' last points, lowest first, each clear of the one below.
  void labels() {
    std::vector<std::size_t> order(figure_.curves.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto end = [this](std::size_t i) { return y_.at(figure_.curves[i].points.back().y); };
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return end(a) > end(b); });
    double free_above = kBottom;
    for (const std::size_t i : order) {
      const double y = std::min(end(i) + 4, free_above);
      text(kRight + 10, y, "start", colour(i), figure_.curves[i].label);
      free_above = y - 15;
    }
  }

  // How many times ours a peer takes, at each x that both have.
  void ratios(std::size_t index) {
    for (const Point& peer : figure_.curves[index].points) {
      for (const Point& ours : figure_.curves[0].points) {
        if (std::abs(ours.x - peer.x) > 1e-6 * peer.x) continue;
        const double ratio = peer.y / ours.y;
        char label[32];
        std::snprintf(label, sizeof(label), ratio < 9.95 ? "%.1fx" : "%.0fx", ratio);
        text(x_.at(peer.x), y_.at(peer.y) - 9, "middle", colour(index), label, "font-size=\"11\"");
      }
    }
  }

  std::ostream& out_;
  const Figure& figure_;
  LogAxis x_;
  LogAxis y_;
};

}  // namespace

void write_svg(std::ostream& out, const Figure& figure, const std::string& footer) {
  Drawing(out, figure).draw(footer);
}

}  // namespace armsreach::plot
