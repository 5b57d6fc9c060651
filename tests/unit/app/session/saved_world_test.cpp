// Worlds that are saved and entered again, and what is said of those that cannot be.
#include "app/session/saved_world.hpp"

#include <gtest/gtest.h>

#include "tests/support/program.hpp"
#include "tests/support/synthetic_room.hpp"

namespace armsreach::app {
namespace {

class SavedWorldTest : public ::testing::Test {
 protected:
  static mapping::VoxelMap small_map() {
    mapping::VoxelMapOptions options;
    options.resolution = 0.02;
    mapping::VoxelMap map(options);
    const auto sensor = test::synthetic_sensor(80);
    const FramePtr frame = test::SyntheticRoom().frame(sensor, Pose());
    map.insert(frame->depth, cv::Mat(), cv::Mat(), *sensor->depth_camera, Pose());
    return map;
  }

  Status save() const {
    return save_session(session(), small_map().grid(), {},
                        {{3, "teapot", Pose(so3_exp({0.1, 0.2, 0.3}), {1, 2, 3})}});
  }
  std::string session() const { return (folder_ / "session").string(); }

  test::TemporaryFolder folder_;
};

TEST_F(SavedWorldTest, ASessionComesBackAsItWas) {
  ASSERT_TRUE(save());
  const auto world = load_session(session(), {});
  ASSERT_TRUE(world) << world.error().message();
  ASSERT_TRUE(world->map);
  EXPECT_DOUBLE_EQ(world->map->grid().resolution, 0.02);
  EXPECT_EQ(world->map->grid().blocks.keys(), small_map().grid().blocks.keys());
  ASSERT_EQ(world->objects.size(), 1U);
  EXPECT_EQ(world->objects[0].id, 3);
  EXPECT_EQ(world->objects[0].mesh, "teapot");
  const Pose moved =
      world->objects[0].world_from_object.inverse() * Pose(so3_exp({0.1, 0.2, 0.3}), {1, 2, 3});
  EXPECT_LT(moved.log().norm(), 1e-12);
}

TEST_F(SavedWorldTest, ASparseMapComesBackAndDoesNotMixWithADenseOne) {
  mono_slam::SparseMap map;
  map.camera = pinhole(320, 240, 264, 264, 159.5, 119.5);
  mono_slam::Landmark landmark;
  landmark.patch.grey = cv::Mat(33, 33, CV_8UC1, cv::Scalar(120));
  landmark.patch.grey.at<std::uint8_t>(3, 4) = 7;
  landmark.patch.normal_in_world = {0, 0, -1};
  landmark.of_target = true;
  map.landmarks = {landmark};
  map.points_in_world = {{0.1, 0.2, 0.7}};
  map.covariance = 1e-4 * Eigen::Matrix3d::Identity();
  ASSERT_TRUE(save_session(session(), map, {{3, "teapot", Pose()}}));
  const auto world = load_session(session(), {});
  ASSERT_TRUE(world) << world.error().message();
  EXPECT_FALSE(world->map);
  ASSERT_TRUE(world->sparse_map);
  EXPECT_EQ(world->sparse_map->points_in_world[0], map.points_in_world[0]);
  EXPECT_TRUE(world->sparse_map->landmarks[0].of_target);
  EXPECT_EQ(world->objects.size(), 1U);
  ASSERT_TRUE(save());
  EXPECT_FALSE(load_session(session(), {})) << "two maps are two worlds";
}

TEST_F(SavedWorldTest, NothingSavedYetIsAnEmptyWorld) {
  const auto session = load_session((folder_ / "none").string(), {});
  ASSERT_TRUE(session);
  EXPECT_FALSE(session->map);
  const auto map = load_map((folder_ / "none.ot").string(), {});
  ASSERT_TRUE(map);
  EXPECT_FALSE(map->map);
}

TEST_F(SavedWorldTest, WhatCannotBeReadIsNamed) {
  ASSERT_TRUE(save());
  const std::string file = (folder_ / "file").string();
  test::write_text(file, "x");
  EXPECT_EQ(load_session(file, {}).error().where, file);
  EXPECT_EQ(load_map(folder_.path().string(), {}).error().where, folder_.path().string());

  const auto refused = [&](const char* name, const std::string& text) {
    const std::string path = session() + "/" + name;
    const std::string before = test::read_text(path);
    test::write_text(path, text);
    const auto world = load_session(session(), {});
    test::write_text(path, before);
    ASSERT_FALSE(world) << name;
    EXPECT_EQ(world.error().where, path);
    EXPECT_FALSE(world.error().remedy.empty());
  };
  refused("objects.json", "[{]");
  refused("objects.json", "[{\"id\": 1}]");
  refused("objects.json",
          R"([{"id": 1, "object": "cube",
               "world_from_object": {"translation": [0, 0, 0], "rotation": [0, 0, 0, 0]}}])");
  refused("key_frames.bin", "ARKEYS01");
  refused("map.ot", "nothing");
}

TEST_F(SavedWorldTest, AMapThatCannotBeWrittenLeavesTheOldOne) {
  ASSERT_TRUE(save());
  const std::string before = test::read_text(session() + "/map.ot");
  std::filesystem::create_directory(session() + "/map.ot.part");  // in the way of the new one
  EXPECT_FALSE(save());
  EXPECT_EQ(test::read_text(session() + "/map.ot"), before);
}

}  // namespace
}  // namespace armsreach::app
