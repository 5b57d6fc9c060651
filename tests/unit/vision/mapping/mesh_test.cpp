#include "vision/mapping/mesh.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <map>
#include <numbers>
#include <set>
#include <sstream>
#include <string>
#include <utility>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "tests/unit/vision/mapping/shapes.hpp"
#include "vision/mapping/ply.hpp"
#include "vision/mapping/voxel_map.hpp"

namespace armsreach::mapping {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;
using SignedDistance = std::function<double(const Vector3d&)>;  // m, positive outside

// A map that knows the distance everywhere within `extent` of the origin.
VoxelMap map_of_distance(const SignedDistance& distance, double extent) {
  VoxelMap map{VoxelMapOptions()};
  const double voxel = map.options().resolution;
  const int blocks = static_cast<int>(std::ceil(extent / (kBlockEdge * voxel)));
  for (int z = -blocks; z < blocks; ++z) {
    for (int y = -blocks; y < blocks; ++y) {
      for (int x = -blocks; x < blocks; ++x) {
        Block block;
        for (int at = 0; at < kBlockVoxels; ++at) {
          const VoxelInBlock v = voxel_at(at);
          const Vector3d centre = Vector3d(kBlockEdge * x + v.x + 0.5, kBlockEdge * y + v.y + 0.5,
                                           kBlockEdge * z + v.z + 0.5) *
                                  voxel;
          const double edges = std::clamp(distance(centre) / voxel, -15.0, 15.0);
          block.distance(at) =
              static_cast<std::int16_t>(std::lround(edges / static_cast<double>(kDistanceUnit)));
          block.weight(at) = 64;
          block.log_odds(at) = static_cast<std::int16_t>(edges < 1 ? 2000 : -400);
          block.intensity(at) = 32768;
        }
        map.put({x, y, z}, block);
      }
    }
  }
  return map;
}

SignedDistance sphere(const Vector3d& centre, double radius) {
  return [=](const Vector3d& p) { return (p - centre).norm() - radius; };
}

SignedDistance cube(const Vector3d& centre, double half) {
  return [=](const Vector3d& p) {
    const Vector3d q = (p - centre).cwiseAbs() - Vector3d::Constant(half);
    return q.cwiseMax(0).norm() + std::min(q.maxCoeff(), 0.0);
  };
}

// Around the z axis.
SignedDistance torus(double ring, double tube) {
  return
      [=](const Vector3d& p) { return std::hypot(std::hypot(p.x(), p.y()) - ring, p.z()) - tube; };
}

Vector3d corner(const SurfaceMesh& mesh, const Triangle& triangle, int i) {
  return mesh.vertices[triangle[static_cast<std::size_t>(i)]].point_in_world.cast<double>();
}

// Twice the triangle's area, along its normal.
Vector3d facing(const SurfaceMesh& mesh, const Triangle& t) {
  const Vector3d a = corner(mesh, t, 0);
  return (corner(mesh, t, 1) - a).cross(corner(mesh, t, 2) - a);
}

double volume(const SurfaceMesh& mesh) {
  double sum = 0;
  for (const Triangle& t : mesh.triangles) sum += corner(mesh, t, 0).dot(facing(mesh, t)) / 6;
  return sum;
}

// Vertices - edges + faces.
long euler_characteristic(const SurfaceMesh& mesh) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  std::set<std::uint32_t> vertices;
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      edges.insert(std::minmax(t[i], t[(i + 1) % 3]));
      vertices.insert(t[i]);
    }
  }
  return static_cast<long>(vertices.size()) - static_cast<long>(edges.size()) +
         static_cast<long>(mesh.triangles.size());
}

// Every edge is passed once in each direction: no border, and one side is outside everywhere.
bool closed_and_oriented(const SurfaceMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> passes;
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) ++passes[{t[i], t[(i + 1) % 3]}];
  }
  return std::all_of(passes.begin(), passes.end(), [&](const auto& edge) {
    const auto back = passes.find({edge.first.second, edge.first.first});
    return edge.second == 1 && back != passes.end() && back->second == 1;
  });
}

TEST(Mesh, OfASphereIsASphere) {
  constexpr double kRadius = 0.2;
  const Vector3d centre(0.013, -0.021, 0.007);  // no symmetry with the voxels
  const SurfaceMesh mesh = surface_mesh(map_of_distance(sphere(centre, kRadius), 0.32).grid());
  EXPECT_EQ(euler_characteristic(mesh), 2);
  EXPECT_TRUE(closed_and_oriented(mesh));
  for (const Triangle& t : mesh.triangles) {
    const Vector3d middle = (corner(mesh, t, 0) + corner(mesh, t, 1) + corner(mesh, t, 2)) / 3;
    EXPECT_GE(facing(mesh, t).dot(middle - centre), 0);
  }
  for (const SurfacePoint& p : mesh.vertices) {
    const Vector3d out = p.point_in_world.cast<double>() - centre;
    EXPECT_NEAR(out.norm(), kRadius, 2e-4) << "a fiftieth of a voxel";
    EXPECT_GT(p.normal_in_world.cast<double>().dot(out.normalized()), 0.99);
  }
  // Inscribed, at one voxel on a radius of twenty.
  EXPECT_NEAR(area(mesh), 4 * std::numbers::pi * kRadius * kRadius, 0.02 * area(mesh));
  EXPECT_NEAR(volume(mesh), 4.0 / 3 * std::numbers::pi * std::pow(kRadius, 3), 0.02 * volume(mesh));
}

TEST(Mesh, OfACubeAndATorus) {
  const SurfaceMesh box = surface_mesh(map_of_distance(cube({0.004, 0, -0.003}, 0.2), 0.32).grid());
  EXPECT_EQ(euler_characteristic(box), 2);
  EXPECT_TRUE(closed_and_oriented(box));
  // Its twelve edges are cut off, by half a voxel each.
  EXPECT_NEAR(area(box), 6 * 0.4 * 0.4, 12 * 0.4 * 0.005);
  EXPECT_NEAR(volume(box), 0.4 * 0.4 * 0.4, 0.02 * volume(box));

  const SurfaceMesh ring = surface_mesh(map_of_distance(torus(0.18, 0.07), 0.32).grid());
  EXPECT_EQ(euler_characteristic(ring), 0);
  EXPECT_TRUE(closed_and_oriented(ring));
  EXPECT_NEAR(area(ring), 4 * std::numbers::pi * std::numbers::pi * 0.18 * 0.07, 0.02 * area(ring));
}

TEST(Mesh, OfASphereSeenFromAllSides) {
  // Forty views, spread evenly (Fibonacci's lattice).
  std::vector<Pose> poses;
  for (int i = 0; i < 40; ++i) {
    const double height = 1 - (i + 0.5) / 20;
    const double turn = 2.4 * i;
    const double width = std::sqrt(1 - height * height);
    poses.push_back(
        test::looking_at({width * std::cos(turn), width * std::sin(turn), height}, {0, 0, 0}));
  }
  constexpr double kRadius = 0.25;
  const SurfaceMesh mesh =
      surface_mesh(test::map_of(test::sphere({0.002, 0, 0.003}, kRadius), poses).grid());
  EXPECT_EQ(euler_characteristic(mesh), 2);
  EXPECT_TRUE(closed_and_oriented(mesh));
  EXPECT_NEAR(area(mesh), 4 * std::numbers::pi * kRadius * kRadius, 0.02 * area(mesh));
}

TEST(Mesh, EndsWhereTheMapEnds) {
  const SurfaceMesh mesh =
      surface_mesh(test::map_of(test::plane(Vector3d::UnitZ(), 1), {Pose()}).grid());
  EXPECT_EQ(euler_characteristic(mesh), 1) << "a disc";
  // 80x60 pixels at a metre, less a cell and a half along the border.
  const Camera camera = test::small_camera();
  const double width = 80 / camera.fx;
  const double height = 60 / camera.fy;
  EXPECT_LE(area(mesh), width * height);
  EXPECT_GE(area(mesh), width * height - 2 * (width + height) * 0.015);
  for (const Triangle& t : mesh.triangles) EXPECT_LE(facing(mesh, t).z(), 0) << "to the camera";
}

TEST(Mesh, OfAnEmptyMapIsEmpty) {
  const SurfaceMesh mesh = surface_mesh(VoxelMap{VoxelMapOptions()}.grid());
  EXPECT_TRUE(mesh.vertices.empty());
  EXPECT_TRUE(mesh.triangles.empty());
  EXPECT_EQ(area(mesh), 0);
}

// Reads what write_ply promises and nothing else.
class PlyReader {
 public:
  explicit PlyReader(const std::string& bytes) : in_(bytes) {
    for (std::string line; std::getline(in_, line) && line != "end_header";) {
      std::istringstream words(line);
      std::string word;
      std::string what;
      std::size_t count = 0;
      words >> word >> what >> count;
      if (word == "element" && what == "vertex") vertices_ = count;
      if (word == "element" && what == "face") faces_ = count;
    }
  }

  SurfaceMesh read() {
    SurfaceMesh mesh;
    for (std::size_t i = 0; i < vertices_; ++i) {
      SurfacePoint point;
      for (float& value : point.point_in_world) value = take<float>();
      for (float& value : point.normal_in_world) value = take<float>();
      const int red = take<std::uint8_t>();
      EXPECT_EQ(take<std::uint8_t>(), red);
      EXPECT_EQ(take<std::uint8_t>(), red);
      point.intensity = static_cast<float>(red) / 255;
      mesh.vertices.push_back(point);
    }
    for (std::size_t i = 0; i < faces_; ++i) {
      EXPECT_EQ(take<std::uint8_t>(), 3);
      Triangle triangle;
      for (std::uint32_t& vertex : triangle) {
        vertex = static_cast<std::uint32_t>(take<std::int32_t>());
      }
      mesh.triangles.push_back(triangle);
    }
    EXPECT_EQ(in_.peek(), std::char_traits<char>::eof()) << "bytes are left";
    return mesh;
  }

 private:
  template <class T>
  T take() {
    T value{};
    char bytes[sizeof(T)];
    EXPECT_TRUE(in_.read(bytes, sizeof(T)));
    std::memcpy(&value, bytes, sizeof(T));
    return value;
  }

  std::istringstream in_;
  std::size_t vertices_ = 0;
  std::size_t faces_ = 0;
};

TEST(Ply, ReadsBackAsTheMeshAndTheCloudItWasWrittenFrom) {
  const VoxelMap map = map_of_distance(sphere({0, 0, 0}, 0.1), 0.16);
  const SurfaceMesh mesh = surface_mesh(map.grid());
  const SurfaceMesh cloud = surface_cloud(map.grid());
  EXPECT_TRUE(cloud.triangles.empty());
  for (const SurfaceMesh& written : {mesh, cloud}) {
    std::ostringstream out;
    write_ply(out, written);
    const SurfaceMesh back = PlyReader(out.str()).read();
    EXPECT_EQ(back.triangles, written.triangles);
    ASSERT_EQ(back.vertices.size(), mesh.vertices.size());
    for (std::size_t i = 0; i < back.vertices.size(); ++i) {
      EXPECT_EQ(back.vertices[i].point_in_world, mesh.vertices[i].point_in_world);
      EXPECT_EQ(back.vertices[i].normal_in_world, mesh.vertices[i].normal_in_world);
      EXPECT_NEAR(back.vertices[i].intensity, mesh.vertices[i].intensity, 0.51 / 255);
    }
  }
}

}  // namespace
}  // namespace armsreach::mapping
