// Printed things: packets, tins and books.
#include <algorithm>
#include <array>
#include <string>

#include <opencv2/imgproc.hpp>

#include "devices/sim/paint.hpp"

namespace armsreach::sim {
namespace {

constexpr int kSide = 512;  // px

// Text as wide as asked for, its baseline at `y`, centred on `x`.
void write_text(cv::Mat& image, const std::string& text, int x, int y, int width,
                const cv::Scalar& color, double weight = 1) {
  constexpr int kFont = cv::FONT_HERSHEY_DUPLEX;
  int baseline = 0;
  const cv::Size plain = cv::getTextSize(text, kFont, 1, 1, &baseline);
  const double scale = static_cast<double>(width) / plain.width;
  const int thickness = std::max(1, static_cast<int>(weight * 2.2 * scale));
  cv::putText(image, text, {x - width / 2, y}, kFont, scale, color, thickness, cv::LINE_AA);
}

// Lines of words too small to read.
void write_small_print(cv::Mat& image, const cv::Rect& area, int line_height,
                       const cv::Scalar& color, Random& random) {
  for (int y = area.y; y + line_height <= area.br().y; y += line_height) {
    int x = area.x;
    while (true) {
      const int word = line_height / 2 + random.below(line_height * 3);
      if (x + word > area.br().x) break;
      cv::rectangle(image, cv::Rect(x, y, word, line_height * 55 / 100), color, cv::FILLED);
      x += word + line_height / 2;
    }
  }
}

void draw_bar_code(cv::Mat& image, const cv::Rect& area, Random& random) {
  cv::rectangle(image, area, cv::Scalar(245, 245, 245), cv::FILLED);
  for (int x = area.x + 6; x < area.br().x - 8;) {
    const int bar = 1 + random.below(4);
    cv::rectangle(image, cv::Rect(x, area.y + 5, bar, area.height - 10), cv::Scalar(25, 25, 25),
                  cv::FILLED);
    x += bar + 2 + random.below(4);
  }
}

// Petals around a disc.
void draw_flower(cv::Mat& image, cv::Point centre, int radius, int petals, const cv::Scalar& petal,
                 const cv::Scalar& disc) {
  for (int i = 0; i < petals; ++i) {
    const double angle = 2 * CV_PI * i / petals;
    const cv::Point at(centre.x + static_cast<int>(0.62 * radius * std::cos(angle)),
                       centre.y + static_cast<int>(0.62 * radius * std::sin(angle)));
    cv::ellipse(image, at, {radius * 38 / 100, radius * 16 / 100}, angle * 180 / CV_PI, 0, 360,
                petal, cv::FILLED, cv::LINE_AA);
  }
  cv::circle(image, centre, radius * 26 / 100, disc, cv::FILLED, cv::LINE_AA);
}

}  // namespace

cv::Mat paint_label(const Material& material, Random& random) {
  static constexpr std::array kWords{"AVENA", "SENCHA",  "POLENTA", "MIRTILLO",
                                     "CACAO", "RISOTTO", "GRANOLA", "CEDRO"};
  const cv::Scalar band = bgr(material.colors[1]);
  const cv::Scalar ink = bgr(material.colors[2]);
  const cv::Scalar accent = bgr(material.colors[3]);
  const int s = kSide;
  cv::Mat image(s, s, CV_8UC3, bgr(material.colors[0]));
  cv::rectangle(image, cv::Rect(0, 0, s, s * 30 / 100), band, cv::FILLED);
  cv::rectangle(image, cv::Rect(0, s * 30 / 100, s, s * 2 / 100), accent, cv::FILLED);
  const std::string word =
      kWords[static_cast<std::size_t>(random.below(static_cast<int>(kWords.size())))];
  write_text(image, word, s / 2, s * 20 / 100, s * 76 / 100, bgr(material.colors[0]), 1.6);
  write_small_print(image, {s * 22 / 100, s * 24 / 100, s * 56 / 100, s * 3 / 100}, s * 3 / 100,
                    accent, random);
  const cv::Point centre(s * 42 / 100, s * 58 / 100);
  cv::circle(image, centre, s * 23 / 100, accent, cv::FILLED, cv::LINE_AA);
  cv::circle(image, centre, s * 20 / 100, bgr(material.colors[0]), cv::FILLED, cv::LINE_AA);
  draw_flower(image, centre, s * 19 / 100, 7 + random.below(5), band, ink);
  write_small_print(image, {s * 70 / 100, s * 38 / 100, s * 24 / 100, s * 40 / 100}, s * 4 / 100,
                    ink, random);
  for (int i = 0; i < 5; ++i) {
    cv::rectangle(image, cv::Rect(0, s * (86 + 3 * i) / 100, s, s * 15 / 1000),
                  i % 2 ? accent : band, cv::FILLED);
  }
  draw_bar_code(image, {s * 72 / 100, s * 80 / 100, s * 22 / 100, s * 14 / 100}, random);
  return image;
}

cv::Mat paint_book(const Material& material, Random& random) {
  static constexpr std::array kTitles{"RIVERS", "OPTICS", "ALPINE", "GARDEN", "SAILING", "ATLAS"};
  const cv::Scalar ink = bgr(material.colors[1]);
  const cv::Scalar accent = bgr(material.colors[2]);
  const int s = kSide;
  cv::Mat cloth = canvas(s, s, material.colors[0]);
  shade(cloth, clouds(s, s, 32, 4, 0.9, random), 0.04);
  cv::Mat image = to_8_bit(cloth);
  cv::rectangle(image, cv::Rect(s * 6 / 100, s * 6 / 100, s * 88 / 100, s * 88 / 100), accent,
                s / 100, cv::LINE_AA);
  const std::string title =
      kTitles[static_cast<std::size_t>(random.below(static_cast<int>(kTitles.size())))];
  write_text(image, title, s / 2, s * 28 / 100, s * 70 / 100, ink, 1.2);
  const cv::Point centre(s / 2, s * 58 / 100);
  const int rings = 5 + random.below(4);
  for (int i = rings; i > 0; --i) {
    cv::ellipse(image, centre, {s * 27 * i / (100 * rings), s * 20 * i / (100 * rings)}, 15.0 * i,
                0, 360, i % 2 ? ink : accent, s / 70, cv::LINE_AA);
  }
  write_small_print(image, {s * 30 / 100, s * 84 / 100, s * 40 / 100, s * 4 / 100}, s * 4 / 100,
                    ink, random);
  return image;
}

}  // namespace armsreach::sim
