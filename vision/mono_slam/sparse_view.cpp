#include "vision/mono_slam/sparse_view.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include <Eigen/Eigenvalues>

namespace armsreach::mono_slam {
namespace {

using Eigen::Vector3d;

constexpr double kPassesBy = 0.26;      // rad: a ray farther from all points is at nothing
constexpr std::size_t kSuggesting = 5;  // points that say how far a place is
constexpr std::size_t kSpanning = 6;    // points that a plane is laid through
constexpr double kFarFromAll = 0.3;     // m
constexpr double kFlat = 0.15;          // thickness of a plane's points against their width

struct Passed {
  double angle;     // rad, off the ray
  double distance;  // m, along it
};

const SparseView::Place* find(const SparseView::Places& places, PointId id) {
  const auto at = std::lower_bound(
      places.begin(), places.end(), id,
      [](const SparseView::Place& place, PointId wanted) { return place.id < wanted; });
  return at != places.end() && at->id == id ? &*at : nullptr;
}

const SparseView::Place* closest(const SparseView::Places& places, const Vector3d& point) {
  const auto at = std::min_element(places.begin(), places.end(), [&](const auto& a, const auto& b) {
    return (a.point_in_world - point).squaredNorm() < (b.point_in_world - point).squaredNorm();
  });
  return at != places.end() ? &*at : nullptr;
}

std::optional<Vector3d> normal_of(const std::vector<Vector3d>& points) {
  Vector3d mean = Vector3d::Zero();
  for (const Vector3d& p : points) mean += p / static_cast<double>(points.size());
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const Vector3d& p : points) scatter += (p - mean) * (p - mean).transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(scatter);
  const Vector3d width = axes.eigenvalues().cwiseMax(0).cwiseSqrt();
  if (points.size() < kSpanning || width[0] > kFlat * width[1]) return std::nullopt;
  return axes.eigenvectors().col(0);
}

}  // namespace

SparseView::SparseView(Places points, std::shared_ptr<const Places> gone, const Vector3d& up,
                       const Vector3d& viewer, std::uint64_t revision)
    : points_(std::move(points)),
      gone_(std::move(gone)),
      up_(up),
      viewer_(viewer),
      revision_(revision) {}

std::optional<Vector3d> SparseView::pick(const Ray& ray, double range) const {
  const Vector3d direction = ray.direction_in_world.normalized();
  std::vector<Passed> passed;
  for (const Place& place : points_) {
    const Vector3d offset = place.point_in_world - ray.origin_in_world;
    const double along = offset.dot(direction);
    const double angle = std::atan2(offset.cross(direction).norm(), along);
    if (along > 0 && along <= range && angle < kPassesBy) passed.push_back({angle, along});
  }
  if (passed.empty()) return std::nullopt;
  std::sort(passed.begin(), passed.end(),
            [](const Passed& a, const Passed& b) { return a.angle < b.angle; });
  passed.resize(std::min(passed.size(), kSuggesting));
  // A point that the ray meets says it alone; of others those nearer to the ray say more.
  double weights = 0;
  double inverse = 0;
  for (const Passed& p : passed) {
    const double weight = 1 / (p.angle * p.angle + 1e-5);
    weights += weight;
    inverse += weight / p.distance;
  }
  return Vector3d(ray.origin_in_world + weights / inverse * direction);
}

std::optional<Vector3d> SparseView::nearest(const Vector3d& point, double radius) const {
  const Place* place = closest(points_, point);
  if (!place || (place->point_in_world - point).norm() > radius) return std::nullopt;
  return place->point_in_world;
}

std::vector<Vector3d> SparseView::around(const Vector3d& point) const {
  std::vector<Vector3d> near;
  for (const Place& place : points_) {
    if ((place.point_in_world - point).norm() < kFarFromAll) near.push_back(place.point_in_world);
  }
  std::sort(near.begin(), near.end(), [&](const Vector3d& a, const Vector3d& b) {
    return (a - point).squaredNorm() < (b - point).squaredNorm();
  });
  near.resize(std::min(near.size(), kSpanning));
  return near;
}

std::optional<Plane> SparseView::local_plane(const Vector3d& point, double) const {
  const std::vector<Vector3d> near = around(point);
  if (near.empty()) return std::nullopt;
  Vector3d normal = normal_of(near).value_or(up_);
  if (normal.dot(viewer_ - point) < 0) normal = -normal;
  return Plane{point, normal};
}

Anchor SparseView::anchor(const Pose& world_from_thing) const {
  const Place* place = closest(points_, world_from_thing.translation());
  if (!place) return {0, world_from_thing};
  return {place->id, Pose(world_from_thing.rotation(),
                          world_from_thing.translation() - place->point_in_world)};
}

Pose SparseView::resolve(const Anchor& anchor) const {
  const Place* place = find(points_, anchor.id);
  if (!place) place = find(*gone_, anchor.id);
  if (!place) return anchor.world_from_anchor;  // of another day
  return {anchor.world_from_anchor.rotation(),
          place->point_in_world + anchor.world_from_anchor.translation()};
}

WorldViewPtr SparseViewMaker::view(const MonoResult& result, const Vector3d& up_in_world) {
  SparseView::Places now;
  for (const MapPoint& point : result.points) {
    if (point.kind == PointKind::position) now.push_back({point.id, point.position});
  }
  SparseView::Places left;
  std::set_difference(known_.begin(), known_.end(), now.begin(), now.end(),
                      std::back_inserter(left),
                      [](const auto& a, const auto& b) { return a.id < b.id; });
  if (!left.empty()) {
    auto gone = std::make_shared<SparseView::Places>();
    std::merge(gone_->begin(), gone_->end(), left.begin(), left.end(), std::back_inserter(*gone),
               [](const auto& a, const auto& b) { return a.id < b.id; });
    gone_ = std::move(gone);
  }
  known_ = now;
  return std::make_shared<const SparseView>(std::move(now), gone_, up_in_world,
                                            result.world_from_camera.translation(), ++revision_);
}

}  // namespace armsreach::mono_slam
