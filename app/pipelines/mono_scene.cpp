#include "app/pipelines/mono_scene.hpp"

#include <algorithm>

#include "vision/mono_slam/mono_slam.hpp"

namespace armsreach::app {
namespace {

using mono_slam::MapPoint;
using mono_slam::Outcome;
using mono_slam::PointKind;

render::FeatureState state_of(const MapPoint& point) {
  if (point.outcome == Outcome::rejected || point.outcome == Outcome::not_found)
    return render::FeatureState::failed;
  return point.kind == PointKind::position ? render::FeatureState::tracked
                                           : render::FeatureState::candidate;
}

// Where it was found, with the ellipse it was sought in; what was not found, where it was expected.
render::Feature feature_of(const MapPoint& point, const Eigen::Vector2d& scale) {
  const Eigen::Vector2d pixel = point.measured.value_or(*point.predicted);
  const Eigen::Matrix2d covariance =
      scale.asDiagonal() * point.innovation_covariance * scale.asDiagonal();
  // Pixels are counted from the middle of the first one.
  const Eigen::Vector2d shown = (pixel.array() + 0.5) * scale.array() - 0.5;
  return {shown.cast<float>(), covariance.cast<float>(), state_of(point)};
}

void add_particles(const MapPoint& point, render::Scene* scene) {
  double heaviest = 0;
  for (const auto& [place, weight] : point.particles) heaviest = std::max(heaviest, weight);
  for (const auto& [place, weight] : point.particles)
    scene->particles.push_back({place.cast<float>(), static_cast<float>(weight / heaviest)});
}

}  // namespace

void add_sparse_map(const TrackedFrame& tracked, render::Scene* scene) {
  const Eigen::Vector2d scale(static_cast<double>(scene->background.cols) / tracked.camera.width,
                              static_cast<double>(scene->background.rows) / tracked.camera.height);
  for (const MapPoint& point : tracked.mono->points) {
    if (point.predicted) scene->features.push_back(feature_of(point, scale));
    if (point.kind == PointKind::ray) {
      add_particles(point, scene);
      continue;
    }
    // What is not looked for is known no worse because of that.
    const auto state = point.outcome == Outcome::out_of_view && point.kind == PointKind::position
                           ? render::FeatureState::tracked
                           : state_of(point);
    scene->points.push_back({point.position.cast<float>(), point.covariance.cast<float>(), state});
  }
  scene->world_axes = tracked.mono->scale != mono_slam::ScaleFrom::nothing_yet;
}

}  // namespace armsreach::app
