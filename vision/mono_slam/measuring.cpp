// One frame of MonoSlam's filter: what is expected, looked for, found and taken.
#include <algorithm>

#include <Eigen/LU>

#include "vision/mono_slam/mono_slam.hpp"
#include "vision/mono_slam/search.hpp"

namespace armsreach::mono_slam {

using Eigen::Vector2d;

namespace {

// The deviation of a match in units of the usual one. 1 - ZNCC is the share of what is seen that
// the template does not explain; what displaces the peak grows with its root.
double noise_of(double score) {
  constexpr double kUsual = 0.05;
  return std::clamp(std::sqrt((1 - score) / kUsual), 0.7, 3.0);
}

}  // namespace

std::optional<Prediction> MonoSlam::expected(const Landmark& landmark) const {
  const Point& point = filter_.point(landmark.id);
  if (point.kind == PointKind::ray) return std::nullopt;
  // A point whose distance is anybody's guess is recognisable for as long as it is in view.
  if (point.kind == PointKind::position &&
      !recognisable(landmark, point.position(), filter_.camera_state().world_from_camera(),
                    options_.rules)) {
    return std::nullopt;
  }
  auto prediction = filter_.predict(landmark.id);
  if (prediction && !well_inside(camera_, prediction->sighting.pixel, options_.rules)) {
    return std::nullopt;
  }
  return prediction;
}

std::vector<MonoSlam::Look> MonoSlam::expected_looks() const {
  std::vector<Look> out;
  for (std::size_t i = 0; i < landmarks_.size(); ++i) {
    const auto prediction = expected(landmarks_[i]);
    if (prediction) out.push_back({i, *prediction});
  }
  return out;
}

std::optional<Match> MonoSlam::look_for(Landmark* landmark, const Prediction& prediction,
                                        double deviations) const {
  const Point& point = filter_.point(landmark->id);
  Template pattern = landmark->patch.original();
  constexpr double kKnown = 0.3;  // of an inverse depth, its deviation
  if (point.kind == PointKind::position ||
      filter_.inverse_depth_sigma(landmark->id) < kKnown * point.values[5]) {
    pattern = warped(landmark->patch, warp(landmark->patch, point.position(), camera_,
                                           filter_.camera_state().world_from_camera()));
  }
  const auto match = search(image_, pattern,
                            ellipse(prediction.sighting.pixel - pattern.pixel_from_centre,
                                    prediction.covariance, deviations),
                            options_.least_score);
  if (!match) return std::nullopt;
  landmark->latest = pattern;
  return match;
}

// Takes what agrees into the filter if that is `least` or more; the number that agrees.
int MonoSlam::take(const std::vector<Look*>& group, const std::vector<Measurement>& measurements,
                   int least) {
  if (measurements.empty()) return 0;
  const std::vector<int> agreeing =
      consensus(filter_.innovation(measurements), options_.pixel_sigma, options_.consensus);
  for (Look* look : group) look->outcome = Outcome::rejected;
  if (static_cast<int>(agreeing.size()) < least) return 0;
  for (const int i : agreeing) group[static_cast<std::size_t>(i)]->outcome = Outcome::measured;
  filter_.update(agreeing);
  return static_cast<int>(agreeing.size());
}

// The points whose place in the image is least certain tell most, so they are sought first; what
// they tell makes the search for all others short and sure. Points at uncertain distances tell
// little about the camera and come with the others.
void MonoSlam::measure(double deviations) {
  looks_ = expected_looks();
  std::vector<Look*> order;
  for (Look& look : looks_) order.push_back(&look);
  const auto known = [&](const Look* look) {
    return filter_.point(look->prediction.id).kind == PointKind::position;
  };
  std::stable_sort(order.begin(), order.end(), [&](const Look* a, const Look* b) {
    if (known(a) != known(b)) return known(a);
    return a->prediction.covariance.determinant() > b->prediction.covariance.determinant();
  });
  if (order.size() > Filter::kMostMeasurements) order.resize(Filter::kMostMeasurements);

  std::vector<Look*> found;
  std::vector<Measurement> measurements;
  const auto seek = [&](Look* look, const Prediction& prediction) {
    const auto match = look_for(&landmarks_[look->landmark], prediction, deviations);
    if (!match) return;
    look->measured = match->pixel;
    measurements.push_back({prediction, match->pixel, noise_of(match->score)});
    look->innovation = measurements.back().innovation();
    found.push_back(look);
  };
  std::size_t next = 0;
  for (; next < order.size() && static_cast<int>(next) < options_.first_group; ++next) {
    seek(order[next], order[next]->prediction);
  }
  // What the first ones agreed on is where the others are held against, however few those are.
  int least = options_.least_inliers;
  if (take(found, measurements, least) > 0) {
    least = 1;
    found.clear();
    measurements.clear();
    for (; next < order.size(); ++next) {
      const auto again = filter_.predict(order[next]->prediction.id);
      if (again) seek(order[next], *again);
    }
  } else {
    for (; next < order.size(); ++next) seek(order[next], order[next]->prediction);
  }
  take(found, measurements, least);
}

void MonoSlam::weigh_particles() {
  for (Landmark& landmark : landmarks_) {
    if (!landmark.particles) continue;
    const auto hypotheses = landmark.particles->predict(filter_, landmark.id);
    if (hypotheses.empty()) continue;
    Region region;
    for (const auto& h : hypotheses) {
      region = merged(region, ellipse(h.prediction.sighting.pixel, h.prediction.covariance,
                                      options_.search_deviations));
    }
    ++landmark.attempts;
    const Template pattern = landmark.patch.original();
    const auto match = search(image_, pattern, region, options_.least_score);
    if (!match) continue;
    ++landmark.successes;
    landmark.latest = pattern;
    landmark.particles->weigh(hypotheses, match->pixel, options_.prune);
  }
}

}  // namespace armsreach::mono_slam
