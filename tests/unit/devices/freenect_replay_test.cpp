// The Kinect's source from end to end, with fakenect in the place of libfreenect: this program is
// linked so that it loads the one for the other. Fakenect reads its folder once in a process, so
// the tests are one after the other in one.
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <thread>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "devices/freenect.hpp"
#include "devices/kinect_model.hpp"
#include "tests/support/program.hpp"
#include "tests/unit/devices/kinect_session.hpp"

namespace armsreach {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr int kFrames = 20;

void check_images(const Frame& frame, int number) {
  ASSERT_EQ(frame.depth.size(), cv::Size(640, 480));
  ASSERT_EQ(frame.color.size(), cv::Size(640, 480));
  const KinectGeometry geometry;
  for (const cv::Point at : {cv::Point{0, 1}, cv::Point{333, 222}, cv::Point{639, 479}}) {
    const float z = kinect_depth(test::kinect_number(at.x, at.y, number), geometry);
    EXPECT_EQ(frame.depth.at<float>(at), z);
    const auto& bgr = frame.color.at<cv::Vec3b>(at);
    EXPECT_EQ(bgr[2], number);
    EXPECT_EQ(bgr[1], at.x % 256);
    EXPECT_EQ(bgr[0], at.y % 256);
  }
  EXPECT_TRUE(std::isnan(frame.depth.at<float>(0, 7)));
}

TEST(FreenectReplay, ASessionIsPlayedAndItsEndIsAnUnpluggedKinect) {
  const test::TemporaryFolder folder;
  test::write_kinect_session(folder.path(), kFrames);
  setenv("FAKENECT_PATH", folder.path().c_str(), 1);
  auto opened = open_freenect_camera(*parse_source_spec("freenect:0,depth=raw"), {});
  ASSERT_TRUE(opened) << opened.error().message();
  Source& source = **opened;
  EXPECT_TRUE(source.live());
  EXPECT_FALSE(source.sensor()->registered);
  const Events events = source.take_events();
  ASSERT_EQ(events.size(), 1U);
  EXPECT_NE(std::get<FaultEvent>(events[0].body).message.find("nominal"), std::string::npos);

  // A live source gives the newest: on a busy machine some are passed over, none comes twice.
  int frames = 0;
  int previous = -1;
  Timestamp previous_time = 0;
  Result<FramePtr> frame = source.next();
  for (; frame; frame = source.next()) {
    ASSERT_TRUE(*frame);
    const int number = (*frame)->color.at<cv::Vec3b>(0, 0)[2];
    EXPECT_GT(number, previous);
    previous = number;
    EXPECT_GT((*frame)->time, previous_time);
    previous_time = (*frame)->time;
    EXPECT_EQ((*frame)->index, frames++);
    check_images(**frame, number);
  }
  EXPECT_GE(frames, 2);  // of kFrames, however slow the machine
  EXPECT_EQ(frame.error().kind, Error::Kind::away);
  EXPECT_EQ(frame.error().what, "the Kinect has gone");
  EXPECT_EQ(frame.error().where, "freenect:0,depth=raw");

  // Fakenect gives no more, so it does not come back; a stop ends the wait.
  std::thread stopper([&] {
    std::this_thread::sleep_for(1500ms);  // over one attempt to open it again
    source.stop();
  });
  const auto start = Clock::now();
  frame = source.next();
  stopper.join();
  ASSERT_TRUE(frame) << frame.error().message();
  EXPECT_EQ(*frame, nullptr);
  EXPECT_LT(Clock::now() - start, 2300ms);  // before the next attempt is due
}

}  // namespace
}  // namespace armsreach
