// Things from mesh files and pictures on them, from the file to the picture.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include "devices/open.hpp"
#include "devices/sim/contacts.hpp"
#include "devices/sim/mesh_file.hpp"
#include "devices/sim/shape_distance.hpp"
#include "devices/sim/sim_source.hpp"
#include "devices/sim/worlds.hpp"
#include "devices/truth.hpp"
#include "tests/unit/devices/sim/ray_cast.hpp"

namespace armsreach::sim {
namespace {

using testing::HasSubstr;

// A roof of 20 x 10 x 10 cm in centimetres; its left slope shows a picture's left half.
constexpr const char* kRoof = R"(v -10 -5 0
v 10 -5 0
v 10 5 0
v -10 5 0
v 0 -5 10
v 0 5 10
vt 0 0
vt 0.5 0
vt 0.5 1
vt 0 1
vt 1 0
vt 1 1
f 1/1 5/2 6/3 4/4
f 5/2 2/5 3/6 6/3
f 1/1 2/1 5/1
f 3/1 4/1 6/1
f 1/1 4/1 3/1 2/1
)";

constexpr const char* kWorld = R"(
about: a roof on the floor
sensor: {width: 160, height: 120, field_of_view_deg: 40, rate: 30, depth_range: [0, 5], noise: 0}
light: {towards: [0, 0, 1], spread_deg: 5, key: "#ffffff", key_strength: 0.2,
        above: "#ffffff", below: "#ffffff", ambient_strength: 0.8}
path: {duration: 1, closed: false, sway: 0, sway_deg: 0, shake: 0, shake_deg: 0,
       keys: [{time: 0, eye: [0.1, -0.15, 0.6], target: [0, 0, 0]}]}
materials:
  floor: {pattern: plain, colors: ["#808080"], size: 1}
  print: {texture: print.png, fit: true}
things:
  - {name: floor, panel: [5, 5], at: [0, 0, 0], material: floor}
  - {name: roof, mesh: roof.obj, scale: 0.01, at: [0.01, 0.02, 0.05], turn_deg: [10, -8, 25],
     material: print}
)";

class MeshWorld : public testing::Test {
 protected:
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::path(testing::TempDir()) / ("mesh_" + std::string(test->name()));
    std::filesystem::create_directories(folder_);
    write("roof.obj", kRoof);
    write("world.yaml", kWorld);
    cv::Mat print(40, 60, CV_8UC3, cv::Scalar(0, 0, 255));
    print.colRange(30, 60).setTo(cv::Scalar(255, 0, 0));
    cv::imwrite((folder_ / "print.png").string(), print);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
  }
  std::string file(const std::string& name) const { return (folder_ / name).string(); }
  std::string complaint() const {
    const auto world = load_world(file("world.yaml"));
    return world ? "" : world.error().message();
  }

  std::filesystem::path folder_;
};

TEST_F(MeshWorld, HasTheFilesTriangles) {
  const auto mesh = load_mesh(file("roof.obj"), 0.01);
  ASSERT_TRUE(mesh.ok()) << mesh.error().message();
  EXPECT_EQ(mesh->triangles->size(), 8U) << "three rectangles and two gables";
  double volume = 0;
  for (const MeshTriangle& triangle : *mesh->triangles) {
    const auto& [a, b, c] = triangle.positions;
    volume += a.dot(b.cross(c)) / 6;
    const Eigen::Vector3d across = (b - a).cross(c - a).normalized();
    for (const Eigen::Vector3d& normal : triangle.normals)
      EXPECT_GT(normal.dot(across), 0.999) << "the roof's edges are sharp";
  }
  EXPECT_NEAR(volume, 0.5 * 0.2 * 0.1 * 0.1, 1e-9);
}

TEST_F(MeshWorld, DepthAndMasksAreWhatRaysMeet) {
  const World world = *load_world(file("world.yaml"));
  const auto source =
      open_source(*parse_source_spec("sim:" + file("world.yaml") + ",frames=1,color=clean"), {},
                  sim_source_kinds());
  ASSERT_TRUE(source.ok()) << source.error().message();
  const auto read = (*source)->next();
  ASSERT_TRUE(read.ok()) << read.error().message();
  const Frame& frame = **read;
  std::vector<Pose> things;
  for (const TrueThing& thing : frame.truth->things) things.push_back(thing.world_from_thing);
  const Pose& pose = *frame.world_from_camera;
  const auto cast = [&](double x, double y) {
    return cast_ray(world, things, pose.translation(),
                    pose.rotation() * unproject(frame.sensor->camera(), {x, y}));
  };
  int on_roof = 0;
  for (int y = 0; y < frame.depth.rows; ++y) {
    for (int x = 0; x < frame.depth.cols; ++x) {
      const auto hit = cast(x, y);
      ASSERT_TRUE(hit.has_value());
      bool edge = false;
      for (const double step : {-0.6, 0.6}) {
        for (const auto& other : {cast(x + step, y + step), cast(x + step, y - step)})
          edge = edge || !other || other->thing != hit->thing;
      }
      if (edge) continue;
      on_roof += hit->thing;
      EXPECT_EQ(frame.truth->masks.at<std::uint16_t>(y, x), hit->thing + 1) << x << " " << y;
      // Single precision of the depth buffer, as for all shapes (truth_test.cpp).
      EXPECT_NEAR(static_cast<double>(frame.truth->depth.at<float>(y, x)), hit->distance, 2e-4);
      if (hit->thing != 1) continue;
      // Which slope it is says which half of the picture is on it.
      const Eigen::Vector3d ray =
          pose.rotation() * unproject(frame.sensor->camera(), {1.0 * x, 1.0 * y});
      const Eigen::Vector3d at = things[1].inverse() * (pose.translation() + hit->distance * ray);
      if (at.z() < 0.01 || std::abs(at.x()) < 0.01 || std::abs(at.y()) > 0.045) continue;
      const cv::Vec3b color = frame.color.at<cv::Vec3b>(y, x);
      EXPECT_EQ(color[2] > color[0], at.x() < 0) << "red on the left, blue on the right";
    }
  }
  EXPECT_GT(on_roof, 1000);
}

// A box that stands in a roof's hollow is not in it, but in the solid close around it.
TEST_F(MeshWorld, IsTouchedAsTheSolidCloseAroundIt) {
  const auto mesh = load_mesh(file("roof.obj"), 0.01);
  ASSERT_TRUE(mesh.ok());
  const Shape shape = *mesh;
  EXPECT_NEAR(signed_distance(shape, {0, 0, -0.01}), 0.01, 1e-9);
  EXPECT_NEAR(signed_distance(shape, {0.05, 0, 0.05}), 0, 1e-9) << "its slopes are among the sides";
  EXPECT_LT(signed_distance(shape, {0, 0, 0.05}), -0.02);

  World world;
  world.materials.emplace_back();
  world.things.resize(2);
  world.things[1].moves = true;
  world.parts.push_back({0, shape, {}, 0});
  world.parts.push_back({1, Box{{0.02, 0.02, 0.02}}, {}, 0});
  ContactFinder contacts(world);
  const auto at_height = [](double z) {
    return std::vector<Pose>{Pose(), Pose(Eigen::Quaterniond::Identity(), {0, 0, z})};
  };
  EXPECT_TRUE(contacts.at(at_height(0.11)).empty()) << "1 cm above the ridge";
  EXPECT_EQ(contacts.at(at_height(0.1005)).size(), 1U);
}

TEST_F(MeshWorld, ErrorsNameTheFileAndWhatToDo) {
  EXPECT_EQ(complaint(), "");
  write("roof.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n");
  EXPECT_THAT(complaint(), HasSubstr("roof.obj"));
  write("roof.obj", "what is this");
  EXPECT_THAT(complaint(), HasSubstr("roof.obj"));
  std::string many;
  for (int i = 0; i <= kMostMeshTriangles; ++i) {
    many += "v 0 0 " + std::to_string(i) + "\nv 10 0 " + std::to_string(i) + "\nv 0 10 " +
            std::to_string(i) + "\nf -3 -2 -1\n";
  }
  write("roof.obj", many);
  EXPECT_THAT(complaint(), HasSubstr("decimate it to 5000"));
  std::filesystem::remove(folder_ / "roof.obj");
  EXPECT_THAT(complaint(), HasSubstr("no such mesh file"));
  std::filesystem::remove(folder_ / "print.png");
  EXPECT_THAT(complaint(), HasSubstr("print.png"));
  EXPECT_THAT(complaint(), HasSubstr("PNG or JPEG"));
  EXPECT_THAT(load_mesh(file("world.yaml"), 1).error().message(), HasSubstr(".obj or a .ply"));
}

}  // namespace
}  // namespace armsreach::sim
