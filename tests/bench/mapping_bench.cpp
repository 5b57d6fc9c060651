// Insertion and reference view beside stock OctoMap: on the same rays (insertPointCloud, castRay)
// and on the same keys (updateNode); over resolutions and over the size of the map. Each benchmark
// does one step of ours and one of the peer's in turn and reports both in milliseconds and their
// ratio. The frames are a recording's, with true poses, or without recordings a simulated room's.
#include <cmath>
#include <cstdint>
#include <time.h>
#include <vector>

#include <benchmark/benchmark.h>
#include <octomap/OcTree.h>

#include "tests/support/recorded_views.hpp"
#include "tests/support/recordings.hpp"
#include "vision/core/pyramid.hpp"
#include "vision/mapping/mesh.hpp"
#include "vision/mapping/ray_cast.hpp"
#include "vision/mapping/voxel_map.hpp"

namespace {

using armsreach::Camera;
using armsreach::Pose;
using armsreach::test::RecordedView;
using armsreach::test::RecordedViews;
using namespace armsreach::mapping;

// Frames of the recording, ten apart: fewer where the peer takes seconds for each.
int frames_for(int millimetres, int width) {
  return width > 160 ? 1 : width > 80 || millimetres < 10 ? 2 : 4;
}

RecordedViews simulate_room(int width, int count) {
  RecordedViews out{armsreach::resized(armsreach::pinhole(640, 480, 585, 585, 319.5, 239.5), width,
                                       width * 3 / 4),
                    {}};
  const Eigen::Array3d half(2, 1.5, 2);
  for (int i = 0; i < count; ++i) {
    const Pose pose(Eigen::Quaterniond(Eigen::AngleAxisd(0.1 * i, Eigen::Vector3d::UnitY())),
                    {0.05 * i, 0, 0});
    cv::Mat depth(out.camera.height, out.camera.width, CV_32FC1);
    for (int v = 0; v < depth.rows; ++v) {
      for (int u = 0; u < depth.cols; ++u) {
        const Eigen::Array3d ray =
            (pose.rotation() * armsreach::unproject(out.camera, {u, v})).array();
        depth.at<float>(v, u) =
            static_cast<float>(((half * ray.sign() - pose.translation().array()) / ray).minCoeff());
      }
    }
    out.views.push_back({depth, cv::Mat(depth.size(), CV_32FC1, cv::Scalar(0.5)), pose});
  }
  return out;
}

RecordedViews read_shots(int millimetres, int width) {
  const int count = frames_for(millimetres, width);
  const auto folder = armsreach::test::recording("rgbd/redkitchen");
  return folder ? armsreach::test::recorded_views(*folder, width, count, 10)
                : simulate_room(width, count);
}

// Of this thread's processor time: what else runs on the machine does not count.
double milliseconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) * 1e3 + static_cast<double>(time.tv_nsec) * 1e-6;
}

void report(benchmark::State& state, double ours, double peer, double steps) {
  state.counters["ours_ms"] = ours / steps;
  state.counters["peer_ms"] = peer / steps;
  state.counters["times_faster"] = peer / ours;
}

// Memory, and what it is a square metre of mapped surface.
void report_size(benchmark::State& state, const VoxelMap& map) {
  const double megabytes =
      static_cast<double>(map.grid().blocks.block_count() * sizeof(Block)) / 1e6;
  const double square_metres = area(surface_mesh(map.grid()));
  state.counters["map_MB"] = megabytes;
  state.counters["map_m2"] = square_metres;
  state.counters["MB_per_m2"] = megabytes / square_metres;
}

VoxelMapOptions options_at(double resolution) {
  VoxelMapOptions options;
  options.resolution = resolution;
  options.max_blocks = 1'000'000;
  return options;
}

octomap::point3d point(const Eigen::Vector3d& p) {
  return {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())};
}

octomap::Pointcloud cloud_of(const RecordedViews& shots, const RecordedView& shot) {
  octomap::Pointcloud cloud;
  for (int v = 0; v < shot.depth.rows; ++v) {
    for (int u = 0; u < shot.depth.cols; ++u) {
      const double depth = static_cast<double>(shot.depth.at<float>(v, u));
      if (!(depth > 0)) continue;
      cloud.push_back(
          point(shot.world_from_camera * (depth * armsreach::unproject(shots.camera, {u, v}))));
    }
  }
  return cloud;
}

// Arguments: resolution in millimetres, image width.
void insert_beside_insert_point_cloud(benchmark::State& state) {
  const double resolution = static_cast<double>(state.range(0)) / 1000;
  const RecordedViews shots =
      read_shots(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
  VoxelMap map(options_at(resolution));
  octomap::OcTree tree(resolution);
  double ours = 0;
  double peer = 0;
  double steps = 0;
  for (auto _ : state) {
    for (const RecordedView& shot : shots.views) {
      const octomap::Pointcloud cloud = cloud_of(shots, shot);
      double start = milliseconds();
      map.insert(shot.depth, shot.intensity, cv::Mat(), shots.camera, shot.world_from_camera);
      ours += milliseconds() - start;
      start = milliseconds();
      tree.insertPointCloud(cloud, point(shot.world_from_camera.translation()));
      peer += milliseconds() - start;
      ++steps;
    }
  }
  report(state, ours, peer, steps);
  report_size(state, map);
}

void cast_with_octomap(const octomap::OcTree& tree, const Camera& camera,
                       const Pose& world_from_camera) {
  const octomap::point3d origin = point(world_from_camera.translation());
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      octomap::point3d end;
      const Eigen::Vector3d ray =
          world_from_camera.rotation() * armsreach::unproject(camera, {u, v});
      benchmark::DoNotOptimize(tree.castRay(origin, point(ray), end, true, 8));
    }
  }
}

void cast_beside_cast_ray(benchmark::State& state) {
  const double resolution = static_cast<double>(state.range(0)) / 1000;
  const RecordedViews shots =
      read_shots(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
  VoxelMap map(options_at(resolution));
  octomap::OcTree tree(resolution);
  for (const RecordedView& shot : shots.views) {
    map.insert(shot.depth, shot.intensity, cv::Mat(), shots.camera, shot.world_from_camera);
    tree.insertPointCloud(cloud_of(shots, shot), point(shot.world_from_camera.translation()));
  }
  double ours = 0;
  double peer = 0;
  double steps = 0;
  for (auto _ : state) {
    for (const RecordedView& shot : shots.views) {
      double start = milliseconds();
      benchmark::DoNotOptimize(cast(map.grid(), shots.camera, shot.world_from_camera));
      ours += milliseconds() - start;
      start = milliseconds();
      cast_with_octomap(tree, shots.camera, shot.world_from_camera);
      peer += milliseconds() - start;
      ++steps;
    }
  }
  report(state, ours, peer, steps);
}

struct Update {
  octomap::OcTreeKey key;
  float log_odds;
};

template <class F>
void for_each_seen(const VoxelGrid& grid, F&& f) {
  for (const BlockKey& key : grid.blocks.keys()) {
    const Block& block = *grid.blocks.find(key);
    for (int at = 0; at < kBlockVoxels; ++at) {
      if (block.log_odds(at) == 0) continue;
      const VoxelInBlock voxel = voxel_at(at);
      const auto axis = [](int block_index, int offset) {
        return static_cast<octomap::key_type>(kBlockEdge * block_index + offset + 32768);
      };
      f(Update{{axis(key.x, voxel.x), axis(key.y, voxel.y), axis(key.z, voxel.z)},
               static_cast<float>(block.log_odds(at)) * kLogOddsUnit});
    }
  }
}

// What one frame alone does to a map: the keys and their log-odds.
std::vector<Update> updates_of(const RecordedViews& shots, const RecordedView& shot,
                               const VoxelMapOptions& options) {
  VoxelMap one(options);
  one.insert(shot.depth, shot.intensity, cv::Mat(), shots.camera, shot.world_from_camera);
  std::vector<Update> updates;
  for_each_seen(one.grid(), [&](const Update& update) { updates.push_back(update); });
  return updates;
}

double intersection_over_union(const VoxelMap& map, const octomap::OcTree& tree) {
  const auto threshold = static_cast<float>(log_odds(map.options().occupied_above));
  double both = 0;
  double either = 0;
  for_each_seen(map.grid(), [&](const Update& ours) {
    const octomap::OcTreeNode* theirs = tree.search(ours.key);
    const bool a = ours.log_odds > threshold;
    const bool b = theirs && theirs->getLogOdds() > threshold;
    both += a && b;
    either += a || b;
  });
  return both / either;
}

void insert_beside_update_node(benchmark::State& state) {
  VoxelMapOptions options = options_at(static_cast<double>(state.range(0)) / 1000);
  options.carve_every = 0;
  const RecordedViews shots =
      read_shots(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
  VoxelMap map(options);
  octomap::OcTree tree(options.resolution);
  tree.setClampingThresMin(options.least_certain);
  tree.setClampingThresMax(options.most_certain);
  std::vector<std::vector<Update>> updates;
  for (const RecordedView& shot : shots.views) updates.push_back(updates_of(shots, shot, options));
  double ours = 0;
  double peer = 0;
  double steps = 0;
  for (auto _ : state) {
    for (std::size_t i = 0; i < updates.size(); ++i) {
      const RecordedView& shot = shots.views[i];
      double start = milliseconds();
      map.insert(shot.depth, shot.intensity, cv::Mat(), shots.camera, shot.world_from_camera);
      ours += milliseconds() - start;
      start = milliseconds();
      for (const Update& update : updates[i]) tree.updateNode(update.key, update.log_odds, true);
      tree.updateInnerOccupancy();
      peer += milliseconds() - start;
      ++steps;
    }
  }
  report(state, ours, peer, steps);
  state.counters["keys"] = static_cast<double>(updates.front().size());
  state.counters["IoU"] = intersection_over_union(map, tree);
}

// A mapped place and as many copies of it around, ten metres apart, as make a map of `places`; in
// both forms. Steps are then made in the first place.
struct LargeMap {
  VoxelMap map;
  octomap::OcTree tree;

  LargeMap(const VoxelMap& place, int places)
      : map(place.options()), tree(place.options().resolution) {
    constexpr int kRow = 3;
    const int apart = static_cast<int>(10 / (kBlockEdge * place.options().resolution));
    for (int i = 0; i < places; ++i) {
      for (const BlockKey& key : place.grid().blocks.keys()) {
        map.put({key.x + apart * (i % kRow), key.y, key.z - apart * (i / kRow)},
                *place.grid().blocks.find(key));
      }
    }
    for_each_seen(map.grid(), [&](const Update& update) {
      tree.setNodeValue(update.key, update.log_odds, true);
    });
    tree.updateInnerOccupancy();
  }
};

// Argument: places.
void step_in_a_large_map(benchmark::State& state) {
  VoxelMapOptions options = options_at(0.01);
  options.carve_every = 0;  // the peer's keys are the band's
  const RecordedViews shots = read_shots(10, 80);
  VoxelMap place(options);
  std::vector<std::vector<Update>> updates;
  for (const RecordedView& shot : shots.views) {
    place.insert(shot.depth, shot.intensity, cv::Mat(), shots.camera, shot.world_from_camera);
    updates.push_back(updates_of(shots, shot, options));
  }
  LargeMap large(place, static_cast<int>(state.range(0)));
  double insertion = 0;
  double update_node = 0;
  double view = 0;
  double cast_ray = 0;
  double snapshot = 0;
  double steps = 0;
  const auto time = [](double& sum, auto&& step) {
    const double start = milliseconds();
    step();
    sum += milliseconds() - start;
  };
  for (auto _ : state) {
    for (std::size_t i = 0; i < updates.size(); ++i, ++steps) {
      const RecordedView& shot = shots.views[i];
      const Pose& pose = shot.world_from_camera;
      time(insertion,
           [&] { large.map.insert(shot.depth, shot.intensity, cv::Mat(), shots.camera, pose); });
      time(update_node, [&] {
        for (const Update& u : updates[i]) large.tree.updateNode(u.key, u.log_odds, false);
      });
      time(view, [&] { benchmark::DoNotOptimize(cast(large.map.grid(), shots.camera, pose)); });
      time(cast_ray, [&] { cast_with_octomap(large.tree, shots.camera, pose); });
      time(snapshot, [&] { benchmark::DoNotOptimize(large.map.snapshot()); });
    }
  }
  state.counters["insert_ms"] = insertion / steps;
  state.counters["update_node_ms"] = update_node / steps;
  state.counters["view_ms"] = view / steps;
  state.counters["cast_ray_ms"] = cast_ray / steps;
  state.counters["snapshot_ms"] = snapshot / steps;
  report_size(state, large.map);
}

void resolutions_and_sizes(benchmark::internal::Benchmark* bench) {
  for (const int millimetres : {20, 10, 5}) bench->Args({millimetres, 80});
  for (const int width : {160, 320, 640}) bench->Args({10, width});
  bench->ArgNames({"mm", "width"})->Unit(benchmark::kMillisecond)->Iterations(1);
}

BENCHMARK(insert_beside_insert_point_cloud)->Apply(resolutions_and_sizes);
BENCHMARK(insert_beside_update_node)->Apply(resolutions_and_sizes);
BENCHMARK(cast_beside_cast_ray)->Apply(resolutions_and_sizes);
BENCHMARK(step_in_a_large_map)
    ->ArgName("places")
    ->RangeMultiplier(2)
    ->Range(1, 8)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(1);

}  // namespace
