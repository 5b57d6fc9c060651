#include <filesystem>
#include <numbers>
#include <variant>

#include <gtest/gtest.h>

#include "tests/unit/devices/broken_rig.hpp"

namespace armsreach {
namespace {

constexpr const char* kRig =
    "sensors:\n"
    "  - {name: main, source: 'camera:0'}\n"
    "  - {name: side, source: 'camera:2'}\n"
    "actuators:\n"
    "  gaze:\n"
    "    kind: firmata\n"
    "    port: /dev/ttyUSB3\n"
    "    pins: [2, 3, 4]\n"
    "    us_per_degree: [10, -10, 9.5]\n"
    "    model: {upper_deg: [70, 40, 30], lag: 0.05}\n"
    "  other: {kind: uvc, carries: side, device: /dev/video2}\n";

TEST(RigActuators, AreReadWithTheirModels) {
  const auto rig = test::read_rig(kRig);
  ASSERT_TRUE(rig) << rig.error().message();
  ASSERT_EQ(rig->gimbals.size(), 2U);
  const RigGimbalSpec& gaze = rig->gimbals[0];
  EXPECT_EQ(gaze.name, "gaze");
  EXPECT_EQ(gaze.carries, "main");
  EXPECT_NEAR(gaze.model.upper[0], 70 * std::numbers::pi / 180, 1e-12);
  EXPECT_EQ(gaze.model.lag, 0.05);
  const auto& servos = std::get<FirmataServos>(gaze.driver);
  EXPECT_EQ(servos.port, "/dev/ttyUSB3");
  EXPECT_EQ(servos.baud, 57600);
  EXPECT_EQ(servos.pins, (std::array{2, 3, 4}));
  EXPECT_EQ(servos.us_per_degree[2], 9.5);
  EXPECT_EQ(servos.zero_us[0], 1500);
  EXPECT_EQ(std::get<UvcMotors>(rig->gimbals[1].driver).device, "/dev/video2");
}

TEST(RigActuators, WhatIsWrongIsNamedWithItsLine) {
  const std::vector<test::BrokenRig> all = {
      {"kind: firmata", "kind: steppers", "rig.yaml:6", "no known kind"},
      {"    kind: firmata\n", "", "rig.yaml:6", "no known kind"},
      {"port:", "prt:", "rig.yaml:7", "'prt'"},
      {"[2, 3, 4]", "[2, 3]", "rig.yaml:8", "'pins'"},
      {"[2, 3, 4]", "[2, 3, x]", "rig.yaml:8", "'pins'"},
      {"9.5]", ".nan]", "rig.yaml:6", "'us_per_degree'"},
      {"lag: 0.05", "lag: 5", "rig.yaml:10", "'lag'"},
      {"carries: side", "carries: back", "rig.yaml:11", "no sensor"},
      {"carries: side", "carries: main", "rig.yaml:11", "two gimbals"},
      {"{kind: uvc, carries: side, device: /dev/video2}", "none", "rig.yaml:11", "not a map"},
  };
  test::expect_complaints(kRig, all);
}

TEST(RigActuators, TheExamplesAreReadable) {
  int examples = 0;
  const auto folder = std::filesystem::path(ARMSREACH_SOURCE_DIR) / "assets" / "rigs";
  for (const auto& file : std::filesystem::directory_iterator(folder)) {
    const auto rig = read_rig_file(file.path());
    ASSERT_TRUE(rig) << rig.error().message();
    EXPECT_EQ(rig->gimbals.size(), 1U);
    ++examples;
  }
  EXPECT_GE(examples, 2);
}

}  // namespace
}  // namespace armsreach
