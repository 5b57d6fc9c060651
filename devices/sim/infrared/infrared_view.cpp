#include "devices/sim/infrared/infrared_view.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

#include <opencv2/core.hpp>

#include "devices/sim/hand/place.hpp"
#include "devices/sim/world_mesh.hpp"

namespace armsreach::sim {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
// m: the hand's depth is known to a pixel and a piece's to its middle; a finger is thicker.
constexpr double kThickness = 0.006;
constexpr float kSkinAlbedo = 0.55F;
constexpr float kGloveAlbedo = 0.14F;
constexpr float kSleeveAlbedo = 0.35F;
constexpr float kCarrierAlbedo = 0.05F;
// A glaze that faces the camera mirrors the lamps: that much brighter than white.
constexpr float kMirrored = 30;
constexpr float kMirrorExponent = 150;

// Normals travel through the raster as colours.
Vector3f coded(const Vector3f& normal) { return 127.5F * (normal + Vector3f::Ones()); }
Vector3f decoded(const cv::Vec3b& code) {
  const Vector3f n(static_cast<float>(code[0]), static_cast<float>(code[1]),
                   static_cast<float>(code[2]));
  return (n / 127.5F - Vector3f::Ones()).normalized();
}

// What spans of a RasterSurface point to.
struct PlacedMesh {
  std::vector<Vector3f> positions;
  std::vector<Vector3f> codes;

  PlacedMesh(const Pose& camera_from_mesh, std::span<const Vector3f> points,
             std::span<const Vector3f> normals) {
    const Eigen::Matrix3f turn = camera_from_mesh.rotation_matrix().cast<float>();
    const Vector3f shift = camera_from_mesh.translation().cast<float>();
    for (const Vector3f& point : points) positions.push_back(turn * point + shift);
    for (const Vector3f& normal : normals) codes.push_back(coded(turn * normal));
  }
};

// A lens bends long edges and the depth along them: things are drawn in triangles too small for
// that to show.
void add_split(const std::array<std::uint32_t, 3>& triangle, std::vector<Vector3f>& points,
               std::vector<Vector3f>& normals, InfraredHand::Triangles& small) {
  constexpr float kLongest = 0.06F;  // m
  std::size_t longest = 0;
  float length = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const float side = (points[triangle[i]] - points[triangle[(i + 1) % 3]]).norm();
    if (side <= length) continue;
    length = side;
    longest = i;
  }
  if (length <= kLongest) {
    small.push_back(triangle);
    return;
  }
  const std::uint32_t a = triangle[longest];
  const std::uint32_t b = triangle[(longest + 1) % 3];
  const std::uint32_t c = triangle[(longest + 2) % 3];
  const std::uint32_t middle = static_cast<std::uint32_t>(points.size());
  points.push_back(0.5F * (points[a] + points[b]));
  normals.push_back((normals[a] + normals[b]).normalized());
  add_split({a, middle, c}, points, normals, small);
  add_split({middle, b, c}, points, normals, small);
}

double facing_angle(const Vector3d& point_in_camera, const Vector3d& normal) {
  return std::acos(std::clamp(normal.dot(-point_in_camera.normalized()), -1.0, 1.0));
}

// Twice the area of a triangle, with the sense of its corners.
double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

double area_of(const std::vector<Eigen::Vector2d>& outline) {
  double area = 0;
  for (std::size_t i = 2; i < outline.size(); ++i)
    area += 0.5 * std::abs(cross(outline[0], outline[i - 1], outline[i]));
  return area;
}

// Seen from outside, corners go round clockwise in a picture whose y points down.
bool inside(const std::vector<Eigen::Vector2d>& outline, const Eigen::Vector2d& point) {
  for (std::size_t i = 0; i < outline.size(); ++i) {
    if (cross(outline[i], outline[(i + 1) % outline.size()], point) > 0) return false;
  }
  return true;
}

// The share of a pixel that lies in a convex outline.
double covered(const std::vector<Eigen::Vector2d>& outline, int x, int y) {
  constexpr int kSide = 8;
  const auto corner_inside = [&](double dx, double dy) {
    return inside(outline, Eigen::Vector2d(x + dx, y + dy));
  };
  if (corner_inside(-0.5, -0.5) && corner_inside(0.5, -0.5) && corner_inside(0.5, 0.5) &&
      corner_inside(-0.5, 0.5))
    return 1;
  int count = 0;
  for (int i = 0; i < kSide * kSide; ++i) {
    const Eigen::Vector2d place((i % kSide + 0.5) / kSide - 0.5, (i / kSide + 0.5) / kSide - 0.5);
    count += inside(outline, Eigen::Vector2d(x, y) + place);
  }
  return static_cast<double>(count) / (kSide * kSide);
}

}  // namespace

double tape_returns(double incidence) {
  constexpr double kHalf = 55 * std::numbers::pi / 180;
  constexpr double kSoft = 4 * std::numbers::pi / 180;
  return 1 / (1 + std::exp((incidence - kHalf) / kSoft));
}

InfraredView::InfraredView(const World& world, const InfraredDescription& description)
    : description_(description),
      raster_(description.camera),
      rays_(description.camera.height, description.camera.width, CV_32FC2) {
  for (int y = 0; y < rays_.rows; ++y) {
    for (int x = 0; x < rays_.cols; ++x) {
      const Vector3d ray = unproject(description.camera, Eigen::Vector2d(x, y));
      rays_.at<cv::Vec2f>(y, x) = {static_cast<float>(ray.x()), static_cast<float>(ray.y())};
    }
  }
  const cv::Size size(description.camera.width, description.camera.height);
  light_ = cv::Mat::zeros(size, CV_32F);
  depth_ = cv::Mat(size, CV_32F, cv::Scalar(kUnknown));
  draw_things(world);
  still_light_ = light_.clone();
  still_depth_ = depth_.clone();
}

void InfraredView::clear() {
  still_light_.copyTo(light_);
  still_depth_.copyTo(depth_);
}

void InfraredView::draw_things(const World& world) {
  const WorldMesh mesh = mesh_of(world);
  for (std::size_t i = 0; i < world.parts.size(); ++i) {
    const Part& part = world.parts[i];
    const Thing& thing = world.things[static_cast<std::size_t>(part.thing)];
    if (thing.moves) continue;
    const Material& material = world.materials[static_cast<std::size_t>(part.material)];
    const Pose camera_from_thing =
        description_.world_from_camera.inverse() * thing.world_from_thing;
    std::vector<Vector3f> points;
    std::vector<Vector3f> normals;
    InfraredHand::Triangles triangles;
    const auto* corners = mesh.indices.data() + mesh.parts[i].first;
    for (std::uint32_t k = 0; k < mesh.parts[i].count; k += 3) {
      const std::uint32_t first = static_cast<std::uint32_t>(points.size());
      for (const std::uint32_t corner : {corners[k], corners[k + 1], corners[k + 2]}) {
        points.push_back(mesh.vertices[corner].position);
        normals.push_back(mesh.vertices[corner].normal);
      }
      add_split({first, first + 1, first + 2}, points, normals, triangles);
    }
    const PlacedMesh placed(camera_from_thing, points, normals);
    raster_.clear();
    raster_.draw({placed.positions, placed.codes, triangles, false, 1});
    shade(raster_.images(), {{static_cast<float>(material.infrared * (1 - material.shine)),
                              static_cast<float>(material.shine)}});
  }
}

void InfraredView::draw_hand(const InfraredHand& hand, const InfraredHand::Moment& moment) {
  const Pose camera_from_hand = description_.world_from_camera.inverse() * moment.world_from_hand;
  const PlacedMesh skin(camera_from_hand, moment.surface.positions, moment.surface.normals);
  std::vector<PlacedMesh> carriers;
  for (const WornPart& part : moment.worn.carriers)
    carriers.emplace_back(camera_from_hand, part.positions, part.normals);
  raster_.clear();
  std::uint8_t id = 1;
  for (const Cover cover : {Cover::skin, Cover::glove, Cover::sleeve})
    raster_.draw({skin.positions, skin.codes, hand.triangles(cover), false, id++});
  for (std::size_t i = 0; i < carriers.size(); ++i) {
    raster_.draw(
        {carriers[i].positions, carriers[i].codes, moment.worn.carriers[i].triangles, false, id});
  }
  shade(raster_.images(),
        {{kSkinAlbedo, 0}, {kGloveAlbedo, 0}, {kSleeveAlbedo, 0}, {kCarrierAlbedo, 0}});
}

void InfraredView::shade(const Raster::Images& images, const std::vector<Look>& looks) {
  const float white = static_cast<float>(description_.white_level);
  for (int y = 0; y < images.place.height; ++y) {
    for (int x = 0; x < images.place.width; ++x) {
      const int id = images.ids.at<std::uint8_t>(y, x);
      const float z = images.depth.at<float>(y, x);
      const cv::Point at = images.place.tl() + cv::Point(x, y);
      float& behind = depth_.at<float>(at);
      if (id == 0 || !(z > 0) || z >= behind) continue;
      behind = z;
      const Look& look = looks[static_cast<std::size_t>(id) - 1];
      const cv::Vec2f& ray = rays_.at<cv::Vec2f>(at);
      const Vector3f point = z * Vector3f(ray[0], ray[1], 1);
      const float distance = point.norm();
      const float facing =
          std::max(0.0F, decoded(images.color.at<cv::Vec3b>(y, x)).dot(-point / distance));
      const float sent =
          look.albedo * facing + look.shine * kMirrored * std::pow(facing, kMirrorExponent);
      const float share = static_cast<float>(images.coverage.at<std::uint8_t>(y, x)) / 255;
      float& light = light_.at<float>(at);
      light += share * (white * sent / (distance * distance) - light);
    }
  }
}

double InfraredView::draw_tape(const TapePiece& piece) {
  double seen = 0;
  double facing = 0;
  for (const TapeFacet& facet : piece.facets) {
    Vector3d centre = Vector3d::Zero();
    std::vector<Eigen::Vector2d> outline;
    for (const Vector3d& corner : facet.outline) {
      centre += corner / static_cast<double>(facet.outline.size());
      if (const auto pixel = project(description_.camera, corner)) outline.push_back(*pixel);
    }
    const double incidence = facing_angle(centre, facet.normal);
    if (incidence >= std::numbers::pi / 2 || outline.size() < facet.outline.size()) continue;
    const double level = description_.tape_level * tape_returns(incidence) / centre.squaredNorm();
    facing += area_of(outline);
    seen += add_facet(outline, centre.z(), static_cast<float>(level));
  }
  return facing > 0 ? std::min(1.0, seen / facing) : 0;
}

double InfraredView::add_facet(const std::vector<Eigen::Vector2d>& outline, double depth,
                               float level) {
  Eigen::Vector2d low = outline.front();
  Eigen::Vector2d high = outline.front();
  for (const Eigen::Vector2d& corner : outline) {
    low = low.cwiseMin(corner);
    high = high.cwiseMax(corner);
  }
  const cv::Rect place = cv::Rect(cv::Point(static_cast<int>(std::floor(low.x() + 0.5)),
                                            static_cast<int>(std::floor(low.y() + 0.5))),
                                  cv::Point(static_cast<int>(std::floor(high.x() + 0.5)) + 1,
                                            static_cast<int>(std::floor(high.y() + 0.5)) + 1)) &
                         cv::Rect(0, 0, light_.cols, light_.rows);
  const float hidden_before = static_cast<float>(depth - kThickness);
  double seen = 0;
  for (int y = place.y; y < place.y + place.height; ++y) {
    for (int x = place.x; x < place.x + place.width; ++x) {
      if (depth_.at<float>(y, x) < hidden_before) continue;
      const double share = covered(outline, x, y);
      light_.at<float>(y, x) += static_cast<float>(share) * level;
      seen += share;
    }
  }
  return seen;
}

}  // namespace armsreach::sim
