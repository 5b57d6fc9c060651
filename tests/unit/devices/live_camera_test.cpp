#include "devices/live_camera.hpp"

#include <chrono>
#include <thread>

#include <gtest/gtest.h>

#include "devices/v4l2.hpp"
#include "tests/unit/devices/recorded_folder.hpp"

namespace armsreach {
namespace {

using namespace std::chrono_literals;
using State = CameraDriver::State;
using Clock = std::chrono::steady_clock;

// Gives `images` frames and then stays in one state.
class MadeUpDriver : public CameraDriver {
 public:
  MadeUpDriver(int images, State afterwards, cv::Size size = {64, 48})
      : images_(images), afterwards_(afterwards), size_(size) {}
  State wait(std::chrono::milliseconds limit) override {
    if (images_ > 0) return State::ready;
    if (afterwards_ == State::waiting) std::this_thread::sleep_for(limit);
    return afterwards_;
  }
  cv::Mat read() override {
    if (images_-- <= 0) return {};
    return cv::Mat(size_, CV_8UC3, cv::Scalar::all(images_));
  }

 private:
  int images_;
  State afterwards_;
  cv::Size size_;
};

std::unique_ptr<Source> camera_of(std::unique_ptr<CameraDriver> driver) {
  SensorInfo sensor;
  sensor.color_camera = pinhole(64, 48, 50, 50, 31.5, 23.5);
  return live_camera(std::move(driver), "/dev/video7", sensor, {});
}

TEST(LiveCamera, DeliversFramesWithGrowingTimes) {
  const auto source = camera_of(std::make_unique<MadeUpDriver>(3, State::gone));
  EXPECT_TRUE(source->live());
  EXPECT_EQ(source->frame_count(), std::nullopt);
  Timestamp previous = 0;
  for (int i = 0; i < 3; ++i) {
    const auto frame = source->next();
    ASSERT_TRUE(frame && *frame);
    EXPECT_EQ((*frame)->index, i);
    EXPECT_GT((*frame)->time, previous);
    previous = (*frame)->time;
  }
}

void expect_device_error(Source& source, const std::string& what) {
  const auto frame = source.next();
  ASSERT_FALSE(frame);
  EXPECT_EQ(frame.error().kind, Error::Kind::device);
  EXPECT_EQ(frame.error().where, "/dev/video7");
  EXPECT_NE(frame.error().what.find(what), std::string::npos) << frame.error().message();
  EXPECT_FALSE(frame.error().remedy.empty());
}

TEST(LiveCamera, UnpluggingStallingAndFailingAreDeviceErrors) {
  expect_device_error(*camera_of(std::make_unique<MadeUpDriver>(0, State::gone)), "gone");
  expect_device_error(*camera_of(std::make_unique<MadeUpDriver>(0, State::ready)), "no image");
  expect_device_error(*camera_of(std::make_unique<MadeUpDriver>(1, State::gone, cv::Size(32, 24))),
                      "size");
  const auto start = Clock::now();
  expect_device_error(*camera_of(std::make_unique<MadeUpDriver>(0, State::waiting)), "silent");
  EXPECT_LT(Clock::now() - start, 10s);  // 2 s by design; a hang would not come back
}

TEST(LiveCamera, StopEndsAWait) {
  const auto source = camera_of(std::make_unique<MadeUpDriver>(0, State::waiting));
  std::thread stopper([&] {
    std::this_thread::sleep_for(20ms);
    source->stop();
  });
  const auto frame = source->next();  // silent for two seconds would be an error
  stopper.join();
  ASSERT_TRUE(frame) << frame.error().message();
  EXPECT_EQ(*frame, nullptr);
  EXPECT_EQ(source->next().value(), nullptr);
}

TEST(V4l2, AbsentCamerasAndWrongNumbersSayWhatToDo) {
  const auto absent = open_v4l2_camera(*parse_source_spec("camera:63"), {});
  ASSERT_FALSE(absent);
  EXPECT_EQ(absent.error().kind, Error::Kind::device);
  EXPECT_EQ(absent.error().where, "/dev/video63");
  EXPECT_NE(absent.error().remedy.find("--device /dev/video63"), std::string::npos);
  for (const char* wrong :
       {"camera:front", "camera:-1", "camera:64", "camera:0x1", "camera:1000"}) {
    const auto camera = open_v4l2_camera(*parse_source_spec(wrong), {});
    ASSERT_FALSE(camera) << wrong;
    EXPECT_EQ(camera.error().kind, Error::Kind::input);
  }
}

TEST(V4l2, ProbeSaysWhatIsThereAndWhyNot) {
  const test::RecordedFolder devices;
  const auto none = probe_v4l2(devices.path());
  ASSERT_EQ(none.size(), 1U);
  EXPECT_FALSE(none[0].usable);
  EXPECT_NE(none[0].detail.find("video0 is absent"), std::string::npos);
  EXPECT_FALSE(none[0].remedy.empty());

  devices.write("video2", "an ordinary file");
  const auto one = probe_v4l2(devices.path());
  ASSERT_EQ(one.size(), 1U);
  EXPECT_EQ(one[0].spec, "camera:2");
  EXPECT_FALSE(one[0].usable);
  EXPECT_EQ(one[0].detail, "not a video device");
}

}  // namespace
}  // namespace armsreach
