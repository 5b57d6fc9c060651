// A start target's marks, matched jointly.
//
// Every mark alone is found in many places. Three of them in places that could be the target's give
// a pose, the pose says where the others must be, and in the end what each of them looks like.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "vision/mono_slam/search.hpp"
#include "vision/mono_slam/start_target.hpp"

namespace armsreach::mono_slam {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Marks = std::vector<StartTarget::Mark>;

// Alone, a mark is sought loosely.
constexpr double kLeastScore = 0.8;
constexpr int kMostPlaces = 40;
// Patches are pictures of a target that is looked at upright and from the front: from farther to
// the side they would not have matched.
constexpr double kMostTurn = 1.05;     // rad, of the camera
constexpr double kMostLean = 0.7;      // rad, of a line between two marks in the image
constexpr double kMostSquashed = 0.5;  // of the target's picture, one way against the other
// Of a mark from where three others put it, as a share of how far apart those are: seen from the
// front, four different poses show three points at nearly the same pixels, and the rest elsewhere.
constexpr double kNear = 0.2;
constexpr double kFits = 1.0;  // px rms of all
// Of each mark where the pose puts it, warped as the pose says. The desk sequence has 0.94 and more
// from all distances (0.98 from where it can be started); 500 pictures without the target have up
// to 0.93.
constexpr double kLeastWarpedScore = 0.94;
constexpr double kCertainScore = 0.97;
// By how much more the next best placement's mean score must fall short of 1.
constexpr double kLead = 2;
constexpr double kCertainLead = 4;

struct Placement {
  double least_score = -1;  // of the marks, warped
  double mean_score = -1;
  PoseFix pose;
  std::vector<SeenPoint> points;  // in the order of the marks
};

bool frontal(const Pose& world_from_camera) {
  const Eigen::Quaterniond facing(0, 0, 0, 1);  // x to the left, y up, z away
  return world_from_camera.rotation().angularDistance(facing) < kMostTurn;
}

// As seen by an upright camera in front: x to the right, y down.
Vector2d from_front(const Vector3d& in_world) { return {-in_world.x(), -in_world.y()}; }

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

// The three marks that span the largest triangle: they tell most of the pose.
std::array<std::size_t, 3> widest_three(const Marks& marks) {
  std::array<std::size_t, 3> widest{0, 1, 2};
  double largest = 0;
  for (std::size_t a = 0; a < marks.size(); ++a) {
    for (std::size_t b = a + 1; b < marks.size(); ++b) {
      for (std::size_t c = b + 1; c < marks.size(); ++c) {
        const Vector3d& origin = marks[a].point_in_world;
        const double area = std::abs(cross(from_front(marks[b].point_in_world - origin),
                                           from_front(marks[c].point_in_world - origin)));
        if (area <= largest) continue;
        largest = area;
        widest = {a, b, c};
      }
    }
  }
  return widest;
}

// How the image shows the target's plane, pixels by metres to the right and down.
std::optional<Matrix2d> pixel_by_front(const Camera& camera, const Pose& camera_from_world,
                                       const Vector3d& point_in_world) {
  Eigen::Matrix<double, 2, 3> pixel_by_point;
  if (!project(camera, camera_from_world * point_in_world, &pixel_by_point)) return std::nullopt;
  return -pixel_by_point * camera_from_world.rotation_matrix().leftCols<2>();
}

double sample(const SearchImage::Level& level, const Vector2d& pixel) {
  const int x = static_cast<int>(pixel.x());
  const int y = static_cast<int>(pixel.y());
  const double right = pixel.x() - x;
  const double below = pixel.y() - y;
  const auto at = [&](int dx, int dy) { return static_cast<double>(*level.at(x + dx, y + dy)); };
  return (1 - below) * ((1 - right) * at(0, 0) + right * at(1, 0)) +
         below * ((1 - right) * at(0, 1) + right * at(1, 1));
}

// ZNCC of a patch with the image around a pixel, seen through a linear map; -1 beyond the edge.
double score_at(const SearchImage::Level& level, const Template& pattern, const Vector2d& pixel,
                const Matrix2d& image_from_patch) {
  const int half = pattern.half();
  const double count = pattern.size * pattern.size;
  double p_sum = 0;
  double q_sum = 0;
  double p_squares = 0;
  double q_squares = 0;
  double products = 0;
  for (int y = -half; y <= half; ++y) {
    for (int x = -half; x <= half; ++x) {
      const Vector2d at = pixel + image_from_patch * Vector2d(x, y);
      if (!(at.minCoeff() >= 0 && at.x() < level.width - 1 && at.y() < level.height - 1)) return -1;
      const double p = static_cast<double>(
          pattern.samples[static_cast<std::size_t>((y + half) * pattern.size + x + half)]);
      const double q = sample(level, at);
      p_sum += p;
      q_sum += q;
      p_squares += p * p;
      q_squares += q * q;
      products += p * q;
    }
  }
  const double variances =
      (count * p_squares - p_sum * p_sum) * (count * q_squares - q_sum * q_sum);
  return variances > 0 ? (count * products - p_sum * q_sum) / std::sqrt(variances) : -1;
}

class MarkSearch {
 public:
  MarkSearch(const SearchImage& image, const Camera& camera, const Marks& marks)
      : image_(image), camera_(camera), marks_(marks), three_(widest_three(marks)) {}

  std::optional<TargetFix> run() {
    if (!find_places()) return std::nullopt;
    place_all();
    const auto leads_by = [&](double lead) {
      return 1 - next_.mean_score > lead * (1 - best_.mean_score);
    };
    if (best_.least_score < kLeastWarpedScore || !leads_by(kLead)) return std::nullopt;
    const bool certain = best_.least_score > kCertainScore && leads_by(kCertainLead);
    return TargetFix{best_.pose, best_.points, certain};
  }

 private:
  bool find_places() {
    for (const StartTarget::Mark& mark : marks_) {
      patterns_.push_back(template_of(mark.patch));
      places_.push_back(search_all_coarsely(image_, patterns_.back(), kLeastScore, kMostPlaces));
      if (places_.back().empty()) return false;
    }
    return true;
  }

  void place_all() {
    const auto [a, b, c] = three_;
    for (const Match& at_a : places_[a]) {
      for (const Match& at_b : places_[b]) {
        if (!plausible(a, at_a, b, at_b)) continue;
        for (const Match& at_c : places_[c]) {
          if (plausible(a, at_a, c, at_c) && plausible(b, at_b, c, at_c)) {
            place({at_a.pixel, at_b.pixel, at_c.pixel});
          }
        }
      }
    }
  }

  // Whether two marks can lie like this in the image, told apart by more than their patches.
  bool plausible(std::size_t a, const Match& at, std::size_t b, const Match& other) const {
    const Vector2d seen = other.pixel - at.pixel;
    const Vector2d expected = from_front(marks_[b].point_in_world - marks_[a].point_in_world);
    return seen.norm() > std::max(patterns_[a].size, patterns_[b].size) &&
           seen.dot(expected) > std::cos(kMostLean) * seen.norm() * expected.norm();
  }

  void place(const std::array<Vector2d, 3>& pixels) {
    const auto map = affine_map(pixels);
    if (!map || !others_may_be(*map, pixels)) return;
    std::vector<SeenPoint> seen;
    for (std::size_t i = 0; i < 3; ++i) {
      seen.push_back({marks_[three_[i]].point_in_world, pixels[i]});
    }
    const double reach = reach_of(pixels);
    for (const Pose& pose : three_point_poses(camera_, seen)) {
      const auto points = complete(pose, reach);
      if (!points) continue;
      const auto fix = refined_pose(camera_, pose, *points);
      if (!fix || fix->rms > kFits || !frontal(fix->world_from_camera)) continue;
      take(scored(*fix, *points));
    }
  }

  // Pixels by metres, as if seen from afar; nothing when the target is not seen from the front.
  std::optional<Matrix2d> affine_map(const std::array<Vector2d, 3>& pixels) const {
    const Vector3d& origin = marks_[three_[0]].point_in_world;
    Matrix2d front;
    Matrix2d seen;
    for (std::size_t i = 1; i < 3; ++i) {
      const auto column = static_cast<Eigen::Index>(i - 1);
      front.col(column) = from_front(marks_[three_[i]].point_in_world - origin);
      seen.col(column) = pixels[i] - pixels[0];
    }
    const Matrix2d map = seen * front.inverse();
    // The squashing is s2 / s1 of the singular values; their product is the determinant, the sum of
    // their squares the squared norm.
    const double least = kMostSquashed / (1 + kMostSquashed * kMostSquashed);
    if (!(map.determinant() > least * map.squaredNorm())) return std::nullopt;
    return map;
  }

  // Whether the other marks have places about where the three put them; cheap, and most triples end
  // here.
  bool others_may_be(const Matrix2d& map, const std::array<Vector2d, 3>& pixels) const {
    const Vector3d& origin = marks_[three_[0]].point_in_world;
    for (std::size_t i = 0; i < marks_.size(); ++i) {
      const Vector2d expected = pixels[0] + map * from_front(marks_[i].point_in_world - origin);
      if (!place_near(i, expected, 1.5 * reach_of(pixels))) return false;
    }
    return true;
  }

  static double reach_of(const std::array<Vector2d, 3>& pixels) {
    return kNear * std::max((pixels[1] - pixels[0]).norm(), (pixels[2] - pixels[0]).norm());
  }

  const Match* place_near(std::size_t mark, const Vector2d& pixel, double reach) const {
    const Match* best = nullptr;
    for (const Match& match : places_[mark]) {
      if ((match.pixel - pixel).norm() > reach) continue;
      if (!best || match.score > best->score) best = &match;
    }
    return best;
  }

  // Each mark at the best of its places near to where the pose puts it.
  std::optional<std::vector<SeenPoint>> complete(const Pose& world_from_camera,
                                                 double reach) const {
    const Pose camera_from_world = world_from_camera.inverse();
    std::vector<SeenPoint> all;
    for (std::size_t i = 0; i < marks_.size(); ++i) {
      const auto expected = project(camera_, camera_from_world * marks_[i].point_in_world);
      const Match* match = expected ? place_near(i, *expected, reach) : nullptr;
      if (!match) return std::nullopt;
      all.push_back({marks_[i].point_in_world, match->pixel});
    }
    return all;
  }

  // From how far the patches were taken is not known: their scale is that which the marks have on
  // the whole, but each must have the same, and the turn and slant that the pose says.
  Placement scored(const PoseFix& fix, const std::vector<SeenPoint>& points) const {
    Placement out;
    out.pose = fix;
    out.points = points;
    const Pose camera_from_world = fix.world_from_camera.inverse();
    std::vector<Matrix2d> maps;
    double log_scale = 0;
    for (const StartTarget::Mark& mark : marks_) {
      const auto map = pixel_by_front(camera_, camera_from_world, mark.point_in_world);
      if (!map || map->determinant() <= 0) return out;
      maps.push_back(*map);
      log_scale += 0.5 * std::log(map->determinant()) / static_cast<double>(marks_.size());
    }
    out.least_score = 1;
    out.mean_score = 0;
    for (std::size_t i = 0; i < marks_.size(); ++i) {
      const auto pixel = project(camera_, camera_from_world * marks_[i].point_in_world);
      const double score =
          score_at(image_.full(), patterns_[i], *pixel, maps[i] / std::exp(log_scale));
      out.least_score = std::min(out.least_score, score);
      out.mean_score += score / static_cast<double>(marks_.size());
    }
    return out;
  }

  void take(Placement placement) {
    if (same_places(placement, best_)) {
      if (placement.pose.rms < best_.pose.rms) best_ = std::move(placement);
      return;
    }
    if (placement.mean_score > best_.mean_score) std::swap(best_, placement);
    if (placement.mean_score > next_.mean_score) next_ = std::move(placement);
  }

  static bool same_places(const Placement& a, const Placement& b) {
    if (a.points.size() != b.points.size()) return false;
    for (std::size_t i = 0; i < a.points.size(); ++i) {
      if ((a.points[i].pixel - b.points[i].pixel).norm() > 2) return false;
    }
    return true;
  }

  const SearchImage& image_;
  const Camera& camera_;
  const Marks& marks_;
  std::array<std::size_t, 3> three_;
  std::vector<Template> patterns_;
  std::vector<std::vector<Match>> places_;  // of each mark
  Placement best_;
  Placement next_;
};

}  // namespace

std::optional<TargetFix> find_marks(const SearchImage& image, const Camera& camera,
                                    const std::vector<StartTarget::Mark>& marks) {
  if (marks.size() < 4) return std::nullopt;
  return MarkSearch(image, camera, marks).run();
}

}  // namespace armsreach::mono_slam
