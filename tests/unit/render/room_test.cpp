// How the map is framed: up is found, views look where they say, and framing keeps calm.
#include "render/room.hpp"

#include <numbers>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "tests/screenshot/tiny_world.hpp"

namespace armsreach::render {
namespace {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;

Scene scene_of_tiny_world() {
  Scene scene;
  scene.pose_known = true;
  scene.camera = pinhole(64, 48, 50, 50, 31.5, 23.5);
  scene.world_from_camera = test::world_from_viewer();
  scene.surface = test::tiny_surface(0.01F);
  return scene;
}

TEST(Room, UpIsFoundFromTheTablesNormalsInAnyWorldFrame) {
  Scene scene = scene_of_tiny_world();
  EXPECT_LT((guess_room(scene) * Vector3d::UnitZ() - Vector3d::UnitZ()).norm(), 0.02);

  // The same with the world's axes turned, as when the first camera is the world.
  const Pose new_from_old(Eigen::Quaterniond(0.4, 0.7, -0.3, 0.5), {1, 2, 3});
  auto turned = std::make_shared<Surface>(*scene.surface);
  for (SurfaceBlockPtr& block : turned->blocks) {
    SurfaceBlock copy = *block;
    for (SurfacePoint& point : copy.points) {
      const Vector3d normal =
          new_from_old.rotation() * Vector3d(point.normal[0], point.normal[1], point.normal[2]);
      for (int i = 0; i < 3; ++i)
        point.normal[static_cast<std::size_t>(i)] = static_cast<std::int8_t>(normal[i]);
      point.point_in_world = (new_from_old * point.point_in_world.cast<double>()).cast<float>();
    }
    block = std::make_shared<const SurfaceBlock>(copy);
  }
  scene.surface = turned;
  scene.world_from_camera = new_from_old * scene.world_from_camera;
  const Vector3d up_in_new = new_from_old.rotation() * Vector3d::UnitZ();
  // Normals are stored in steps of 1/127: 2 hundredths is two degrees of slack over that.
  EXPECT_LT((guess_room(scene) * up_in_new - Vector3d::UnitZ()).norm(), 0.04);
}

TEST(Room, StatedUpIsTaken) {
  Scene scene = scene_of_tiny_world();
  scene.up_in_world = Vector3d(0.1, 0, 1);
  EXPECT_LT((guess_room(scene) * scene.up_in_world.normalized() - Vector3d::UnitZ()).norm(), 1e-9);
}

TEST(Room, UpIsNotKnownToACameraThatLooksStraightDown) {
  Scene scene = scene_of_tiny_world();
  const auto up = known_up(scene);
  ASSERT_TRUE(up.has_value());
  EXPECT_LT((*up - Vector3d::UnitZ()).norm(), 0.02);
  scene.world_from_camera =
      Pose(Eigen::Quaterniond(Eigen::AngleAxisd(std::numbers::pi, Vector3d::UnitX())), {0, 0, 1});
  EXPECT_FALSE(known_up(scene).has_value());
  scene.surface = nullptr;
  EXPECT_FALSE(known_up(scene).has_value());
}

TEST(Framing, IgnoresSmallChangesAndFollowsLargeOnesWithinASecond) {
  Framing framing;
  const AlignedBox3d box(Vector3d(-1, -1, 0), Vector3d(1, 1, 1));
  framing.follow(box, 0);
  EXPECT_EQ(framing.box().max(), box.max());
  const AlignedBox3d little(Vector3d(-1.05, -1, 0), Vector3d(1, 1.05, 1));
  framing.follow(little, 0.5);
  EXPECT_EQ(framing.box().max(), box.max());
  const AlignedBox3d large(Vector3d(-1, -1, 0), Vector3d(3, 1, 1));
  framing.follow(large, 0.6);
  EXPECT_LT(framing.box().max().x(), 1.8);  // no jump
  for (int i = 7; i <= 18; ++i) framing.follow(large, 0.1 * i);
  EXPECT_NEAR(framing.box().max().x(), 3, 0.15);  // 1.2 s: 5 % of the way left
}

TEST(Views, ProjectionAndRayAreInverse) {
  Framing framing;
  framing.follow(AlignedBox3d(Vector3d(-1, -1, 0), Vector3d(1, 1, 1)), 0);
  const RoomFromWorld room(Eigen::Quaterniond(0.9, 0.1, 0.3, -0.2).normalized());
  const Vector3d point(0.3, -0.2, 0.4);
  for (const View& view :
       {orbit_view({}, framing, room, 400, 300), side_view(Side::top, framing, room, 200, 150),
        side_view(Side::front, framing, room, 200, 150),
        side_view(Side::side, framing, room, 200, 150)}) {
    const auto pixel = project_to_target(view, point);
    ASSERT_TRUE(pixel.has_value());
    const Ray ray = ray_through(view, *pixel);
    const Vector3d to_point = point - ray.origin_in_world;
    EXPECT_LT(to_point.cross(ray.direction_in_world.normalized()).norm(), 1e-9);
    EXPECT_GT(to_point.dot(ray.direction_in_world), 0);
  }
}

TEST(Views, SidesShowTheRoomsAxes) {
  Framing framing;
  framing.follow(AlignedBox3d(Vector3d(-1, -1, 0), Vector3d(1, 1, 1)), 0);
  const RoomFromWorld room = RoomFromWorld::Identity();
  const auto step = [&](Side side, const Vector3d& along) -> Eigen::Vector2d {
    const View view = side_view(side, framing, room, 200, 200);
    return *project_to_target(view, along) - *project_to_target(view, Vector3d::Zero());
  };
  EXPECT_GT(step(Side::top, Vector3d::UnitX()).x(), 0);
  EXPECT_LT(step(Side::top, Vector3d::UnitY()).y(), 0);  // away is up on the picture
  EXPECT_GT(step(Side::front, Vector3d::UnitX()).x(), 0);
  EXPECT_LT(step(Side::front, Vector3d::UnitZ()).y(), 0);
  EXPECT_GT(step(Side::side, Vector3d::UnitY()).x(), 0);
  EXPECT_LT(step(Side::side, Vector3d::UnitZ()).y(), 0);
}

TEST(Letterbox, IsCentredAndOnWholePixels) {
  View view = view_of(pinhole(640, 480, 500, 500, 319.5, 239.5), Pose());
  letterbox(view, 1000, 480);
  EXPECT_EQ(image_rectangle(view).x, 180);
  EXPECT_EQ(image_rectangle(view).width, 640);
  letterbox(view, 320, 400);
  const Rectangle shown = image_rectangle(view);
  EXPECT_EQ(shown.y, 80);
  EXPECT_EQ(shown.height, 240);
  // Pixel edges map to pixel edges: the first pixel's centre lies in the middle of its half pixel.
  EXPECT_LT((view.target_offset - Eigen::Vector2d(-0.25, 79.75)).norm(), 1e-12);
}

}  // namespace
}  // namespace armsreach::render
