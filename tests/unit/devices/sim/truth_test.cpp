// Depth and pose of every frame against rays cast through the world's data.
#include "devices/truth.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "devices/open.hpp"
#include "devices/sim/carrier.hpp"
#include "devices/sim/motion.hpp"
#include "devices/sim/sim_source.hpp"
#include "devices/sim/worlds.hpp"
#include "tests/unit/devices/sim/ray_cast.hpp"

namespace armsreach::sim {
namespace {

std::unique_ptr<Source> open(const std::string& text) {
  auto source = open_source(*parse_source_spec(text), {}, sim_source_kinds());
  EXPECT_TRUE(source.ok()) << source.error().message();
  return std::move(*source);
}

std::vector<Pose> things_of(const Frame& frame) {
  std::vector<Pose> poses;
  for (const TrueThing& thing : frame.truth->things) poses.push_back(thing.world_from_thing);
  return poses;
}

// The thing and z-depth that a pixel's ray meets; nothing where the pixel's corners see another
// thing than its centre (an edge) or a turned shape, which the rays know only roughly.
std::optional<Hit> clear_hit(const World& world, const Frame& frame, const Eigen::Vector2d& pixel) {
  const Pose& pose = *frame.world_from_camera;
  const auto cast = [&](double dx, double dy) {
    const Eigen::Vector3d ray =
        unproject(frame.sensor->camera(), pixel + Eigen::Vector2d(dx, dy));  // z = 1
    return cast_ray(world, things_of(frame), pose.translation(), pose.rotation() * ray);
  };
  const std::optional<Hit> centre = cast(0, 0);
  if (!centre || !centre->exact) return std::nullopt;
  for (const double dx : {-0.6, 0.6}) {
    for (const double dy : {-0.6, 0.6}) {
      const std::optional<Hit> corner = cast(dx, dy);
      if (!corner || corner->part != centre->part) return std::nullopt;
    }
  }
  return centre;
}

struct DepthErrors {
  std::vector<double> sorted;
  int unknown = 0;
  int mistaken = 0;  // in the masks
  int hand = 0;      // pixels with one
  double apart = 0;  // the truth's depth and a perfect sensor's
};

DepthErrors depth_errors(const World& world, const Frame& frame) {
  DepthErrors errors;
  for (int y = 0; y < frame.depth.rows; ++y) {
    for (int x = 0; x < frame.depth.cols; ++x) {
      const auto hit = clear_hit(world, frame, Eigen::Vector2d(x, y));
      if (!hit) continue;
      const TrueThing& thing = frame.truth->things[static_cast<std::size_t>(hit->thing)];
      const int mask = frame.truth->masks.at<std::uint16_t>(y, x);
      const double depth = static_cast<double>(frame.truth->depth.at<float>(y, x));
      errors.apart = std::max(errors.apart,
                              std::abs(depth - static_cast<double>(frame.depth.at<float>(y, x))));
      // The rays know nothing of hands: one that is seen is before what they meet.
      if (mask > static_cast<int>(frame.truth->things.size())) {
        ++errors.hand;
        errors.mistaken += !(depth < hit->distance + 1e-4);
        continue;
      }
      errors.mistaken += mask != thing.mask;
      if (std::isnan(depth)) {
        ++errors.unknown;
      } else {
        errors.sorted.push_back(std::abs(depth - hit->distance));
      }
    }
  }
  std::sort(errors.sorted.begin(), errors.sorted.end());
  return errors;
}

class Truth : public testing::TestWithParam<std::string> {};

TEST_P(Truth, DepthIsWhatRaysThroughTheWorldMeet) {
  const World world = *load_world(GetParam());
  const auto source = open("sim:" + GetParam() +
                           ",sensor=main,noise=none,near=0,far=50,width=320,speed=40,frames=5");
  int frames = 0;
  int hand = 0;
  while (true) {
    auto frame = source->next();
    ASSERT_TRUE(frame.ok()) << frame.error().message();
    if (!*frame) break;
    ++frames;
    const DepthErrors errors = depth_errors(world, **frame);
    const std::size_t count = errors.sorted.size();
    ASSERT_GT(count, 320U * 240U / 2) << "most of the picture is boxes, cylinders and planes";
    EXPECT_EQ(errors.unknown, 0);
    EXPECT_EQ(errors.mistaken, 0);
    EXPECT_EQ(errors.apart, 0);
    hand += errors.hand;
    // Single precision near 2 m is 0.1 um. A rasteriser places corners on a grid of 1/256 px, which
    // at a grazing angle is worth some tenths of a millimetre, and a tin's side is a polygon's.
    EXPECT_LT(errors.sorted[count / 2], 1e-5);
    EXPECT_LT(errors.sorted[count * 999 / 1000], 5e-4);
  }
  EXPECT_EQ(frames, 5);
  if (GetParam() == "assembly" || GetParam() == "packaging") {
    EXPECT_GT(hand, 500) << "hands are in the picture";
  }
}

TEST_P(Truth, TheCameraKeepsItsDistanceAndLooksAtTheThings) {
  const World world = *load_world(GetParam());
  const Carrier carrier = carrier_of(world, world.sensor, 1);
  const bool near = GetParam() == "near";
  for (double time = 0; time < world.path.duration; time += 1 / world.sensor.rate) {
    const Pose pose = carrier(time);
    const std::vector<Pose> things = poses_at(world, time);
    EXPECT_GT(clearance(world, things, pose.translation()), near ? 0.15 : 0.35) << time;
    const Eigen::Vector3d forward = pose.rotation() * Eigen::Vector3d::UnitZ();
    const auto hit = cast_ray(world, things, pose.translation(), forward);
    ASSERT_TRUE(hit.has_value()) << time;
    EXPECT_GT(hit->distance, near ? 0.25 : 0.5) << time;
    EXPECT_LT(hit->distance, near ? 0.9 : 3.2) << time;
  }
}

TEST(TruthOfContacts, FollowsWhatIsPickedUpAndPutDown) {
  const auto source = open("sim:assembly,width=32,noise=none,rate=1,frames=6");
  const auto touch = [](const Frame& frame, const std::string& a, const std::string& b) {
    const auto& pairs = frame.truth->contacts;
    return std::find(pairs.begin(), pairs.end(), std::pair(a, b)) != pairs.end();
  };
  for (int second = 0; second < 6; ++second) {
    const FramePtr frame = *source->next();
    // Taken up from its bearers at 2 s, laid across the other one at 4.6 s.
    EXPECT_EQ(touch(*frame, "bearers", "second baton"), second <= 2) << second;
    EXPECT_EQ(touch(*frame, "first baton", "second baton"), second >= 5) << second;
    EXPECT_TRUE(touch(*frame, "hammer block", "hammer")) << second;
  }
}

std::string test_name(const testing::TestParamInfo<std::string>& one) {
  std::string name = one.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Worlds, Truth, testing::ValuesIn(world_names()), test_name);

}  // namespace
}  // namespace armsreach::sim
