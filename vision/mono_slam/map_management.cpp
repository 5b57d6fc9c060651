// Which points MonoSlam keeps: counting, converting, giving up and adding.
#include <algorithm>
#include <cmath>

#include "vision/mono_slam/mono_slam.hpp"

namespace armsreach::mono_slam {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// How far from linear the measurement of a point with inverse depth would be as one of three rows:
// Civera, Davison, Montiel, TRO 2008, section V. Small is good.
double linearity_index(const Point& point, double inverse_sigma, const Vector3d& camera) {
  const double inverse = point.values[5];
  if (inverse <= 0) return 1e9;
  const double sigma = inverse_sigma / (inverse * inverse);
  const Vector3d from_camera = point.position() - camera;
  const double cosine = std::abs(from_camera.normalized().dot(point.direction().normalized()));
  return 4 * sigma * cosine / from_camera.norm();
}

}  // namespace

void MonoSlam::manage_map(const MonoInput& input) {
  fix_distances();
  remove_failed();
  add_points(input, options_.most_new);
}

void MonoSlam::record(const std::vector<Look>& looks) {
  for (const Look& look : looks) {
    Landmark& landmark = landmarks_[look.landmark];
    ++landmark.attempts;
    if (look.outcome == Outcome::measured) ++landmark.successes;
  }
}

void MonoSlam::fix_distances() {
  for (Landmark& landmark : landmarks_) {
    const Point& point = filter_.point(landmark.id);
    if (landmark.particles) {
      const double mean = landmark.particles->mean();
      const double sigma = landmark.particles->sigma();
      if (!(sigma < options_.known_ratio * mean)) continue;
      filter_.fix_distance(landmark.id, mean, sigma);
      landmark.particles.reset();
    } else if (point.kind == PointKind::inverse_depth) {
      const double sigma = filter_.inverse_depth_sigma(landmark.id);
      const Vector3d camera = filter_.camera_state().position;
      if (linearity_index(point, sigma, camera) > options_.linear_ratio) continue;
      filter_.make_position(landmark.id);
    } else {
      continue;
    }
    // The record of a point whose place was a guess says little about the point it has become.
    landmark.attempts = 0;
    landmark.successes = 0;
  }
}

void MonoSlam::remove_failed() {
  for (std::size_t i = landmarks_.size(); i-- > 0;) {
    const Landmark& landmark = landmarks_[i];
    const Point& point = filter_.point(landmark.id);
    const bool spent =
        landmark.particles &&
        static_cast<int>(landmark.particles->particles().size()) < options_.least_particles;
    // Behind infinity: the first match was another thing.
    const bool impossible = point.kind == PointKind::inverse_depth && point.values[5] <= 0;
    if (spent || impossible || (failed(landmark, options_.rules) && !landmark.of_target)) erase(i);
  }
}

void MonoSlam::erase(std::size_t landmark) {
  filter_.remove(landmarks_[landmark].id);
  landmarks_.erase(landmarks_.begin() + static_cast<std::ptrdiff_t>(landmark));
}

std::vector<Vector2d> MonoSlam::taken_pixels() const {
  std::vector<Vector2d> out;
  for (const Landmark& landmark : landmarks_) {
    const Point& point = filter_.point(landmark.id);
    const auto prediction = landmark.particles ? sighting_along(camera_, filter_.camera_state(),
                                                                point, landmark.particles->mean())
                                               : sighting(camera_, filter_.camera_state(), point);
    if (prediction && camera_.contains(prediction->pixel)) out.push_back(prediction->pixel);
  }
  return out;
}

void MonoSlam::add_points(const MonoInput& input, int most) {
  const auto rays = std::count_if(landmarks_.begin(), landmarks_.end(),
                                  [](const Landmark& l) { return l.particles.has_value(); });
  int wanted =
      options_.visible_points - static_cast<int>(looks_.size() + static_cast<std::size_t>(rays));
  wanted = std::min(wanted, most);
  for (int i = 0; i < wanted; ++i) {
    const auto pixel =
        interesting_pixel(input.grey, input.allowed, taken_pixels(), options_.interest, &random_);
    if (pixel) add_point(input, *pixel);
  }
}

// What is around a new pixel is about as far away, but many new points that all believe a fixed
// distance would pull the map's scale towards it; so the range of distances counts as one of the
// points around, and far fewer points say nothing.
MonoSlam::InverseDepthPrior MonoSlam::inverse_depth_prior(const Vector2d& pixel) const {
  constexpr double kNear = 30;     // px
  constexpr double kKnown = 0.2;   // of an inverse depth, its deviation
  constexpr double kSpread = 0.5;  // of the mean: steps are anywhere
  constexpr double kLeast = 0.2;   // 1/m
  constexpr int kLeastNeighbours = 4;
  if (leapt_at_) {
    // Nothing here ties the map's scale to what was mapped before, but that it is the same room.
    constexpr double kSameRoom = 0.3;
    const double around = background_inverse_distance();
    return {around, kSameRoom * around};
  }
  // Two deviations reach from the farthest to the nearest.
  const double low = 1 / options_.farthest;
  const double high = 1 / options_.nearest;
  const InverseDepthPrior anywhere{0.5 * (low + high), 0.25 * (high - low)};
  double weights = 1;
  double sum = anywhere.mean;
  double squares = anywhere.mean * anywhere.mean + anywhere.sigma * anywhere.sigma;
  int neighbours = 0;
  for (const Look& look : looks_) {
    if (look.outcome != Outcome::measured) continue;
    const PointId id = look.prediction.id;
    const Point& point = filter_.point(id);
    if (point.kind == PointKind::inverse_depth &&
        filter_.inverse_depth_sigma(id) > kKnown * point.values[5]) {
      continue;
    }
    const double inverse = 1 / (point.position() - filter_.camera_state().position).norm();
    const double weight = 1 / (1 + (*look.measured - pixel).squaredNorm() / (kNear * kNear));
    weights += weight;
    sum += weight * inverse;
    squares += weight * inverse * inverse;
    ++neighbours;
  }
  if (neighbours < kLeastNeighbours) return anywhere;
  const double mean = sum / weights;
  const double variance = squares / weights - mean * mean;
  return {mean, std::sqrt(variance + kSpread * kSpread * mean * mean + kLeast * kLeast)};
}

bool MonoSlam::add_point(const MonoInput& input, const Vector2d& pixel) {
  make_room();
  std::optional<PointId> id;
  if (options_.new_points == NewPoints::particles) {
    id = filter_.add_ray(pixel);
  } else {
    const InverseDepthPrior prior = inverse_depth_prior(pixel);
    id = filter_.add_inverse_depth(pixel, prior.mean, prior.sigma);
  }
  if (!id) return false;
  keep(*id, input.grey, pixel);
  if (options_.new_points == NewPoints::particles) {
    landmarks_.back().particles.emplace(options_.particle_count, options_.nearest,
                                        options_.farthest);
  }
  return true;
}

// Gives up the point that was found least often, if the map is full.
void MonoSlam::make_room() {
  if (static_cast<int>(landmarks_.size()) < options_.most_points &&
      filter_.has_room(kMostPointRows)) {
    return;
  }
  const auto share = [](const Landmark& l) {
    return (l.successes + 1.0) / (l.attempts + 2.0) + (l.of_target ? 1 : 0);
  };
  const auto worst =
      std::min_element(landmarks_.begin(), landmarks_.end(),
                       [&](const Landmark& a, const Landmark& b) { return share(a) < share(b); });
  erase(static_cast<std::size_t>(worst - landmarks_.begin()));
}

void MonoSlam::keep(PointId id, const cv::Mat& grey, const Vector2d& pixel) {
  Landmark landmark;
  landmark.id = id;
  landmark.patch = patch_at(grey, pixel, options_.patch_size, camera_,
                            filter_.camera_state().world_from_camera());
  landmark.latest = landmark.patch.original();
  landmarks_.push_back(std::move(landmark));
}

}  // namespace armsreach::mono_slam
