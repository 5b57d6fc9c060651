#include "devices/sim/pattern.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>

#include <opencv2/imgproc.hpp>

#include "devices/sim/paint.hpp"

namespace armsreach::sim {
namespace {

constexpr int kSide = 512;        // px
constexpr int kLargeSide = 1024;  // px, of patterns that cover whole tables and floors

cv::Mat paint_plain(const Material& material, Random& random) {
  cv::Mat image = canvas(kSide / 4, kSide / 4, material.colors[0]);
  shade(image, clouds(image.cols, image.rows, 4, 4, 0.7, random), 0.02);
  return to_8_bit(image);
}

// Boards along x, each with its own tone, long streaks of grain and some darker year rings.
cv::Mat paint_wood(const Material& material, Random& random) {
  constexpr int kBoards = 8;
  const int side = material.size < 1 ? kSide : kLargeSide;
  cv::Mat image = canvas(side, side, material.colors[0]);
  const cv::Mat streaks = noise(side, side, 6, side / 6, random);
  const cv::Mat fibres = noise(side, side, 24, side / 2, random);
  const cv::Mat bend = noise(side, side, 4, 12, random);
  std::array<double, kBoards> tones{};
  std::array<double, kBoards> rings{};
  for (int i = 0; i < kBoards; ++i) {
    tones[static_cast<std::size_t>(i)] = random.uniform(-0.14, 0.14);
    rings[static_cast<std::size_t>(i)] = random.uniform(2.5, 6);
  }
  cv::Mat share(side, side, CV_32F);
  for (int y = 0; y < side; ++y) {
    const double across = static_cast<double>(y) * kBoards / side;
    const std::size_t board = static_cast<std::size_t>(across);
    const double inside = across - std::floor(across);
    const double joint = std::min(inside, 1 - inside) * side / kBoards < 1 ? 0.35 : 0;
    for (int x = 0; x < side; ++x) {
      const double ring = std::sin(2 * std::numbers::pi * rings[board] *
                                   (inside + 0.12 * static_cast<double>(bend.at<float>(y, x))));
      const double dark = 0.38 + tones[board] + 0.14 * ring * ring * ring +
                          0.11 * static_cast<double>(streaks.at<float>(y, x)) +
                          0.07 * static_cast<double>(fibres.at<float>(y, x)) + joint;
      share.at<float>(y, x) = static_cast<float>(dark);
    }
  }
  blend(image, material.colors[1], share);
  return to_8_bit(image);
}

// A woven check: stripes of warp and weft that mix where they cross, with single threads to see.
cv::Mat paint_fabric(const Material& material, Random& random) {
  const int side = kSide;
  const auto threads = [&] {
    std::vector<Color> colors;
    for (int i = 0; i < side; ++i) {
      const int part = i * 32 / side % 16;
      const bool wide = part >= 2 && part < 6;
      const bool narrow = part == 9 || part == 12;
      const Color color = material.colors[wide ? 1U : narrow ? 2U : 0U];
      colors.push_back(color * random.uniform(0.92, 1.08));
    }
    return colors;
  };
  const std::vector<Color> warp = threads();
  const std::vector<Color> weft = threads();
  const cv::Mat wear = clouds(side, side, 8, 5, 0.8, random);
  cv::Mat image(side, side, CV_32FC3);
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const bool warp_above = (x / 2 + y / 2) % 2 == 0;
      const Color& top =
          warp_above ? warp[static_cast<std::size_t>(x)] : weft[static_cast<std::size_t>(y)];
      const Color& under =
          warp_above ? weft[static_cast<std::size_t>(y)] : warp[static_cast<std::size_t>(x)];
      const cv::Scalar mixed_color = bgr(between(top, under, 0.3));
      image.at<cv::Vec3f>(y, x) = cv::Vec3d(mixed_color[0], mixed_color[1], mixed_color[2]);
    }
  }
  shade(image, wear, 0.045);
  return to_8_bit(image);
}

// Square tiles, every other one with an ornament of quarter circles and a diamond.
cv::Mat paint_tiles(const Material& material, Random& random) {
  constexpr int kTiles = 4;
  const int side = kLargeSide;
  const int tile = side / kTiles;
  cv::Mat drawn(side, side, CV_8UC3, bgr(material.colors[0]));
  for (int row = 0; row < kTiles; ++row) {
    for (int column = 0; column < kTiles; ++column) {
      cv::Mat one = drawn(cv::Rect(column * tile, row * tile, tile, tile));
      const double tone = random.uniform(0.92, 1.06);
      one.setTo(bgr(material.colors[0] * tone));
      if ((row + column) % 2 == 0) continue;
      const cv::Scalar ornament = bgr(material.colors[1] * tone);
      for (const cv::Point corner : {cv::Point(0, 0), {tile, 0}, {0, tile}, {tile, tile}}) {
        cv::circle(one, corner, tile * 40 / 100, ornament, tile / 12, cv::LINE_AA);
        cv::circle(one, corner, tile * 20 / 100, ornament, cv::FILLED, cv::LINE_AA);
      }
      const std::array<cv::Point, 4> diamond{cv::Point(tile / 2, tile / 4),
                                             {tile * 3 / 4, tile / 2},
                                             {tile / 2, tile * 3 / 4},
                                             {tile / 4, tile / 2}};
      cv::fillConvexPoly(one, diamond.data(), 4, ornament, cv::LINE_AA);
      cv::circle(one, {tile / 2, tile / 2}, tile / 12, bgr(material.colors[0] * tone), cv::FILLED,
                 cv::LINE_AA);
    }
  }
  const int joint = std::max(2, tile / 40);
  for (int i = 0; i < kTiles; ++i) {
    drawn(cv::Rect(0, i * tile, side, joint)).setTo(bgr(material.colors[2]));
    drawn(cv::Rect(i * tile, 0, joint, side)).setTo(bgr(material.colors[2]));
  }
  cv::Mat image;
  drawn.convertTo(image, CV_32FC3);
  shade(image, clouds(side, side, 6, 6, 0.75, random), 0.04);
  return to_8_bit(image);
}

cv::Mat paint_plaster(const Material& material, Random& random) {
  cv::Mat image = canvas(kSide, kSide, material.colors[0]);
  shade(image, clouds(kSide, kSide, 10, 5, 1.15, random), 0.03);
  return to_8_bit(image);
}

// Fluted board: fine ribs across, short fibres in all directions.
cv::Mat paint_cardboard(const Material& material, Random& random) {
  cv::Mat drawn(kSide, kSide, CV_8UC3, bgr(material.colors[0]));
  for (int i = 0; i < 900; ++i) {
    const cv::Point from(random.below(kSide), random.below(kSide));
    const double angle = random.uniform(0, 2 * std::numbers::pi);
    const double length = random.uniform(4, 14);
    const cv::Point to(from.x + static_cast<int>(length * std::cos(angle)),
                       from.y + static_cast<int>(length * std::sin(angle)));
    cv::line(drawn, from, to, bgr(material.colors[0] * random.uniform(0.86, 1.1)), 1, cv::LINE_AA);
  }
  cv::Mat image;
  drawn.convertTo(image, CV_32FC3);
  shade(image, noise(kSide, kSide, 6, 64, random), 0.02);
  shade(image, clouds(kSide, kSide, 5, 6, 0.8, random), 0.03);
  return to_8_bit(image);
}

// Dipped twice: the lower part in another colour with an uneven edge, specks all over.
cv::Mat paint_glaze(const Material& material, Random& random) {
  cv::Mat image = canvas(kSide, kSide, material.colors[0]);
  const cv::Mat edge = noise(kSide, 1, 12, 1, random);
  cv::Mat share(kSide, kSide, CV_32F);
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const double line = 0.52 * kSide + 7 * static_cast<double>(edge.at<float>(0, x));
      share.at<float>(y, x) = static_cast<float>((y - line) / 3 + 0.5);
    }
  }
  blend(image, material.colors[1], share);
  cv::Mat specked = to_8_bit(image);
  for (int i = 0; i < 420; ++i) {
    const cv::Point at(random.below(kSide), random.below(kSide));
    // Higher than wide: around a mug or vase the pattern is stretched.
    const int radius = 1 + random.below(2);
    cv::ellipse(specked, at, {radius, 2 * radius + 1}, 0, 0, 360, bgr(material.colors[2]),
                cv::FILLED, cv::LINE_AA);
  }
  specked.convertTo(image, CV_32FC3);
  shade(image, clouds(kSide, kSide, 4, 4, 0.6, random), 0.03);
  return to_8_bit(image);
}

cv::Mat in_powers_of_two(const cv::Mat& picture) {
  static constexpr int kLargest = 1024;  // px
  const auto side = [](int pixels) {
    return std::min(kLargest, static_cast<int>(std::bit_ceil(static_cast<unsigned>(pixels))));
  };
  const cv::Size size(side(picture.cols), side(picture.rows));
  cv::Mat image;
  const bool smaller = size.width < picture.cols || size.height < picture.rows;
  cv::resize(picture, image, size, 0, 0, smaller ? cv::INTER_AREA : cv::INTER_LINEAR);
  return image;
}

}  // namespace

cv::Mat paint_pattern(const Material& material, std::uint64_t seed) {
  Random random(seed);
  switch (material.pattern) {
    case Pattern::plain:
      return paint_plain(material, random);
    case Pattern::wood:
      return paint_wood(material, random);
    case Pattern::fabric:
      return paint_fabric(material, random);
    case Pattern::tiles:
      return paint_tiles(material, random);
    case Pattern::plaster:
      return paint_plaster(material, random);
    case Pattern::cardboard:
      return paint_cardboard(material, random);
    case Pattern::glaze:
      return paint_glaze(material, random);
    case Pattern::label:
      return paint_label(material, random);
    case Pattern::book:
      return paint_book(material, random);
    case Pattern::landscape:
      return paint_landscape(material, random);
    case Pattern::shapes:
      return paint_shapes(material, random);
    case Pattern::leaves:
      return paint_leaves(material, random);
    case Pattern::texture:
      return in_powers_of_two(material.picture);
  }
  return {};
}

}  // namespace armsreach::sim
