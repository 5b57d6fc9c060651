#include "vision/mono_slam/relocaliser.hpp"

#include <algorithm>

namespace armsreach::mono_slam {
namespace {

using Eigen::Vector2d;

struct Candidate {
  std::size_t point;
  std::vector<Match> places;  // where something like it is
};

std::vector<Candidate> candidates(const SearchImage& image, const std::vector<KnownPoint>& points,
                                  const RelocaliserOptions& options) {
  std::vector<Candidate> out;
  for (std::size_t i = 0; i < points.size(); ++i) {
    auto places = search_all_coarsely(image, points[i].landmark->latest, options.least_score,
                                      options.most_places);
    if (!places.empty()) out.push_back({i, std::move(places)});
  }
  return out;
}

// What of the candidates lies where a pose puts it.
std::vector<SeenPoint> supporters(const Camera& camera, const Pose& world_from_camera,
                                  const std::vector<KnownPoint>& points,
                                  const std::vector<Candidate>& candidates, double tolerance) {
  std::vector<SeenPoint> out;
  const Pose camera_from_world = world_from_camera.inverse();
  for (const Candidate& candidate : candidates) {
    const Eigen::Vector3d& point = points[candidate.point].point_in_world;
    const auto pixel = project(camera, camera_from_world * point);
    if (!pixel) continue;
    for (const Match& place : candidate.places) {
      if ((place.pixel - *pixel).norm() > tolerance) continue;
      out.push_back({point, place.pixel});
      break;
    }
  }
  return out;
}

std::vector<SeenPoint> triple(const std::vector<KnownPoint>& points,
                              const std::vector<Candidate>& candidates, std::mt19937_64* random) {
  std::vector<SeenPoint> out;
  std::vector<std::size_t> used;
  while (out.size() < 3) {
    const std::size_t i = (*random)() % candidates.size();
    if (std::find(used.begin(), used.end(), i) != used.end()) continue;
    used.push_back(i);
    // The most alike place is right more often than the others.
    const auto& places = candidates[i].places;
    const std::size_t place = (*random)() % 2 == 0 ? 0 : (*random)() % places.size();
    out.push_back({points[candidates[i].point].point_in_world, places[place].pixel});
  }
  return out;
}

std::vector<SeenPoint> best_support(const Camera& camera, const std::vector<KnownPoint>& points,
                                    const std::vector<Candidate>& candidates,
                                    const RelocaliserOptions& options, std::mt19937_64* random,
                                    Pose* best_pose) {
  std::vector<SeenPoint> best;
  for (int i = 0; i < options.most_samples; ++i) {
    for (const Pose& pose : three_point_poses(camera, triple(points, candidates, random))) {
      auto support = supporters(camera, pose, points, candidates, options.pixel_tolerance);
      if (support.size() <= best.size()) continue;
      best = std::move(support);
      *best_pose = pose;
    }
    if (2 * best.size() > candidates.size() && best.size() > 12) break;
  }
  return best;
}

// Looks at every point that the pose says is visible.
std::optional<Relocalisation> confirmed(const SearchImage& image, const Camera& camera,
                                        const Pose& world_from_camera,
                                        const std::vector<KnownPoint>& points,
                                        const LandmarkRules& rules,
                                        const RelocaliserOptions& options) {
  constexpr int kRadius = 5;  // px
  Relocalisation out;
  std::vector<SeenPoint> seen;
  int visible = 0;
  const Pose camera_from_world = world_from_camera.inverse();
  for (const KnownPoint& known : points) {
    const auto pixel = project(camera, camera_from_world * known.point_in_world);
    if (!pixel || !well_inside(camera, *pixel, rules)) continue;
    if (!recognisable(*known.landmark, known.point_in_world, world_from_camera, rules)) continue;
    ++visible;
    const Template pattern =
        warped(known.landmark->patch,
               warp(known.landmark->patch, known.point_in_world, camera, world_from_camera));
    const auto match = search(image, pattern, square(*pixel, kRadius), options.least_score);
    if (!match) continue;
    out.confirmed.push_back({known.landmark->id, match->pixel});
    seen.push_back({known.point_in_world, match->pixel});
  }
  const auto fix = refined_pose(camera, world_from_camera, seen);
  if (!fix) return std::nullopt;
  out.world_from_camera = fix->world_from_camera;
  // The farthest-off ones are something else that looks alike.
  const Pose refined_inverse = fix->world_from_camera.inverse();
  std::size_t kept = 0;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const auto pixel = project(camera, refined_inverse * seen[i].point_in_world);
    if (!pixel || (*pixel - seen[i].pixel).norm() > options.pixel_tolerance) continue;
    out.confirmed[kept++] = out.confirmed[i];
  }
  out.confirmed.resize(kept);
  const bool enough = static_cast<int>(kept) >= options.least_confirmed &&
                      static_cast<double>(kept) >= options.least_share * visible;
  if (!enough) return std::nullopt;
  return out;
}

}  // namespace

std::optional<Relocalisation> relocalise(const SearchImage& image, const Camera& camera,
                                         const std::vector<KnownPoint>& points,
                                         const LandmarkRules& rules,
                                         const RelocaliserOptions& options,
                                         std::mt19937_64* random) {
  const std::vector<Candidate> found = candidates(image, points, options);
  if (static_cast<int>(found.size()) < options.least_supporters) return std::nullopt;
  Pose pose;
  const std::vector<SeenPoint> support =
      best_support(camera, points, found, options, random, &pose);
  if (static_cast<int>(support.size()) < options.least_supporters) return std::nullopt;
  const auto fix = refined_pose(camera, pose, support);
  if (!fix) return std::nullopt;
  return confirmed(image, camera, fix->world_from_camera, points, rules, options);
}

}  // namespace armsreach::mono_slam
