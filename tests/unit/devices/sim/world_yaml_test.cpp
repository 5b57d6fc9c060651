#include "devices/sim/world_yaml.hpp"

#include <numbers>
#include <sstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "devices/sim/worlds.hpp"

namespace armsreach::sim {
namespace {

using testing::HasSubstr;

const std::string kWorld = R"(about: a cube on the floor
sensor: {width: 64, height: 48, field_of_view_deg: 60, rate: 30, depth_range: [0.5, 4], noise: 1,
         color: {noise: 2, exposure_ms: 20, jpeg: 50}}
light: {towards: [0, 0, 2], spread_deg: 10, key: "#ffffff", key_strength: 1, above: "#808080",
        below: "#404040", ambient_strength: 0.5}
path: {duration: 2, keys: [{time: 0, eye: [0, -1, 1], target: [0, 0, 0]},
                           {time: 2, eye: [1, -1, 1], target: [0, 0, 0], roll_deg: 90}]}
materials: {grey: {pattern: plain, colors: ["#336699"], size: 0.5, shine: 0.25}}
things: [{name: cube, box: [0.1, 0.2, 0.3], at: [1, 2, 3], turn_deg: [0, 0, 90], material: grey}]
)";

Result<World> read(const std::string& text) {
  std::istringstream in(text);
  return read_world_yaml(in, "test.yaml");
}

std::string replaced(const std::string& from, const std::string& to) {
  std::string text = kWorld;
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(WorldYaml, ReadsWhatAColourCameraDoes) {
  const ColorDescription usual;
  const ColorDescription color = read(kWorld)->sensor.color;
  EXPECT_EQ(color.noise, 2);
  EXPECT_DOUBLE_EQ(color.exposure, 0.02);
  EXPECT_EQ(color.jpeg_quality, 50);
  EXPECT_EQ(color.white_balance_drift, usual.white_balance_drift);
  const std::string given = "color: {noise: 2, exposure_ms: 20, jpeg: 50}";
  const ColorDescription clean = read(replaced(given, "color: clean"))->sensor.color;
  EXPECT_EQ(clean.noise, 0);
  EXPECT_EQ(clean.exposure, 0);
  EXPECT_EQ(clean.jpeg_quality, 0);
  EXPECT_THAT(read(replaced("jpeg: 50", "jpg: 50")).error().what, HasSubstr("sensor.color.jpg"));
}

TEST(WorldYaml, ReadsWhatIsThere) {
  const auto world = read(kWorld);
  ASSERT_TRUE(world.ok()) << world.error().message();
  EXPECT_EQ(world->about, "a cube on the floor");
  EXPECT_EQ(world->sensor.width, 64);
  EXPECT_DOUBLE_EQ(world->sensor.field_of_view, std::numbers::pi / 3);
  EXPECT_DOUBLE_EQ(world->light.towards.z(), 1);
  EXPECT_DOUBLE_EQ(world->path.keys[1].roll, std::numbers::pi / 2);
  EXPECT_FALSE(world->path.closed);
  ASSERT_EQ(world->things.size(), 1U);
  EXPECT_LT((world->materials[0].colors[0] - Color(0.2, 0.4, 0.6)).norm(), 1e-9);
  EXPECT_EQ(world->materials[0].shine, 0.25);
  const Thing& cube = world->things[0];
  EXPECT_EQ(std::get<Box>(world->parts[0].shape).size, Eigen::Vector3d(0.1, 0.2, 0.3));
  // Turned by 90 degrees about z, x becomes y.
  const Eigen::Vector3d tip = cube.world_from_thing * Eigen::Vector3d(1, 0, 0);
  EXPECT_LT((tip - Eigen::Vector3d(1, 3, 3)).norm(), 1e-12);
}

TEST(WorldYaml, WorldsThatComeWithTheProgramAreSound) {
  for (const std::string& name : world_names()) {
    const auto world = load_world(name);
    EXPECT_TRUE(world.ok()) << world.error().message();
  }
  const auto unknown = load_world("moon");
  ASSERT_FALSE(unknown.ok());
  EXPECT_THAT(unknown.error().remedy, HasSubstr("bench"));
}

struct Refusal {
  std::string from;
  std::string to;
  std::string says;  // part of the complaint
};

TEST(WorldYaml, RefusesByName) {
  const Refusal refusals[] = {
      {"width: 64", "width: 64, hieght: 3", "unknown key 'sensor.hieght'"},
      {"about:", "abuot: x\nabout:", "unknown key 'abuot'"},
      {"roll_deg: 90", "rol: 90", "unknown key 'path.keys[1].rol'"},
      {"shine: 0.25", "gloss: 1", "unknown key 'materials.grey.gloss'"},
      {"name: cube", "name: cube, colour: red", "unknown key 'things[0].colour'"},
      {"width: 64, ", "", "'sensor.width' is missing"},
      {"width: 64", "width: wide", "'sensor.width' is not a finite number"},
      {"rate: 30", "rate: .nan", "'sensor.rate' is not a finite number"},
      {"rate: 30", "rate: 0", "'sensor.rate' is not from"},
      {"depth_range: [0.5, 4]", "depth_range: [4, 0.5]", "depth_range"},
      {"towards: [0, 0, 2]", "towards: [0, 0, 0]", "'light.towards' is no direction"},
      {"\"#336699\"", "\"#3366\"", "'materials.grey.colors' is not a colour"},
      {"[\"#336699\"]", "[]", "fewer than the 1"},
      {"pattern: plain", "pattern: paisley", "there is no pattern 'paisley'"},
      {"time: 2,", "time: 0,", "do not increase"},
      {"duration: 2,", "duration: 2, closed: true,", "come back to the first"},
      {"box: [0.1, 0.2, 0.3]", "box: [0.1, 0.2]", "has not 3 numbers"},
      {"box: [0.1, 0.2, 0.3]", "box: [0.1, 0, 0.3]", "a size of zero or less"},
      {"box: [0.1, 0.2, 0.3]", "cone: [1, 2]", "needs one shape"},
      {"box: [0.1, 0.2, 0.3]", "box: [1, 1, 1], panel: [1, 1]", "needs one shape"},
      {"box: [0.1, 0.2, 0.3]", "mug: [0.04, 0.1, 0.03]", "all wall"},
      {"box: [0.1, 0.2, 0.3]", "lathe: [[0, 0]]", "fewer than two points"},
      {"material: grey", "material: gold", "there is no material 'gold'"},
      {"sensor: {", "sensor: {{", "not readable as YAML"},
  };
  for (const Refusal& refusal : refusals) {
    const auto world = read(replaced(refusal.from, refusal.to));
    ASSERT_FALSE(world.ok()) << refusal.to;
    EXPECT_THAT(world.error().what, HasSubstr(refusal.says));
    EXPECT_THAT(world.error().where, ::testing::StartsWith("test.yaml"));
    EXPECT_FALSE(world.error().remedy.empty());
  }
  EXPECT_FALSE(read("").ok());
  EXPECT_FALSE(read("[1, 2]").ok());
  EXPECT_FALSE(read("just text").ok());
}

}  // namespace
}  // namespace armsreach::sim
