#include "devices/sim/world_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <Eigen/Geometry>

#include "devices/sim/patches.hpp"

namespace armsreach::sim {
namespace {

constexpr int kAtlasWidth = 512;

// Soft light changes over centimetres on large faces and over millimetres on small things.
int texel_count(double length, const Patch& patch) {
  const double texel = std::clamp(std::max(patch.width, patch.height) / 100, 0.005, 0.03);
  const int least = patch.triangle ? 2 : 4;  // a mesh's corners are close as they are
  return std::clamp(static_cast<int>(std::ceil(length / texel)), least, kAtlasWidth);
}

struct Chart {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
};

// Rectangles side by side in rows as high as their highest.
class Shelves {
 public:
  Chart place(int width, int height) {
    if (x_ + width > kAtlasWidth) {
      y_ += row_;
      x_ = row_ = 0;
    }
    const Chart chart{x_, y_, width, height};
    x_ += width;
    row_ = std::max(row_, height);
    return chart;
  }
  int height() const { return y_ + row_; }

 private:
  int x_ = 0;
  int y_ = 0;
  int row_ = 0;
};

struct PlacedPatch {
  std::size_t part = 0;
  Patch patch;
  Chart chart;
};

// All patches of the world in the order of its parts; charts are placed from the highest to the
// lowest, which wastes little.
std::vector<PlacedPatch> placed_patches(const World& world, Shelves& shelves) {
  std::vector<PlacedPatch> placed;
  for (std::size_t i = 0; i < world.parts.size(); ++i) {
    for (Patch& patch : patches_of(world.parts[i].shape)) {
      const Chart chart{0, 0, texel_count(patch.width, patch), texel_count(patch.height, patch)};
      placed.push_back({i, std::move(patch), chart});
    }
  }
  std::vector<std::size_t> order(placed.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return placed[a].chart.height > placed[b].chart.height;
  });
  for (const std::size_t i : order)
    placed[i].chart = shelves.place(placed[i].chart.width, placed[i].chart.height);
  return placed;
}

// On a mesh a pattern in metres is seen along the axis that a triangle faces most.
Eigen::Vector2d texture_on(const MeshTriangle& triangle, const Material& material, double u,
                           double v, const Eigen::Vector3d& position) {
  const auto& at = triangle.pictured;
  if (material.fit) return (1 - u) * at[0] + (u - v) * at[1] + v * at[2];
  const auto& corner = triangle.positions;
  Eigen::Index axis = 0;
  (corner[1] - corner[0]).cross(corner[2] - corner[0]).cwiseAbs().maxCoeff(&axis);
  const Eigen::Vector2d metres(position[axis == 0 ? 1 : 0], -position[axis == 2 ? 1 : 2]);
  return metres / material.size;
}

Eigen::Vector2d texture_at(const Patch& patch, const Material& material, double u, double v,
                           const Eigen::Vector3d& position) {
  if (patch.triangle) return texture_on(*patch.triangle, material, u, v, position);
  if (material.fit && patch.fit_height > 0) return {u, 1 - position.z() / patch.fit_height};
  if (material.fit) return {u * patch.fit.x(), (1 - v) * patch.fit.y()};
  const Eigen::Vector2d metres = patch.disc ? Eigen::Vector2d(position.x(), -position.y())
                                            : Eigen::Vector2d(u * patch.width, -v * patch.height);
  return metres / material.size;
}

void add_vertex(const PlacedPatch& placed, const Pose& thing_from_part, const Material& material,
                double u, double v, WorldMesh& mesh) {
  const Chart& chart = placed.chart;
  const SurfacePoint point = placed.patch.at(u, v);
  // The patch's edge lies on the centres of its outer texels, so that filtering never reaches a
  // neighbour's.
  const Eigen::Vector2d light((chart.x + 0.5 + u * (chart.width - 1)) / mesh.atlas_width,
                              (chart.y + 0.5 + v * (chart.height - 1)) / mesh.atlas_height);
  const Eigen::Vector3d position = thing_from_part * point.position;
  const Eigen::Vector3d normal = thing_from_part.rotation() * point.normal;
  mesh.vertices.push_back({position.cast<float>(), normal.cast<float>(),
                           texture_at(placed.patch, material, u, v, point.position).cast<float>(),
                           light.cast<float>()});
}

void add_triangles(const PlacedPatch& placed, const Pose& thing_from_part, const Material& material,
                   WorldMesh& mesh) {
  const Patch& patch = placed.patch;
  const std::uint32_t base = static_cast<std::uint32_t>(mesh.vertices.size());
  if (patch.triangle) {
    for (const std::uint32_t corner : {0U, 1U, 2U}) {
      add_vertex(placed, thing_from_part, material, corner > 0, corner > 1, mesh);
      mesh.indices.push_back(base + corner);
    }
    return;
  }
  for (int row = 0; row <= patch.rows; ++row) {
    for (int column = 0; column <= patch.columns; ++column) {
      add_vertex(placed, thing_from_part, material, static_cast<double>(column) / patch.columns,
                 static_cast<double>(row) / patch.rows, mesh);
    }
  }
  const std::uint32_t stride = static_cast<std::uint32_t>(patch.columns) + 1;
  for (std::uint32_t row = 0; row < static_cast<std::uint32_t>(patch.rows); ++row) {
    for (std::uint32_t column = 0; column + 1 < stride; ++column) {
      const std::uint32_t corner = base + row * stride + column;
      for (const std::uint32_t offset : {0U, 1U, stride + 1, 0U, stride + 1, stride})
        mesh.indices.push_back(corner + offset);
    }
  }
}

void add_texels(const PlacedPatch& placed, const Pose& frame_from_part, int thing,
                WorldMesh& mesh) {
  const Chart& chart = placed.chart;
  for (int y = 0; y < chart.height; ++y) {
    for (int x = 0; x < chart.width; ++x) {
      const SurfacePoint point = placed.patch.at(static_cast<double>(x) / (chart.width - 1),
                                                 static_cast<double>(y) / (chart.height - 1));
      const Eigen::Vector3d position = frame_from_part * point.position;
      const Eigen::Vector3d normal = frame_from_part.rotation() * point.normal;
      const std::size_t index =
          static_cast<std::size_t>((chart.y + y) * mesh.atlas_width + chart.x + x);
      LightTexel& texel = mesh.texels[index];
      mesh.texel_things[index] = thing;
      texel.position << position.cast<float>(), 1;
      texel.normal << normal.cast<float>(), 0;
    }
  }
}

}  // namespace

WorldMesh mesh_of(const World& world) {
  Shelves shelves;
  const std::vector<PlacedPatch> patches = placed_patches(world, shelves);
  WorldMesh mesh;
  mesh.atlas_width = kAtlasWidth;
  mesh.atlas_height = shelves.height();
  mesh.texels.assign(static_cast<std::size_t>(mesh.atlas_width * mesh.atlas_height),
                     {Eigen::Vector4f::Zero(), Eigen::Vector4f::Zero()});
  mesh.texel_things.assign(mesh.texels.size(), -1);
  mesh.parts.resize(world.parts.size());
  for (const PlacedPatch& placed : patches) {
    const Part& part = world.parts[placed.part];
    const Thing& thing = world.things[static_cast<std::size_t>(part.thing)];
    const std::uint32_t first = static_cast<std::uint32_t>(mesh.indices.size());
    add_triangles(placed, part.thing_from_part,
                  world.materials[static_cast<std::size_t>(part.material)], mesh);
    const Pose frame_from_thing = thing.moves ? Pose() : thing.world_from_thing;
    add_texels(placed, frame_from_thing * part.thing_from_part, part.thing, mesh);
    MeshRange& range = mesh.parts[placed.part];
    if (range.count == 0) range.first = first;
    range.count += static_cast<std::uint32_t>(mesh.indices.size()) - first;
  }
  return mesh;
}

}  // namespace armsreach::sim
