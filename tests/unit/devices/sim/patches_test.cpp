#include "devices/sim/patches.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "devices/sim/world_mesh.hpp"
#include "devices/sim/worlds.hpp"

namespace armsreach::sim {
namespace {

const std::vector<Shape>& shapes() {
  static const std::vector<Shape> all{
      Box{{0.1, 0.2, 0.3}},
      Cylinder{0.05, 0.2},
      Panel{{1, 2}},
      Lathe{{{0, 0}, {0.05, 0}, {0.06, 0.1}, {0.03, 0.2}, {0, 0.2}}},
      Mug{0.04, 0.1, 0.004},
      Capsule{0.02, 0.1},
      TaperedBox{{0.1, 0.05}, {0.04, 0.06}, 0.03},
      Slab{{{-0.05, -0.01, 0.01}, {0, -0.03, 0.01}, {0.04, 0, 0.02}}, 0.01}};
  return all;
}

TEST(Patches, NormalsAreUnitAndPointToTheSideThatIsSeen) {
  constexpr double kStep = 1e-5;
  for (const Shape& shape : shapes()) {
    for (const Patch& patch : patches_of(shape)) {
      for (const double u : {0.1, 0.45, 0.9}) {
        for (const double v : {0.1, 0.5, 0.9}) {
          const SurfacePoint point = patch.at(u, v);
          EXPECT_NEAR(point.normal.norm(), 1, 1e-9);
          const Eigen::Vector3d along_u = patch.at(u + kStep, v).position - point.position;
          const Eigen::Vector3d along_v = patch.at(u, v + kStep).position - point.position;
          // Rounded profiles and the bent handle lean a little; a wrong side would give -1.
          EXPECT_GT(along_u.cross(along_v).normalized().dot(point.normal), 0.8)
              << "shape " << shape.index() << " at " << u << " " << v;
        }
      }
    }
  }
}

// Volume by the divergence theorem: right only when triangles are closed and all turn outwards.
double volume(const World& world) {
  const WorldMesh mesh = mesh_of(world);
  double sum = 0;
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const auto corner = [&](std::size_t k) -> Eigen::Vector3d {
      return mesh.vertices[mesh.indices[i + k]].position.cast<double>();
    };
    sum += corner(0).dot(corner(1).cross(corner(2))) / 6;
  }
  return sum;
}

TEST(Patches, MeshesAreClosed) {
  World world;
  world.materials.emplace_back();
  world.things.push_back({"thing", {}, {}, false});
  world.parts.push_back({0, Box{{0.1, 0.2, 0.3}}, {}, 0});
  EXPECT_NEAR(volume(world), 0.006, 1e-9);
  world.parts[0].shape = Cylinder{0.05, 0.2};
  // A polygon whose sides lie at most 0.1 mm inside of the circle.
  const double round = std::numbers::pi * 0.05 * 0.05 * 0.2;
  EXPECT_LT(volume(world), round);
  EXPECT_GT(volume(world), std::numbers::pi * (0.05 - 1e-4) * (0.05 - 1e-4) * 0.2);
  world.parts[0].shape = TaperedBox{{0.1, 0.05}, {0.04, 0.06}, 0.03};
  // A prismatoid: the height over six times lower, four times middle, and upper area.
  EXPECT_NEAR(volume(world), 0.03 / 6 * (0.005 + 4 * 0.07 * 0.055 + 0.0024), 1e-9);
  world.parts[0].shape = Slab{{{-0.05, -0.01, 0.01}, {0, -0.03, 0.01}, {0.04, 0, 0.02}}, 0.01};
  EXPECT_NEAR(volume(world), 0.01 * (0.05 * 0.03 + 0.04 * 0.03), 1e-9);
}

// If two patches shared texels, the later one's places would stand where the earlier one looks.
TEST(Patches, EveryCornerFindsItsOwnPlaceInTheLightMap) {
  const World world = *load_world("bench");
  const WorldMesh mesh = mesh_of(world);
  for (std::size_t i = 0; i < world.parts.size(); ++i) {
    const Thing& thing = world.things[static_cast<std::size_t>(world.parts[i].thing)];
    const MeshRange& range = mesh.parts[i];
    for (std::uint32_t k = range.first; k < range.first + range.count; ++k) {
      const WorldVertex& vertex = mesh.vertices[mesh.indices[k]];
      const int x = static_cast<int>(vertex.light.x() * static_cast<float>(mesh.atlas_width));
      const int y = static_cast<int>(vertex.light.y() * static_cast<float>(mesh.atlas_height));
      const LightTexel& texel = mesh.texels.at(static_cast<std::size_t>(y * mesh.atlas_width + x));
      const Eigen::Vector3d place = thing.world_from_thing * vertex.position.cast<double>();
      // Corners of flat faces lie on a texel's centre, those of turned shapes within a texel, which
      // is no larger than this for anything that is turned.
      EXPECT_LT((texel.position.head<3>().cast<double>() - place).norm(), 0.012) << thing.name;
    }
  }
}

}  // namespace
}  // namespace armsreach::sim
