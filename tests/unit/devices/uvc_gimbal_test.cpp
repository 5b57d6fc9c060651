#include "devices/uvc_gimbal.hpp"

#include <cerrno>
#include <chrono>
#include <condition_variable>
#include <linux/videodev2.h>
#include <map>
#include <mutex>
#include <numbers>
#include <thread>
#include <variant>

#include <gtest/gtest.h>

namespace armsreach {
namespace {

using namespace std::chrono_literals;

constexpr double kDegree = std::numbers::pi / 180;

// A camera that pans by 100 degrees to each side and tilts by 30, in whole degrees.
class MotorCamera {
 public:
  bool has_motors = true;

  OpenDevice opener() {
    return [this](const std::string&) -> DeviceControl {
      const std::lock_guard lock(mutex_);
      errno = ENODEV;
      if (unplugged_) return nullptr;
      return [this](unsigned long request, void* argument) { return control(request, argument); };
    };
  }

  void unplug(bool away) {
    const std::lock_guard lock(mutex_);
    unplugged_ = away;
  }

  bool stands_at(int pan_degrees, int tilt_degrees) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, 5s, [&] {
      return values_[V4L2_CID_PAN_ABSOLUTE] == 3600 * pan_degrees &&
             values_[V4L2_CID_TILT_ABSOLUTE] == 3600 * tilt_degrees;
    });
  }

 private:
  int control(unsigned long request, void* argument) {
    const std::lock_guard lock(mutex_);
    errno = unplugged_ ? ENODEV : EINVAL;
    if (unplugged_ || !has_motors) return -1;
    if (request == VIDIOC_QUERYCTRL) {
      auto* query = static_cast<v4l2_queryctrl*>(argument);
      query->maximum = 3600 * (query->id == V4L2_CID_PAN_ABSOLUTE ? 100 : 30);
      query->minimum = -query->maximum;
      query->step = 3600;
      return 0;
    }
    if (request != VIDIOC_S_CTRL) return -1;
    const auto* set = static_cast<const v4l2_control*>(argument);
    values_[set->id] = set->value;
    changed_.notify_all();
    return 0;
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  std::map<std::uint32_t, int> values_;
  bool unplugged_ = false;
};

TEST(UvcGimbal, AnglesBecomeArcSecondsInTheCamerasSteps) {
  MotorCamera camera;
  const auto gimbal = open_uvc_gimbal({}, "main", {}, camera.opener());
  ASSERT_TRUE(gimbal) << gimbal.error().message();
  ASSERT_TRUE((*gimbal)->command({0, Eigen::Vector3d(40.4, -12.6, 5) * kDegree}).ok());
  EXPECT_TRUE(camera.stands_at(40, -13));
}

TEST(UvcGimbal, TheCamerasRangeNarrowsTheLimits) {
  MotorCamera camera;
  const auto gimbal = open_uvc_gimbal({}, "main", {}, camera.opener());
  ASSERT_TRUE(gimbal);
  const GimbalModel& model = (*gimbal)->model();
  EXPECT_NEAR(model.upper[0], 1.57, 1e-9) << "the model's own is narrower";
  EXPECT_NEAR(model.upper[1], 30 * kDegree, 1e-9);
  EXPECT_EQ(model.upper[2], 0) << "it has no roll";
}

TEST(UvcGimbal, RestsInTheEnd) {
  MotorCamera camera;
  {
    const auto gimbal = open_uvc_gimbal({}, "main", {}, camera.opener());
    ASSERT_TRUE(gimbal);
    ASSERT_TRUE((*gimbal)->command({0, {0.5, 0, 0}}).ok());
    ASSERT_TRUE(camera.stands_at(29, 0));
  }
  EXPECT_TRUE(camera.stands_at(0, 0));
}

TEST(UvcGimbal, WithoutMotorsOrDeviceItIsAnErrorWithARemedy) {
  MotorCamera camera;
  camera.has_motors = false;
  const auto still = open_uvc_gimbal({}, "main", {}, camera.opener());
  ASSERT_FALSE(still);
  EXPECT_NE(still.error().remedy.find("v4l2-ctl"), std::string::npos);
  const auto none = open_uvc_gimbal({"/dev/no-such-camera"}, "main", {});
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().kind, Error::Kind::device);
  EXPECT_EQ(none.error().where, "/dev/no-such-camera");
}

TEST(UvcGimbal, UnpluggedItIsAFaultAndFoundAgain) {
  MotorCamera camera;
  const auto gimbal = open_uvc_gimbal({}, "main", {}, camera.opener());
  ASSERT_TRUE(gimbal);
  camera.unplug(true);
  const auto said = [&](const std::string& text) {
    for (int i = 0; i < 500; ++i) {
      for (const Event& event : (*gimbal)->take_events())
        if (std::get<FaultEvent>(event.body).message.find(text) != std::string::npos) return true;
      std::this_thread::sleep_for(10ms);
    }
    return false;
  };
  EXPECT_TRUE(said("the pan/tilt camera")) << "has gone, or takes no commands";
  camera.unplug(false);
  EXPECT_TRUE(said("is back"));
  ASSERT_TRUE((*gimbal)->command({0, {0.5, 0, 0}}).ok());
  EXPECT_TRUE(camera.stands_at(29, 0));
}

}  // namespace
}  // namespace armsreach
