#include "devices/sim/hand/raster.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace armsreach::sim {
namespace {

using Eigen::Vector3f;

constexpr float kNearest = 0.02F;  // m
constexpr int kSide = 2;           // samples along a pixel's side

// Twice the area of a triangle, positive when it goes clockwise in the image (y down).
template <class Corner>
float cross(const Corner& a, const Corner& b, float x, float y) {
  return (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
}

}  // namespace

Raster::Raster(const Camera& camera)
    : camera_(camera),
      width_(kSide * camera.width),
      height_(kSide * camera.height),
      samples_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_)),
      left_(width_),
      top_(height_) {}

void Raster::clear() {
  for (int y = top_; y < bottom_; ++y) {
    const auto row = samples_.begin() + static_cast<std::ptrdiff_t>(y) * width_;
    std::fill(row + left_, row + std::max(left_, right_), Sample{});
  }
  corners_.clear();
  parts_.clear();
  cut_.clear();
  triangles_ = 0;
  left_ = width_;
  top_ = height_;
  right_ = bottom_ = 0;
}

void Raster::draw(const RasterSurface& surface) {
  draw_before_near_plane(surface);
  ClippedTriangles cut =
      cut_at_near_plane(surface.positions, surface.colors, surface.triangles, kNearest);
  if (cut.triangles.empty()) return;
  const ClippedTriangles& kept = cut_.emplace_back(std::move(cut));
  draw_before_near_plane(
      {kept.positions, kept.colors, kept.triangles, surface.mirrored, surface.id});
}

// Triangles all of whose corners are.
void Raster::draw_before_near_plane(const RasterSurface& surface) {
  const Part part{surface, corners_.size(), triangles_};
  const bool lens = camera_.has_distortion();
  for (const Vector3f& point : surface.positions) {
    Corner corner;
    if (point.z() >= kNearest) {
      const auto pixel =
          lens ? project(camera_, point.cast<double>())
               : std::optional(Eigen::Vector2d(
                     camera_.fx * static_cast<double>(point.x() / point.z()) + camera_.cx,
                     camera_.fy * static_cast<double>(point.y() / point.z()) + camera_.cy));
      // A pixel's samples lie a quarter pixel around its centre.
      if (pixel) {
        corner = {static_cast<float>(kSide * pixel->x() + 0.5),
                  static_cast<float>(kSide * pixel->y() + 0.5), 1 / point.z()};
      }
    }
    corners_.push_back(corner);
  }
  for (const auto& triangle : surface.triangles) {
    const std::array<Corner, 3> corners{corners_[part.first_corner + triangle[0]],
                                        corners_[part.first_corner + triangle[1]],
                                        corners_[part.first_corner + triangle[2]]};
    ++triangles_;
    const bool seen = corners[0].inverse_depth > 0 && corners[1].inverse_depth > 0 &&
                      corners[2].inverse_depth > 0;
    // Counter-clockwise from outside, with y down: negative.
    const float area = cross(corners[0], corners[1], corners[2].x, corners[2].y);
    if (!seen || (surface.mirrored ? area <= 0 : area >= 0)) continue;
    if (surface.mirrored)
      draw_triangle(corners, triangles_);
    else
      draw_triangle({corners[0], corners[2], corners[1]}, triangles_);
  }
  parts_.push_back(part);
}

void Raster::draw_triangle(const std::array<Corner, 3>& c, std::uint32_t number) {
  const auto bounds = [&c](float Corner::*side, int size) {
    const auto [low, high] = std::minmax({c[0].*side, c[1].*side, c[2].*side});
    const float limit = static_cast<float>(size);
    return std::pair(static_cast<int>(std::ceil(std::clamp(low, 0.0F, limit))),
                     static_cast<int>(std::floor(std::clamp(high, -1.0F, limit - 1))));
  };
  const auto [x0, x1] = bounds(&Corner::x, width_);
  const auto [y0, y1] = bounds(&Corner::y, height_);
  if (x0 > x1 || y0 > y1) return;
  const float scale = 1 / cross(c[0], c[1], c[2].x, c[2].y);
  // Barycentric coordinates and inverse depth change evenly over the image.
  const float w1_by_x = scale * (c[0].y - c[2].y) * -1;
  const float w2_by_x = scale * (c[1].y - c[0].y) * -1;
  const float d1 = c[1].inverse_depth - c[0].inverse_depth;
  const float d2 = c[2].inverse_depth - c[0].inverse_depth;
  for (int y = y0; y <= y1; ++y) {
    const float fx = static_cast<float>(x0);
    const float fy = static_cast<float>(y);
    float w1 = scale * cross(c[2], c[0], fx, fy);
    float w2 = scale * cross(c[0], c[1], fx, fy);
    Sample* sample = samples_.data() + static_cast<std::ptrdiff_t>(y) * width_ + x0;
    for (int x = x0; x <= x1; ++x, ++sample, w1 += w1_by_x, w2 += w2_by_x) {
      if (w1 < 0 || w2 < 0 || w1 + w2 > 1) continue;
      const float inverse_depth = c[0].inverse_depth + w1 * d1 + w2 * d2;
      if (inverse_depth > sample->inverse_depth) *sample = {inverse_depth, number};
    }
  }
  left_ = std::min(left_, x0);
  top_ = std::min(top_, y0);
  right_ = std::max(right_, x1 + 1);
  bottom_ = std::max(bottom_, y1 + 1);
}

cv::Rect Raster::touched() const {
  if (right_ <= left_ || bottom_ <= top_) return {};
  const int x = left_ / kSide;
  const int y = top_ / kSide;
  return {x, y, (right_ + kSide - 1) / kSide - x, (bottom_ + kSide - 1) / kSide - y};
}

const Raster::Part& Raster::part_of(std::uint32_t triangle) const {
  if (parts_.size() == 1) return parts_.front();
  const auto after =
      std::upper_bound(parts_.begin(), parts_.end(), triangle - 1,
                       [](std::uint32_t t, const Part& part) { return t < part.first_triangle; });
  return *std::prev(after);
}

std::array<Raster::Sample, 4> Raster::samples_at(int x, int y) const {
  const Sample* upper =
      samples_.data() + static_cast<std::ptrdiff_t>(kSide * y) * width_ + kSide * x;
  const Sample* lower = upper + width_;
  return {upper[0], upper[1], lower[0], lower[1]};
}

cv::Mat Raster::ids() const {
  cv::Mat ids = cv::Mat::zeros(camera_.height, camera_.width, CV_8U);
  const cv::Rect place = touched();
  for (int y = place.y; y < place.y + place.height; ++y) {
    for (int x = place.x; x < place.x + place.width; ++x) {
      int covered = 0;
      Sample nearest;
      for (const Sample& sample : samples_at(x, y)) {
        covered += sample.triangle != 0;
        if (sample.inverse_depth > nearest.inverse_depth) nearest = sample;
      }
      if (covered >= 2) ids.at<std::uint8_t>(y, x) = part_of(nearest.triangle).surface.id;
    }
  }
  return ids;
}

Raster::Shade Raster::shade(std::uint32_t triangle, float x, float y) const {
  const Part& part = part_of(triangle);
  const auto& indices = part.surface.triangles[triangle - 1 - part.first_triangle];
  const auto corner = [&](std::size_t i) -> const Corner& {
    return corners_[part.first_corner + indices[i]];
  };
  const float scale = 1 / cross(corner(0), corner(1), corner(2).x, corner(2).y);
  // A pixel's centre may lie just outside a triangle that covers some of its samples.
  const float w1 = std::clamp(scale * cross(corner(2), corner(0), x, y), 0.0F, 1.0F);
  const float w2 = std::clamp(scale * cross(corner(0), corner(1), x, y), 0.0F, 1.0F - w1);
  const std::array<float, 3> w{(1 - w1 - w2) * corner(0).inverse_depth,
                               w1 * corner(1).inverse_depth, w2 * corner(2).inverse_depth};
  const float depth = 1 / (w[0] + w[1] + w[2]);
  Shade shade{Vector3f::Zero(), depth};
  if (part.surface.colors.empty()) return shade;
  for (std::size_t i = 0; i < 3; ++i) shade.color += w[i] * depth * part.surface.colors[indices[i]];
  return shade;
}

// Every triangle that covers samples is shaded once, at the pixel's centre.
void Raster::resolve(int x, int y, Images& images) const {
  const std::array<Sample, 4> samples = samples_at(x, y);
  Vector3f color = Vector3f::Zero();
  int covered = 0;
  float nearest = 0;
  float depth = 0;
  std::uint32_t nearest_triangle = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const std::uint32_t triangle = samples[i].triangle;
    const auto same = [triangle](const Sample& sample) { return sample.triangle == triangle; };
    const auto at = samples.begin() + static_cast<std::ptrdiff_t>(i);
    if (triangle == 0 || std::any_of(samples.begin(), at, same)) continue;
    const int count = static_cast<int>(std::count_if(at, samples.end(), same));
    const Shade shaded =
        shade(triangle, static_cast<float>(kSide * x) + 0.5F, static_cast<float>(kSide * y) + 0.5F);
    color += static_cast<float>(count) * shaded.color;
    covered += count;
    if (samples[i].inverse_depth <= nearest) continue;
    nearest = samples[i].inverse_depth;
    nearest_triangle = triangle;
    depth = shaded.depth;
  }
  if (covered == 0) return;
  const cv::Point at(x - images.place.x, y - images.place.y);
  color /= static_cast<float>(covered);
  for (int c = 0; c < 3; ++c)
    images.color.at<cv::Vec3b>(at)[c] = cv::saturate_cast<std::uint8_t>(color[c]);
  images.coverage.at<std::uint8_t>(at) = static_cast<std::uint8_t>(covered * 255 / 4);
  images.ids.at<std::uint8_t>(at) = part_of(nearest_triangle).surface.id;
  if (covered >= 2) images.depth.at<float>(at) = depth;
}

Raster::Images Raster::images() const {
  Images images;
  images.place = touched();
  const cv::Size size = images.place.size();
  images.color = cv::Mat::zeros(size, CV_8UC3);
  images.coverage = cv::Mat::zeros(size, CV_8U);
  images.ids = cv::Mat::zeros(size, CV_8U);
  images.depth = cv::Mat(size, CV_32F, std::numeric_limits<float>::quiet_NaN());
  for (int y = images.place.y; y < images.place.br().y; ++y)
    for (int x = images.place.x; x < images.place.br().x; ++x) resolve(x, y, images);
  return images;
}

}  // namespace armsreach::sim
