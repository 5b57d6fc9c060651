#include "devices/openni.hpp"

#include <OpenNI.h>
#include <chrono>
#include <cmath>
#include <dlfcn.h>
#include <fstream>
#include <thread>

#include <gtest/gtest.h>

#include "devices/openni_streams.hpp"
#include "tests/support/program.hpp"
#include "tests/unit/devices/made_up_openni_driver.hpp"

namespace armsreach {
namespace {

using namespace std::chrono_literals;
using namespace test;
using Clock = std::chrono::steady_clock;

// The library loads the module; opening it again gives the same one.
class OpenNi : public testing::Test {
 protected:
  void SetUp() override {
    auto library = OpenNiLibrary::start();
    ASSERT_TRUE(library) << library.error().message();
    library_ = *library;
    void* module = dlopen(ARMSREACH_MADE_UP_DRIVER, RTLD_NOW | RTLD_NOLOAD);
    ASSERT_NE(module, nullptr) << "the library did not load its made-up driver";
    plug_ = reinterpret_cast<MadeUpSensorPlug>(dlsym(module, "made_up_sensor_plug"));
    ASSERT_NE(plug_, nullptr);
    dlclose(module);
  }
  void plug(bool in) { plug_(in); }

  std::unique_ptr<Source> open(const std::string& text, const OpenOptions& options = {}) {
    auto source = open_openni(*parse_source_spec(text), options);
    EXPECT_TRUE(source) << source.error().message();
    return source ? std::move(*source) : nullptr;
  }

  std::shared_ptr<OpenNiLibrary> library_;
  MadeUpSensorPlug plug_ = nullptr;
};

cv::Vec3b made_up_color(int x, int y, int number) {
  return {static_cast<std::uint8_t>(y), static_cast<std::uint8_t>(x), made_up_red(number)};
}

// That colour and depth are whole and of one moment; their number.
int check_images(const Frame& frame, bool registered) {
  EXPECT_EQ(frame.depth.type(), CV_32F);
  EXPECT_EQ(frame.color.type(), CV_8UC3);
  const int number = frame.color.at<cv::Vec3b>(0, 0)[2];
  for (const cv::Point at : {cv::Point{0, 1}, cv::Point{100, 60}, cv::Point{159, 119}}) {
    const auto millimetres = std::lround(1000 * frame.depth.at<float>(at));
    // Red counts modulo 251 and depth modulo 1000: the sensor is not open for as long as that.
    EXPECT_EQ(millimetres, made_up_depth(at.x, at.y, number, registered));
    EXPECT_EQ(frame.color.at<cv::Vec3b>(at), made_up_color(at.x, at.y, number));
  }
  EXPECT_TRUE(std::isnan(frame.depth.at<float>(0, 5)));
  return number;
}

TEST_F(OpenNi, WithoutASensorSaysSo) {
  const auto source = open_openni(*parse_source_spec("openni:any"), {});
  ASSERT_FALSE(source);
  EXPECT_EQ(source.error().kind, Error::Kind::device);
  EXPECT_NE(source.error().what.find("no OpenNI2 sensor"), std::string::npos);
  EXPECT_NE(source.error().remedy.find("plug it in"), std::string::npos);
  const auto lines = probe_openni({});
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_FALSE(lines[0].usable);
  EXPECT_EQ(lines[1].spec, "openni:FILE.oni");
}

TEST_F(OpenNi, StreamsRegisteredPairsOfOneMoment) {
  plug(true);
  const auto lines = probe_openni({});
  EXPECT_TRUE(lines[0].usable);
  EXPECT_EQ(lines[0].detail, "Nobody made-up sensor");
  const auto source = open("openni:any");
  ASSERT_TRUE(source);
  EXPECT_TRUE(source->live());
  const SensorInfo& sensor = *source->sensor();
  EXPECT_TRUE(sensor.registered);
  // The field of view is that from edge to edge.
  EXPECT_NEAR(sensor.depth_camera->fx, 80 / std::tan(0.5), 1e-4);
  EXPECT_NEAR(sensor.depth_camera->fy, 60 / std::tan(0.4), 1e-4);
  EXPECT_EQ(sensor.depth_camera->cx, 79.5);
  EXPECT_TRUE(source->take_events().empty());
  Timestamp previous = 0;
  for (int i = 0; i < 10; ++i) {
    const auto frame = source->next();
    ASSERT_TRUE(frame && *frame);
    EXPECT_EQ((*frame)->index, i);
    EXPECT_GT((*frame)->time, previous);
    previous = (*frame)->time;
    check_images(**frame, true);
  }
  plug(false);
}

TEST_F(OpenNi, LeavesRegistrationOffWhenAsked) {
  plug(true);
  const auto source = open(std::string("openni:") + kMadeUpUri + ",registration=off");
  ASSERT_TRUE(source);
  EXPECT_FALSE(source->sensor()->registered);
  EXPECT_EQ(source->sensor()->color_from_depth.translation().x(), -0.025);  // the usual one
  const auto frame = source->next();
  ASSERT_TRUE(frame && *frame);
  check_images(**frame, false);
  plug(false);
}

TEST_F(OpenNi, UnpluggedIsSaidOnceAndComesBack) {
  plug(true);
  const auto source = open("openni:any");
  ASSERT_TRUE(source);
  ASSERT_TRUE(source->next());
  plug(false);
  std::optional<Error> error;
  for (int frames = 0; frames < 3 && !error; ++frames) {  // one may have been waiting
    auto frame = source->next();
    if (!frame) error = frame.error();
  }
  ASSERT_TRUE(error);
  EXPECT_EQ(error->kind, Error::Kind::away);
  EXPECT_EQ(error->what, "the sensor has gone");
  EXPECT_FALSE(error->remedy.empty());

  std::thread hand([this] {
    std::this_thread::sleep_for(50ms);
    plug(true);
  });
  auto frame = source->next();
  if (!frame) frame = source->next();  // tried in vain before it came: said once
  hand.join();
  ASSERT_TRUE(frame) << frame.error().message();
  ASSERT_TRUE(*frame);
  check_images(**frame, true);
  const Events events = source->take_events();
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(std::get<FaultEvent>(events[0].body).message.find("is back after"), 0U);
  plug(false);
}

TEST_F(OpenNi, StopEndsTheWaitForAnAbsentSensor) {
  plug(true);
  const auto source = open("openni:any");
  ASSERT_TRUE(source);
  plug(false);
  std::thread stopper([&] {
    std::this_thread::sleep_for(300ms);
    source->stop();
  });
  const auto start = Clock::now();
  Result<FramePtr> frame = source->next();
  while (!frame || *frame) frame = source->next();
  stopper.join();
  EXPECT_LT(Clock::now() - start, 900ms);  // within the 1 s between tries: the stop woke it
}

// Recorded by the library itself.
void record(const std::string& file, int frames) {
  openni::Device device;
  ASSERT_EQ(device.open(kMadeUpUri), openni::STATUS_OK);
  openni::VideoStream depth;
  openni::VideoStream color;
  ASSERT_EQ(depth.create(device, openni::SENSOR_DEPTH), openni::STATUS_OK);
  ASSERT_EQ(color.create(device, openni::SENSOR_COLOR), openni::STATUS_OK);
  openni::Recorder recorder;
  ASSERT_EQ(recorder.create(file.c_str()), openni::STATUS_OK);
  ASSERT_EQ(recorder.attach(depth), openni::STATUS_OK);
  ASSERT_EQ(recorder.attach(color), openni::STATUS_OK);
  ASSERT_EQ(recorder.start(), openni::STATUS_OK);
  ASSERT_EQ(color.start(), openni::STATUS_OK);
  ASSERT_EQ(depth.start(), openni::STATUS_OK);
  openni::VideoFrameRef frame;
  for (int i = 0; i < frames; ++i) ASSERT_EQ(depth.readFrame(&frame), openni::STATUS_OK);
  recorder.stop();
  frame.release();
  recorder.destroy();
  depth.stop();
  color.stop();
}

class OniFile : public OpenNi {
 protected:
  void SetUp() override {
    OpenNi::SetUp();
    if (HasFatalFailure()) return;
    plug(true);
    record(file(), 20);
    plug(false);
  }
  std::string file() const { return folder_ / "made_up.oni"; }

  TemporaryFolder folder_;
};

TEST_F(OniFile, PlaysEveryFrameAndEnds) {
  const auto source = open("openni:" + file());
  ASSERT_TRUE(source);
  EXPECT_FALSE(source->live());
  ASSERT_TRUE(source->frame_count());
  const std::int64_t count = *source->frame_count();
  EXPECT_GE(count, 18);
  EXPECT_NEAR(source->sensor()->depth_camera->fx, 80 / std::tan(0.5), 1e-4);
  std::optional<int> first;
  Timestamp start = 0;
  for (std::int64_t i = 0; i < count; ++i) {
    const auto frame = source->next();
    if (!frame && i == count - 1) break;  // recording ended between depth and its colour
    ASSERT_TRUE(frame) << frame.error().message();
    ASSERT_TRUE(*frame);
    const int number = check_images(**frame, false);
    if (!first) {
      first = number;
      start = (*frame)->time;  // a recording has its own zero
    }
    EXPECT_EQ(number, *first + i);
    EXPECT_EQ((*frame)->time, start + 1000 * kMadeUpPeriod * i);
  }
  EXPECT_EQ(source->next().value(), nullptr);
  for (const Event& event : source->take_events()) {
    ADD_FAILURE() << std::get<FaultEvent>(event.body).message;
  }
}

TEST_F(OniFile, PingPongTurnsAtBothEnds) {
  const auto source = open("openni:" + file() + ",loop=pingpong");
  ASSERT_TRUE(source);
  const int last = static_cast<int>(*open("openni:" + file())->frame_count()) - 1;
  int first = -1;
  Timestamp previous = -1;
  for (int i = 0; i < 4 * last; ++i) {
    const auto frame = source->next();
    const int phase = i % (2 * last);
    const int expected = phase <= last ? phase : 2 * last - phase;
    if (!frame && expected == last) continue;  // without colour
    ASSERT_TRUE(frame && *frame) << i << frame.error().message();
    const int number = check_images(**frame, false);
    if (first < 0) first = number;
    EXPECT_EQ(number, first + expected) << i;
    EXPECT_GT((*frame)->time, previous);
    previous = (*frame)->time;
  }
}

TEST_F(OniFile, DamagedFilesEndWithAMessage) {
  const std::string whole = read_text(file());
  for (const std::size_t size : {std::size_t{0}, std::size_t{7}, std::size_t{40}, std::size_t{700},
                                 whole.size() / 2, whole.size() - 50}) {
    const std::string damaged = folder_ / "damaged.oni";
    write_text(damaged, whole.substr(0, size));
    const auto start = Clock::now();
    const auto source = open_openni(*parse_source_spec("openni:" + damaged), {});
    if (!source) {
      EXPECT_EQ(source.error().where, damaged);
      EXPECT_FALSE(source.error().remedy.empty());
    } else {
      for (int i = 0; i < 100; ++i) {
        const auto frame = (*source)->next();
        if (frame && !*frame) break;
        ASSERT_LT(i, 99) << "it does not end";
      }
    }
    EXPECT_LT(Clock::now() - start, 20s) << size;
  }
}

TEST(OpenNiSpec, WrongOnesAreRefused) {
  const auto refusal = [](const std::string& text) {
    const auto source = open_openni(*parse_source_spec(text), {});
    return source ? "" : source.error().what;
  };
  EXPECT_EQ(refusal("openni:no/such.oni"), "no such file");
  EXPECT_EQ(refusal("openni:any,loop=pingpong"), "option 'loop' is for recordings");
  EXPECT_EQ(refusal("openni:any,registration=maybe"), "option 'registration' is 'maybe'");
  const TemporaryFolder folder;
  write_text(folder / "text.oni", "this is not a recording at all, whatever its name says");
  EXPECT_EQ(refusal("openni:" + (folder / "text.oni").string()), "not a recording of OpenNI2");
}

}  // namespace
}  // namespace armsreach
