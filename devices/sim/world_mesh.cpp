#include "devices/sim/world_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "devices/sim/patches.hpp"

namespace armsreach::sim {
namespace {

constexpr int kAtlasWidth = 512;

// Soft light changes over centimetres on large faces and over millimetres on small things.
int texel_count(double length, double longer_side) {
  const double texel = std::clamp(longer_side / 100, 0.005, 0.03);
  return std::clamp(static_cast<int>(std::ceil(length / texel)), 4, kAtlasWidth);
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
      const double longer = std::max(patch.width, patch.height);
      const Chart chart{0, 0, texel_count(patch.width, longer), texel_count(patch.height, longer)};
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

Eigen::Vector2d texture_at(const Patch& patch, const Material& material, double u, double v,
                           const Eigen::Vector3d& position) {
  if (material.fit && patch.fit_height > 0) return {u, 1 - position.z() / patch.fit_height};
  if (material.fit) return {u * patch.fit.x(), (1 - v) * patch.fit.y()};
  const Eigen::Vector2d metres = patch.disc ? Eigen::Vector2d(position.x(), -position.y())
                                            : Eigen::Vector2d(u * patch.width, -v * patch.height);
  return metres / material.size;
}

void add_triangles(const PlacedPatch& placed, const Pose& thing_from_part, const Material& material,
                   WorldMesh& mesh) {
  const Patch& patch = placed.patch;
  const Chart& chart = placed.chart;
  const std::uint32_t base = static_cast<std::uint32_t>(mesh.vertices.size());
  for (int row = 0; row <= patch.rows; ++row) {
    for (int column = 0; column <= patch.columns; ++column) {
      const double u = static_cast<double>(column) / patch.columns;
      const double v = static_cast<double>(row) / patch.rows;
      const SurfacePoint point = patch.at(u, v);
      // The patch's edge lies on the centres of its outer texels, so that filtering never reaches
      // a neighbour's.
      const Eigen::Vector2d light((chart.x + 0.5 + u * (chart.width - 1)) / mesh.atlas_width,
                                  (chart.y + 0.5 + v * (chart.height - 1)) / mesh.atlas_height);
      const Eigen::Vector3d position = thing_from_part * point.position;
      const Eigen::Vector3d normal = thing_from_part.rotation() * point.normal;
      mesh.vertices.push_back({position.cast<float>(), normal.cast<float>(),
                               texture_at(patch, material, u, v, point.position).cast<float>(),
                               light.cast<float>()});
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
