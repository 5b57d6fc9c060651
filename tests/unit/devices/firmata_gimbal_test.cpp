#include "devices/firmata_gimbal.hpp"

#include <chrono>
#include <cmath>
#include <filesystem>
#include <thread>
#include <unistd.h>
#include <variant>

#include <gtest/gtest.h>

#include "tests/support/firmata_peer.hpp"

namespace armsreach {
namespace {

using namespace std::chrono_literals;
using test::FirmataPeer;

constexpr double kDegree = M_PI / 180;

Timestamp time_now() {
  return std::chrono::nanoseconds(std::chrono::steady_clock::now().time_since_epoch()).count();
}

class FirmataGimbal : public testing::Test {
 protected:
  FirmataGimbal() {
    const std::string test = testing::UnitTest::GetInstance()->current_test_info()->name();
    folder_ = std::filesystem::temp_directory_path() /
              ("firmata-" + test + "-" + std::to_string(getpid()));
    std::filesystem::create_directory(folder_);
    servos_.port = (folder_ / "board").string();
    servos_.pins = {3, 5, 6};
    servos_.zero_us = {1500, 1400, 1600};
    servos_.us_per_degree = {10, -9, 8};
    servos_.handshake = 2s;
    model_.lower = {-1, -0.9, -0.7};
    model_.upper = {1, 0.9, 0.7};
  }
  ~FirmataGimbal() override { std::filesystem::remove_all(folder_); }

  std::shared_ptr<Gimbal> open() {
    auto gimbal = open_firmata_gimbal(servos_, "main", model_);
    EXPECT_TRUE(gimbal) << gimbal.error().message();
    return gimbal ? *gimbal : nullptr;
  }

  // The events once there is one that says so.
  static bool says(Gimbal& gimbal, const std::string& text) {
    for (int i = 0; i < 500; ++i) {
      for (const Event& event : gimbal.take_events()) {
        const auto& fault = std::get<FaultEvent>(event.body);
        EXPECT_EQ(fault.component, "gimbal 'main'");
        EXPECT_FALSE(fault.remedy.empty());
        if (fault.message.find(text) != std::string::npos) return true;
      }
      std::this_thread::sleep_for(10ms);
    }
    return false;
  }

  std::filesystem::path folder_;
  FirmataServos servos_;
  GimbalModel model_;
};

// Of pan, in us; 0 before the first.
int pan_pulse(const FirmataPeer::Seen& seen) {
  return seen.pulses.count(3) ? seen.pulses.at(3) : 0;
}

bool at_rest(const FirmataPeer::Seen& seen) {
  return seen.pulses == std::map<int, int>{{3, 1500}, {5, 1400}, {6, 1600}};
}

TEST_F(FirmataGimbal, ConfiguresItsServosAndGoesToRest) {
  FirmataPeer peer(servos_.port);
  const auto gimbal = open();
  ASSERT_TRUE(gimbal);
  EXPECT_EQ(gimbal->name(), "main");
  ASSERT_TRUE(peer.wait_for(at_rest));
  const auto seen = peer.seen();
  EXPECT_EQ(seen.servos, (std::set{3, 5, 6}));
  EXPECT_EQ(seen.configured.at(5), std::pair(544, 2400));
}

TEST_F(FirmataGimbal, CommandsBecomePulsesWithinTheLimits) {
  FirmataPeer peer(servos_.port);
  const auto gimbal = open();
  ASSERT_TRUE(gimbal);
  ASSERT_TRUE(gimbal->command({0, Eigen::Vector3d(20, 10, -30) * kDegree}).ok());
  const std::map<int, int> expected{{3, 1700}, {5, 1310}, {6, 1360}};
  EXPECT_TRUE(peer.wait_for([&](const auto& seen) { return seen.pulses == expected; }));
  ASSERT_TRUE(gimbal->command({0, {5, 0, 0}}).ok());  // beyond the limit of 1 rad = 57.3 degrees
  EXPECT_TRUE(peer.wait_for([&](const auto& seen) { return pan_pulse(seen) == 2073; }));
  EXPECT_FALSE(gimbal->command({0, {NAN, 0, 0}}).ok());
  EXPECT_EQ(gimbal->take_commands().size(), 2U);
}

TEST_F(FirmataGimbal, NewestCommandGoesOutAndNoFasterThanServosTakeThem) {
  FirmataPeer peer(servos_.port);
  const auto gimbal = open();
  ASSERT_TRUE(gimbal);
  for (int i = 0; i <= 200; ++i) {
    ASSERT_TRUE(gimbal->command({0, {0.001 * i, 0, 0}}).ok());
    std::this_thread::sleep_for(1ms);
  }
  const int last = static_cast<int>(std::lround(1500 + 10 * 0.2 / kDegree));
  ASSERT_TRUE(peer.wait_for([&](const auto& seen) { return pan_pulse(seen) == last; }));
  // At least 20 ms apart, so that many fit into the time from the first to the last.
  const auto times = peer.seen().commands;
  const double took = std::chrono::duration<double>(times.back() - times.front()).count();
  EXPECT_GT(times.size(), 3U);
  EXPECT_LE(static_cast<double>(times.size()), took / 0.02 + 3) << "a line's buffer may bunch two";
}

TEST_F(FirmataGimbal, StatesFollowTheModel) {
  FirmataPeer peer(servos_.port);
  const auto gimbal = open();
  ASSERT_TRUE(gimbal);
  EXPECT_FALSE(gimbal->state_at(time_now() + 1'000'000'000)) << "the future is not measured";
  std::this_thread::sleep_for(100ms);
  ASSERT_TRUE(gimbal->command({time_now(), {0.5, 0, 0}}).ok());
  ASSERT_TRUE(peer.wait_for([](const auto& seen) { return pan_pulse(seen) == 1786; }));
  const Timestamp sent = time_now();
  std::this_thread::sleep_for(700ms);
  const auto before = gimbal->state_at(sent - 50'000'000);
  const auto after = gimbal->state_at(sent + 600'000'000);
  ASSERT_TRUE(before && after);
  EXPECT_EQ(before->angles[0], 0);
  EXPECT_NEAR(after->angles[0], 0.5, 1e-6) << "0.5 rad take 0.2 s";
}

TEST_F(FirmataGimbal, RestsWhenTheProgramLetsGo) {
  FirmataPeer peer(servos_.port);
  auto gimbal = open();
  ASSERT_TRUE(gimbal);
  ASSERT_TRUE(gimbal->command({0, {0.5, 0.2, 0.1}}).ok());
  ASSERT_TRUE(peer.wait_for([](const auto& seen) { return pan_pulse(seen) == 1786; }));
  gimbal.reset();
  EXPECT_TRUE(peer.wait_for(at_rest));
}

TEST_F(FirmataGimbal, ASilentBoardIsGivenUpWithARemedy) {
  FirmataPeer peer(servos_.port, {.answers = false});
  servos_.handshake = 300ms;
  const auto begin = std::chrono::steady_clock::now();
  const auto gimbal = open_firmata_gimbal(servos_, "main", model_);
  ASSERT_FALSE(gimbal);
  EXPECT_EQ(gimbal.error().kind, Error::Kind::device);
  EXPECT_NE(gimbal.error().remedy.find("StandardFirmata"), std::string::npos);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, 2s);
}

TEST_F(FirmataGimbal, NoiseOnTheLineIsPassedOver) {
  FirmataPeer peer(servos_.port, {.noise = {0x00, 0x7F, 0xF0, 0x12, 0xE1, 0x05, 0xF7, 0xF9}});
  EXPECT_TRUE(open());
}

TEST_F(FirmataGimbal, OtherVersionsAndMissingPortsAreRefused) {
  const auto none = open_firmata_gimbal(servos_, "main", model_);
  ASSERT_FALSE(none);
  EXPECT_NE(none.error().where.find("board"), std::string::npos);
  FirmataPeer peer(servos_.port, {.major = 3});
  const auto newer = open_firmata_gimbal(servos_, "main", model_);
  ASSERT_FALSE(newer);
  EXPECT_NE(newer.error().what.find("3.6"), std::string::npos) << newer.error().what;
}

TEST_F(FirmataGimbal, LimitsBeyondTheServosAreRefused) {
  model_.upper[0] = 1.57;
  servos_.us_per_degree[0] = 12;
  const auto gimbal = open_firmata_gimbal(servos_, "main", model_);
  ASSERT_FALSE(gimbal);
  EXPECT_NE(gimbal.error().what.find("pan"), std::string::npos);
}

TEST_F(FirmataGimbal, UnpluggedItIsAFaultAndFoundAgain) {
  auto peer = std::make_unique<FirmataPeer>(servos_.port);
  const auto gimbal = open();
  ASSERT_TRUE(gimbal);
  ASSERT_TRUE(peer->wait_for(at_rest));
  peer.reset();
  EXPECT_TRUE(says(*gimbal, "gone"));
  ASSERT_TRUE(gimbal->command({0, {0.5, 0, 0}}).ok()) << "commands meanwhile are remembered";
  peer = std::make_unique<FirmataPeer>(servos_.port);
  EXPECT_TRUE(says(*gimbal, "is back"));
  EXPECT_TRUE(peer->wait_for(
      [](const auto& seen) { return pan_pulse(seen) == 1786 && seen.servos.size() == 3; }));
}

TEST_F(FirmataGimbal, ABoardThatHangsIsAFault) {
  FirmataPeer peer(servos_.port);
  const auto gimbal = open();
  ASSERT_TRUE(gimbal);
  peer.hang();
  EXPECT_TRUE(says(*gimbal, "no longer answers"));
}

TEST_F(FirmataGimbal, LettingGoWhileItIsAwayIsQuick) {
  auto peer = std::make_unique<FirmataPeer>(servos_.port);
  auto gimbal = open();
  ASSERT_TRUE(gimbal);
  peer.reset();
  ASSERT_TRUE(says(*gimbal, "gone"));
  FirmataPeer silent(servos_.port, {.answers = false});  // a handshake may be under way
  const auto begin = std::chrono::steady_clock::now();
  gimbal.reset();
  EXPECT_LT(std::chrono::steady_clock::now() - begin, 1s);
}

}  // namespace
}  // namespace armsreach
