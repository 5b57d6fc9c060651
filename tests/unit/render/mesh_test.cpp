// Generated meshes: closed where they should be, standing on z = 0, normals outwards.
#include "render/mesh.hpp"

#include <cmath>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace armsreach::render {
namespace {

using Eigen::Vector3f;

// Six times the signed volume: positive when a closed mesh's triangles face outwards.
double signed_volume(const Mesh& mesh, std::size_t first, std::size_t last) {
  double volume = 0;
  for (std::size_t i = first; i + 2 < last; i += 3) {
    const Vector3f& a = mesh.vertices[mesh.indices[i]].position;
    const Vector3f& b = mesh.vertices[mesh.indices[i + 1]].position;
    const Vector3f& c = mesh.vertices[mesh.indices[i + 2]].position;
    volume += static_cast<double>(a.dot(b.cross(c)));
  }
  return volume / 6;
}

class NamedMesh : public testing::TestWithParam<std::string> {};

TEST_P(NamedMesh, StandsOnZeroWithUnitNormalsThatAgreeWithItsTriangles) {
  const Mesh mesh = named_mesh(GetParam());
  ASSERT_GT(mesh.triangle_count(), 0U);
  EXPECT_LE(mesh.triangle_count(), 5000U);  // vertices are what a software rasteriser pays for
  float lowest = 1e9F;
  for (const Vertex& vertex : mesh.vertices) {
    lowest = std::min(lowest, vertex.position.z());
    ASSERT_NEAR(vertex.normal.norm(), 1, 1e-5);
  }
  EXPECT_NEAR(lowest, 0, 0.004);  // the axes' shafts lie on the plane within their own radius
  std::size_t against = 0;
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const Vertex& a = mesh.vertices[mesh.indices[i]];
    const Vertex& b = mesh.vertices[mesh.indices[i + 1]];
    const Vertex& c = mesh.vertices[mesh.indices[i + 2]];
    const Vector3f face = (b.position - a.position).cross(c.position - a.position);
    against += face.dot(a.normal + b.normal + c.normal) <= 0;
  }
  // Where the teapot's knob curls in, a few coarse triangles are bent by more than a right angle.
  EXPECT_LE(against, mesh.triangle_count() / 200);
  EXPECT_GT(signed_volume(mesh, 0, mesh.indices.size()), 0);
}

INSTANTIATE_TEST_SUITE_P(All, NamedMesh, testing::ValuesIn(mesh_names()),
                         [](const auto& chosen) { return chosen.param; });

TEST(Teapot, PolesHaveVerticalNormals) {
  const Mesh teapot = make_teapot(0.15F);
  int top = 0;
  int bottom = 0;
  for (const Vertex& vertex : teapot.vertices) {
    if (vertex.position.head<2>().norm() > 1e-4F) continue;
    if (vertex.position.z() > 0.149F) {
      ++top;
      EXPECT_GT(vertex.normal.z(), 0.98F);
    } else if (vertex.position.z() < 1e-3F) {
      ++bottom;
      EXPECT_LT(vertex.normal.z(), -0.98F);
    }
  }
  EXPECT_GT(top, 0);
  EXPECT_GT(bottom, 0);
}

TEST(Teapot, BodyNormalsPointAwayFromItsAxis) {
  const Mesh teapot = make_teapot(0.15F);
  // The belly: between a sixth and a half of the height, within the radius of the body but for
  // spout and handle, which leave it along x.
  int seen = 0;
  for (const Vertex& vertex : teapot.vertices) {
    const Vector3f& p = vertex.position;
    if (p.z() < 0.025F || p.z() > 0.075F || std::abs(p.x()) > 0.05F) continue;
    ++seen;
    EXPECT_GT(Vector3f(p.x(), p.y(), 0).dot(vertex.normal), 0);
  }
  EXPECT_GT(seen, 50);
}

TEST(Box, HasItsVolume) {
  const Mesh box = make_box({1, 2, 3}, {0.2F, 0.3F, 0.4F});
  EXPECT_NEAR(signed_volume(box, 0, box.indices.size()), 0.024, 1e-5);  // float sums of some 10
}

TEST(Lathe, CylinderHasNearlyItsVolume) {
  const Mesh cylinder = make_lathe({{0, 0}, {0.05F, 0}, {0.05F, 0.1F}, {0, 0.1F}}, 64);
  const double polygon = 32 * std::sin(2 * M_PI / 64);  // area of the inscribed 64-gon of radius 1
  EXPECT_NEAR(signed_volume(cylinder, 0, cylinder.indices.size()), polygon * 0.0025 * 0.1, 1e-8);
}

}  // namespace
}  // namespace armsreach::render
