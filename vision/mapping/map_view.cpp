#include "vision/mapping/map_view.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include <Eigen/Eigenvalues>

#include "vision/mapping/ray_march.hpp"

namespace armsreach::mapping {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

Vector3d cube_centre(const BlockKey& key, double edge) {
  return edge * Vector3d(key.x + 0.5, key.y + 0.5, key.z + 0.5);
}

// Distance from a point to a cube.
double distance_to_cube(const Vector3d& point, const Vector3d& centre, double edge) {
  return ((point - centre).cwiseAbs().array() - edge / 2).max(0).matrix().norm();
}

struct Near {
  double distance;  // at least
  BlockKey key;
};

// Blocks that may hold surface points within the radius, nearest first. A block's points reach half
// a voxel before and a voxel beyond it.
std::vector<Near> blocks_near(const VoxelGrid& grid, const Vector3d& point, double radius) {
  const double block_edge = kBlockEdge * grid.resolution;
  const double region_edge = kRegionEdge * block_edge;
  const double slack = 1.5 * grid.resolution;
  std::vector<Near> found;
  grid.blocks.for_each_region([&](const BlockKey& key, const Region& region) {
    if (distance_to_cube(point, cube_centre(key, region_edge), region_edge + 2 * slack) > radius) {
      return;
    }
    for (int i = 0; i < kRegionEdge * kRegionEdge * kRegionEdge; ++i) {
      if (!region.blocks[i]) continue;
      const BlockKey block = BlockTable::block_at(key, i);
      const double distance =
          distance_to_cube(point, cube_centre(block, block_edge), block_edge + 2 * slack);
      if (distance <= radius) found.push_back({distance, block});
    }
  });
  std::sort(found.begin(), found.end(), [](const Near& a, const Near& b) {
    return a.distance != b.distance ? a.distance < b.distance : a.key < b.key;
  });
  return found;
}

struct FittedPlane {
  Vector3d point;
  Vector3d normal;
  double thickness = 0;  // rms distance of the points from the plane, m
  double width = 0;      // rms extent along the narrower direction in the plane, m
  std::size_t points = 0;
};

template <class Accept>
std::optional<FittedPlane> fit(const std::vector<SurfacePoint>& points, Accept&& accept) {
  Vector3d mean = Vector3d::Zero();
  Vector3d mean_normal = Vector3d::Zero();
  std::size_t count = 0;
  for (const SurfacePoint& p : points) {
    if (!accept(p)) continue;
    mean += p.point_in_world.cast<double>();
    mean_normal += p.normal_in_world.cast<double>();
    ++count;
  }
  if (count < 6) return std::nullopt;
  mean /= static_cast<double>(count);
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const SurfacePoint& p : points) {
    if (!accept(p)) continue;
    const Vector3d offset = p.point_in_world.cast<double>() - mean;
    scatter += offset * offset.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(scatter / static_cast<double>(count));
  FittedPlane plane;
  plane.point = mean;
  plane.normal = solver.eigenvectors().col(0);
  if (plane.normal.dot(mean_normal) < 0) plane.normal = -plane.normal;
  plane.thickness = std::sqrt(std::max(0.0, solver.eigenvalues()[0]));
  plane.width = std::sqrt(std::max(0.0, solver.eigenvalues()[1]));
  plane.points = count;
  return plane;
}

}  // namespace

std::optional<Vector3d> MapView::pick(const Ray& ray, double range) const {
  const double length = ray.direction_in_world.norm();
  if (!(length > 0) || !ray.origin_in_world.allFinite() || !std::isfinite(length)) {
    return std::nullopt;
  }
  const double per_metre = 1 / grid_.resolution;
  // The ray's parameter in metres.
  const MapRay scaled{(ray.origin_in_world * per_metre).cast<float>(),
                      (ray.direction_in_world * (per_metre / length)).cast<float>()};
  Sampler sampler(grid_);
  const auto hit = march(sampler, grid_, scaled, 0, static_cast<float>(range));
  if (!hit) return std::nullopt;
  return ray.origin_in_world + ray.direction_in_world * (static_cast<double>(hit->t) / length);
}

std::optional<Vector3d> MapView::nearest(const Vector3d& point, double radius) const {
  std::optional<Vector3d> best;
  double best_distance = radius;
  for (const Near& block : blocks_near(grid_, point, radius)) {
    if (block.distance > best_distance) break;
    for (const SurfacePoint& p : surface_points(grid_, block.key)) {
      const Vector3d at = p.point_in_world.cast<double>();
      const double distance = (at - point).norm();
      if (distance > best_distance || (best && distance == best_distance)) continue;
      best = at;
      best_distance = distance;
    }
  }
  return best;
}

std::vector<SurfacePoint> MapView::surface_near(const Vector3d& point, double radius) const {
  std::vector<BlockKey> keys;
  for (const Near& block : blocks_near(grid_, point, radius)) keys.push_back(block.key);
  std::sort(keys.begin(), keys.end());
  std::vector<SurfacePoint> found;
  const Vector3f centre = point.cast<float>();
  const auto limit = static_cast<float>(radius * radius);
  for (const BlockKey& key : keys) {
    for (const SurfacePoint& p : surface_points(grid_, key)) {
      if ((p.point_in_world - centre).squaredNorm() <= limit) found.push_back(p);
    }
  }
  return found;
}

std::optional<Plane> MapView::local_plane(const Vector3d& point, double radius) const {
  // What belongs to the surface: within a voxel of its plane (the noise of the map), facing as it
  // does (a third of a right angle leaves room for noisy normals).
  const double thick = grid_.resolution;
  constexpr double kFacing = 0.866;
  // Of all points in the radius, how many must lie on it: a mug on a table takes most of a small
  // radius, a ball has next to none.
  constexpr double kShare = 0.25;

  const std::vector<SurfacePoint> points = surface_near(point, radius);
  const auto within = [&](double limit) {
    return [&point, limit](const SurfacePoint& p) {
      return (p.point_in_world.cast<double>() - point).norm() <= limit;
    };
  };
  double reach = std::max(2.5 * grid_.resolution, radius / 4);
  std::optional<FittedPlane> plane = fit(points, within(reach));
  while (plane && reach < radius) {
    reach = std::min(radius, 1.5 * reach);
    const FittedPlane last = *plane;
    plane = fit(points, [&](const SurfacePoint& p) {
      const Vector3d offset = p.point_in_world.cast<double>() - last.point;
      return within(reach)(p) && std::abs(offset.dot(last.normal)) <= thick &&
             p.normal_in_world.cast<double>().dot(last.normal) >= kFacing;
    });
  }
  if (!plane || static_cast<double>(plane->points) < kShare * static_cast<double>(points.size()) ||
      plane->thickness > thick / 2 || plane->width < radius / 6) {
    return std::nullopt;
  }
  const double height = (point - plane->point).dot(plane->normal);
  return Plane{point - height * plane->normal, plane->normal};
}

}  // namespace armsreach::mapping
