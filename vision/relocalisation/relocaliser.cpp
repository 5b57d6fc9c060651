#include "vision/relocalisation/relocaliser.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "vision/relocalisation/matching.hpp"
#include "vision/relocalisation/three_point.hpp"

namespace armsreach::relocalisation {
namespace {

// How far apart two views are, in units of the distance and the angle at which a new one is kept.
double separation(const Pose& a, const Pose& b, const RelocaliserOptions& options) {
  const Pose between = a.inverse() * b;
  return std::max(between.translation().norm() / options.key_distance,
                  so3_log(between.rotation()).norm() / options.key_angle);
}

Features with_depth(const Features& features) {
  Features known;
  for (std::size_t i = 0; i < features.size(); ++i) {
    if (features.places[i].depth > 0) known.push_back(features.places[i], features.descriptors[i]);
  }
  return known;
}

// The key frames that a glance at the strongest features finds most like the query.
KeyFrames best_ranked(const KeyFrames& key_frames, const Features& query,
                      const RelocaliserOptions& options) {
  std::vector<std::pair<std::size_t, std::size_t>> ranked;  // matches, position
  for (std::size_t i = 0; i < key_frames.size(); ++i) {
    const std::size_t matches = match_features(query, key_frames[i]->view.features,
                                               options.match_ratio, options.most_glanced)
                                    .size();
    ranked.emplace_back(matches, i);
  }
  const std::size_t kept = std::min(ranked.size(), static_cast<std::size_t>(options.most_tried));
  std::partial_sort(ranked.begin(), ranked.begin() + static_cast<std::ptrdiff_t>(kept),
                    ranked.end(), [](const auto& a, const auto& b) {
                      return a.first != b.first ? a.first > b.first : a.second < b.second;
                    });
  KeyFrames best;
  for (std::size_t i = 0; i < kept; ++i) best.push_back(key_frames[ranked[i].second]);
  return best;
}

Sighting sighting(const KeyFrame& key_frame, int known, const Features& query, int seen) {
  const Feature& place = query.places[seen];
  return {key_frame.world_from_color * key_frame.view.features.places[known].point(),
          place.ray.cast<double>(), static_cast<double>(place.depth)};
}

std::vector<Sighting> matched_sightings(const KeyFrame& key_frame, const Features& query,
                                        double ratio) {
  std::vector<Sighting> sightings;
  for (const Match& match : match_features(query, key_frame.view.features, ratio, query.size())) {
    sightings.push_back(sighting(key_frame, match.known, query, match.query));
  }
  return sightings;
}

// What the query shows of all key frames tried, where a first pose says it should be.
std::vector<Sighting> expected_sightings(const KeyFrames& key_frames, const Features& query,
                                         const Pose& camera_from_world, double radius) {
  constexpr double kNowhere = std::numeric_limits<double>::quiet_NaN();
  std::vector<Sighting> sightings;
  for (const auto& key_frame : key_frames) {
    const Pose camera_from_known = camera_from_world * key_frame->world_from_color;
    const Features& known = key_frame->view.features;
    std::vector<Eigen::Vector2d> expected;
    for (const Feature& place : known.places) {
      const Eigen::Vector3d point = camera_from_known * place.point();
      expected.push_back(point.z() > 0 ? Eigen::Vector2d(point.head<2>() / point.z())
                                       : Eigen::Vector2d::Constant(kNowhere));
    }
    for (const Match& match : match_expected(query, known, expected, radius)) {
      sightings.push_back(sighting(*key_frame, match.known, query, match.query));
    }
  }
  return sightings;
}

// The query's pose by one key frame.
struct Recognition {
  const KeyFrame* key_frame;
  Pose camera_from_world;  // the colour camera's
  int inliers;
  double agreement;
  double confidence;
};

double agreement_share(const KeyFrame& key_frame, const View& query,
                       const Pose& camera_from_world) {
  return depth_agreement(key_frame.view, query, camera_from_world * key_frame.world_from_color)
      .share();
}

bool acceptable(const Recognition& recognition, bool has_depth, const RelocaliserOptions& options) {
  if (!has_depth) return recognition.inliers >= options.least_inliers_without_depth;
  return recognition.inliers >= options.least_inliers &&
         recognition.agreement >= options.least_agreement;
}

std::optional<Recognition> recognised(const KeyFrame& key_frame, const View& query,
                                      const RelocaliserOptions& options) {
  const auto fit = three_point_pose(
      matched_sightings(key_frame, query.features, options.match_ratio),
      {.ray_tolerance = options.pixel_tolerance * query.pixel_size, .seed = options.seed});
  if (!fit) return std::nullopt;
  const int inliers = static_cast<int>(fit->inliers.size());
  const double agreement = agreement_share(key_frame, query, fit->camera_from_world);
  const bool has_depth = !query.depth.empty();
  // Half at twenty inliers: where a wrong pose has not been seen.
  const double confidence = (has_depth ? agreement : 1) * inliers / (inliers + 20.0);
  const Recognition recognition{&key_frame, fit->camera_from_world, inliers, agreement, confidence};
  if (!acceptable(recognition, has_depth, options)) return std::nullopt;
  return recognition;
}

// One key frame's points are few and share its errors; those of all that were tried are more.
Pose refined_by_all(const KeyFrames& tried, const View& query, const Pose& camera_from_world,
                    double ray_tolerance) {
  Pose pose = camera_from_world;
  for (int round = 0; round < 2; ++round) {
    const std::vector<Sighting> sightings =
        expected_sightings(tried, query.features, pose, 2 * ray_tolerance);
    pose =
        refined_pose(pose, sightings, agreeing(sightings, pose, 2 * ray_tolerance), ray_tolerance);
  }
  return pose;
}

}  // namespace

Relocaliser::Relocaliser(const RelocaliserOptions& options) : options_(options) {}

void Relocaliser::consider(const TrackedFrame& tracked) {
  if (!trusted(tracked) || tracked.frame->color.empty() || tracked.frame->depth.empty()) return;
  const Pose world_from_color =
      tracked.world_from_camera * color_from_camera(*tracked.frame->sensor).inverse();
  for (const auto& kept : key_frames_) {
    if (separation(kept->world_from_color, world_from_color, options_) < 1) return;
  }
  auto view = view_of(*tracked.frame, options_.most_features);
  if (view->depth.empty()) return;
  view->features = with_depth(view->features);
  put(std::make_shared<const KeyFrame>(
      KeyFrame{tracked.frame->index, world_from_color, std::move(*view)}));
}

void Relocaliser::put(std::shared_ptr<const KeyFrame> key_frame) {
  key_frames_.push_back(std::move(key_frame));
  if (static_cast<int>(key_frames_.size()) <= options_.most_key_frames) return;
  std::size_t nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < key_frames_.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const double apart =
          separation(key_frames_[i]->world_from_color, key_frames_[j]->world_from_color, options_);
      if (apart >= least) continue;
      least = apart;
      nearest = j;
    }
  }
  key_frames_.erase(key_frames_.begin() + static_cast<std::ptrdiff_t>(nearest));
}

std::optional<Candidate> Relocaliser::relocalise(const Frame& frame) const {
  const auto query = view_of(frame, options_.most_features);
  if (!query) return std::nullopt;
  const KeyFrames tried = best_ranked(key_frames_, query->features, options_);
  std::optional<Recognition> best;
  for (const auto& key_frame : tried) {
    const auto found = recognised(*key_frame, *query, options_);
    if (found && (!best || found->confidence > best->confidence)) best = found;
  }
  if (!best) return std::nullopt;

  const Pose refined = refined_by_all(tried, *query, best->camera_from_world,
                                      options_.pixel_tolerance * query->pixel_size);
  best->camera_from_world = refined;
  best->agreement = agreement_share(*best->key_frame, *query, refined);
  if (!refined.is_finite() || !acceptable(*best, !query->depth.empty(), options_))
    return std::nullopt;
  return Candidate{refined.inverse() * color_from_camera(*frame.sensor), best->key_frame->frame,
                   best->inliers, best->agreement, best->confidence};
}

}  // namespace armsreach::relocalisation
