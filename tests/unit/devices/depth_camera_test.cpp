#include "devices/depth_camera.hpp"

#include <atomic>
#include <chrono>
#include <thread>

#include <gtest/gtest.h>

namespace armsreach {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

struct Script {
  DepthCameraListener* listener = nullptr;
  std::atomic<bool> present = true;
  cv::Size size{64, 48};
  bool with_color = true;
  bool registered = true;
  std::atomic<int> opened = 0;
  std::atomic<int> closed = 0;
};

class MadeUpDriver : public DepthCameraDriver {
 public:
  explicit MadeUpDriver(Script* script) : script_(script) {}
  Result<Opened> open(DepthCameraListener& listener) override {
    script_->listener = &listener;
    if (!script_->present) {
      return Error{"cannot be opened", "made-up", "be patient", Error::Kind::device};
    }
    ++script_->opened;
    Opened opened;
    opened.sensor.depth_camera = pinhole(script_->size.width, script_->size.height, 50, 50, 31, 23);
    if (script_->with_color) opened.sensor.color_camera = opened.sensor.depth_camera;
    opened.sensor.registered = script_->registered;
    opened.nominal = true;
    return opened;
  }
  void close() override { ++script_->closed; }

 private:
  Script* script_;
};

std::unique_ptr<Source> camera_of(Script* script, const OpenOptions& options = {}) {
  auto source = open_depth_camera(std::make_unique<MadeUpDriver>(script), "made-up:0", options);
  EXPECT_TRUE(source) << source.error().message();
  return source ? std::move(*source) : nullptr;
}

void deliver(Script* script, Timestamp time, float depth = 1) {
  script->listener->on_depth(cv::Mat(script->size, CV_32F, cv::Scalar(depth)), time);
  script->listener->on_color(cv::Mat(script->size, CV_8UC3, cv::Scalar::all(9)), time + 1'000'000);
}

std::string only_message(Source& source) {
  const Events events = source.take_events();
  return events.size() == 1 ? std::get<FaultEvent>(events[0].body).message : "not one event";
}

TEST(DepthCamera, TheNewestPairIsGivenAndNominalCamerasAreSaid) {
  Script script;
  const auto source = camera_of(&script);
  EXPECT_EQ(source->sensor()->name, "main");
  EXPECT_NE(only_message(*source).find("nominal"), std::string::npos);
  deliver(&script, 0, 1);
  deliver(&script, 33'000'000, 2);  // nobody took the first
  const auto frame = source->next();
  ASSERT_TRUE(frame && *frame);
  EXPECT_EQ((*frame)->index, 0);
  EXPECT_EQ((*frame)->depth.at<float>(0, 0), 2);
  EXPECT_EQ((*frame)->sensor, source->sensor());
}

TEST(DepthCamera, WithoutColourDepthAloneIsAFrame) {
  Script script;
  script.with_color = false;
  const auto source = camera_of(&script);
  script.listener->on_depth(cv::Mat(script.size, CV_32F, cv::Scalar(1)), 5);
  const auto frame = source->next();
  ASSERT_TRUE(frame && *frame);
  EXPECT_TRUE((*frame)->color.empty());
}

TEST(DepthCamera, GoneIsSaidOnceAndBackIsAnEvent) {
  Script script;
  const auto source = camera_of(&script);
  source->take_events();
  script.present = false;
  script.listener->on_gone("was unplugged");
  const auto gone = source->next();
  ASSERT_FALSE(gone);
  EXPECT_EQ(gone.error().kind, Error::Kind::away);
  EXPECT_EQ(gone.error().message(),
            "made-up:0: was unplugged (plug it in again: it is waited for)");
  EXPECT_EQ(script.closed, 1);

  script.listener->on_arrival();  // but it cannot be opened yet: another complaint, once
  const auto refused = source->next();
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().kind, Error::Kind::away);
  EXPECT_EQ(refused.error().what, "cannot be opened");

  std::thread hand([&] {
    std::this_thread::sleep_for(20ms);
    script.present = true;
    script.listener->on_arrival();
    while (script.opened < 2) std::this_thread::sleep_for(1ms);
    for (Timestamp i = 0; i < 50; ++i) {
      deliver(&script, 33'000'000 * i);
      std::this_thread::sleep_for(1ms);
    }
  });
  const auto start = Clock::now();
  const auto back = source->next();
  EXPECT_LT(Clock::now() - start, 900ms);  // the arrival woke it, not the retry after a second
  hand.join();
  ASSERT_TRUE(back && *back) << back.error().message();
  EXPECT_EQ(only_message(*source).find("is back after"), 0U);
}

TEST(DepthCamera, ItIsTriedAgainWithoutBeingToldOfAnArrival) {
  Script script;
  const auto source = camera_of(&script);
  script.listener->on_gone("was unplugged");
  ASSERT_FALSE(source->next());
  std::thread stopper([&] {
    std::this_thread::sleep_for(1200ms);  // after the retry at one second
    source->stop();
  });
  EXPECT_EQ(source->next().value(), nullptr);
  stopper.join();
  EXPECT_EQ(script.opened, 2);
}

TEST(DepthCamera, AnotherDeviceIsNotTakenForTheOneBefore) {
  Script script;
  const auto source = camera_of(&script);
  script.listener->on_gone("was unplugged");
  ASSERT_FALSE(source->next());
  script.size = {32, 24};
  script.listener->on_arrival();
  const auto other = source->next();
  ASSERT_FALSE(other);
  EXPECT_NE(other.error().what.find("other sizes"), std::string::npos);
}

TEST(DepthCamera, StopEndsAWait) {
  Script script;
  const auto source = camera_of(&script);
  std::thread stopper([&] {
    std::this_thread::sleep_for(20ms);
    source->stop();
  });
  const auto start = Clock::now();
  const auto frame = source->next();
  stopper.join();
  ASSERT_TRUE(frame);
  EXPECT_EQ(*frame, nullptr);
  EXPECT_LT(Clock::now() - start, 1s);  // silence is an error after three
}

TEST(DepthCamera, CameraFilesTakeThePlaceOfTheDrivers) {
  Script script;
  OpenOptions options;
  options.camera = CameraFile();
  options.camera->camera = pinhole(64, 48, 60, 60, 30, 20);
  const auto source = camera_of(&script, options);
  EXPECT_TRUE(source->take_events().empty());
  EXPECT_EQ(source->sensor()->depth_camera->fx, 60);
  EXPECT_EQ(source->sensor()->color_camera->fx, 60);  // registered: the same pixels

  options.camera->camera_from_depth = Pose();
  const auto refused =
      open_depth_camera(std::make_unique<MadeUpDriver>(&script), "made-up:0", options);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().what.find("registered"), std::string::npos);

  script.registered = false;
  const auto own = camera_of(&script, options);
  EXPECT_EQ(own->sensor()->depth_camera->fx, 50);
  EXPECT_EQ(own->sensor()->color_camera->fx, 60);

  options.camera->camera.width = 65;
  EXPECT_FALSE(open_depth_camera(std::make_unique<MadeUpDriver>(&script), "made-up:0", options));
}

}  // namespace
}  // namespace armsreach
