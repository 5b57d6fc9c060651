// The infra-red worlds through their sources: what a plain threshold finds against the truth.
#include "devices/sim/infrared/infrared_source.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "devices/open.hpp"
#include "devices/sim/worlds.hpp"
#include "devices/truth.hpp"

namespace armsreach::sim {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

struct Shot {
  FramePtr frame;
  InfraredTruth truth;
};

// A look every third of a second, drawn once for all tests.
const std::vector<Shot>& shots_of(const std::string& name) {
  static std::map<std::string, std::vector<Shot>> drawn;
  const auto [entry, is_new] = drawn.try_emplace(name);
  if (!is_new) return entry->second;
  World world = *load_world(name);
  world.infrared->rate = 3;
  const auto source = make_infrared_source(world, {});
  while (true) {
    auto frame = source->next();
    if (!frame || !*frame) return entry->second;
    entry->second.push_back({*frame, source->truth()});
  }
}

// Middles of what is brighter than half, holes filled.
std::vector<Eigen::Vector2d> blobs_of(const cv::Mat& image) {
  std::vector<std::vector<cv::Point>> outlines;
  cv::findContours(image > 128, outlines, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
  std::vector<Eigen::Vector2d> blobs;
  for (std::size_t i = 0; i < outlines.size(); ++i) {
    const cv::Rect place = cv::boundingRect(outlines[i]);
    cv::Mat filled = cv::Mat::zeros(place.size(), CV_8U);
    cv::drawContours(filled, outlines, static_cast<int>(i), cv::Scalar(255), cv::FILLED, cv::LINE_8,
                     cv::noArray(), 0, -place.tl());
    const cv::Moments m = cv::moments(filled, true);
    if (m.m00 > 4) blobs.emplace_back(place.x + m.m10 / m.m00, place.y + m.m01 / m.m00);
  }
  return blobs;
}

// Middle of what a marker covers in the picture: of a tilted square that is not its centre's place.
Eigen::Vector2d middle_of(const MarkerTruth& marker) {
  if (marker.corners.empty()) return *marker.centre;
  std::vector<cv::Point2f> outline;
  for (const auto& corner : marker.corners)
    outline.emplace_back(static_cast<float>(corner.x()), static_cast<float>(corner.y()));
  const cv::Moments m = cv::moments(outline);
  return {m.m10 / m.m00, m.m01 / m.m00};
}

// Wholly seen, by a camera that it faces, and apart from others by more than their glow.
bool clear(const MarkerTruth& marker, const InfraredTruth& truth) {
  if (marker.visible < 0.999 || marker.incidence > 40 * kDegree) return false;
  return std::all_of(truth.markers.begin(), truth.markers.end(), [&](const MarkerTruth& other) {
    const double apart = marker.name == "square" || other.name == "square" ? 35 : 9;  // px
    return &other == &marker || other.visible == 0 ||
           (*other.centre - *marker.centre).norm() > apart;
  });
}

class InfraredWorld : public testing::TestWithParam<std::string> {};

TEST_P(InfraredWorld, BlobsLieWhereMarkersAre) {
  int checked = 0;
  int off = 0;
  double sum = 0;
  for (const Shot& shot : shots_of(GetParam())) {
    const std::vector<Eigen::Vector2d> blobs = blobs_of(shot.frame->color);
    for (const MarkerTruth& marker : shot.truth.markers) {
      if (!clear(marker, shot.truth)) continue;
      const Eigen::Vector2d expected = middle_of(marker);
      double nearest = 1e9;
      for (const Eigen::Vector2d& blob : blobs)
        nearest = std::min(nearest, (blob - expected).norm());
      // Cut at whole pixels, a blob of 30 px has its middle within some tenths.
      EXPECT_LT(nearest, 0.4) << marker.name << " at frame " << shot.frame->index << ", "
                              << expected.transpose();
      EXPECT_EQ(shot.frame->color.at<std::uint8_t>(static_cast<int>(std::lround(expected.y())),
                                                   static_cast<int>(std::lround(expected.x()))),
                255)
          << marker.name;
      sum += nearest;
      off += nearest > 0.3;
      ++checked;
    }
  }
  EXPECT_GT(checked, 30);
  EXPECT_LE(off, checked / 100 + 1) << "of " << checked << " are more than 0.3 px off";
  EXPECT_LT(sum / checked, 0.15);
}

TEST_P(InfraredWorld, TheRestIsNearlyBlack) {
  for (const Shot& shot : shots_of(GetParam())) {
    cv::Mat rest(shot.frame->color.size(), CV_8U, cv::Scalar(255));
    for (const MarkerTruth& marker : shot.truth.markers) {
      if (!marker.centre) continue;
      const cv::Point at(static_cast<int>(marker.centre->x()),
                         static_cast<int>(marker.centre->y()));
      cv::circle(rest, at, marker.name == "square" ? 45 : 14, cv::Scalar(0), cv::FILLED);
    }
    EXPECT_LT(cv::mean(shot.frame->color, rest)[0], 8) << shot.frame->index;
    double brightest = 0;
    cv::Mat smooth;
    cv::blur(shot.frame->color, smooth, {3, 3});
    cv::minMaxLoc(smooth, nullptr, &brightest, nullptr, nullptr, rest);
    EXPECT_LT(brightest, 128) << shot.frame->index;
  }
}

TEST_P(InfraredWorld, WhatIsHiddenIsDark) {
  int hidden = 0;
  for (const Shot& shot : shots_of(GetParam())) {
    for (const MarkerTruth& marker : shot.truth.markers) {
      if (marker.visible > 0 || !marker.centre ||
          !shot.frame->sensor->camera().contains(*marker.centre))
        continue;
      const bool beside_another = std::any_of(
          shot.truth.markers.begin(), shot.truth.markers.end(), [&](const MarkerTruth& other) {
            const double reach = other.name == "square" ? 45 : 14;
            return other.visible > 0 && (*other.centre - *marker.centre).norm() < reach;
          });
      if (beside_another) continue;
      ++hidden;
      EXPECT_LT(static_cast<int>(shot.frame->color.at<std::uint8_t>(
                    static_cast<int>(std::lround(marker.centre->y())),
                    static_cast<int>(std::lround(marker.centre->x())))),
                60)
          << marker.name << " at frame " << shot.frame->index;
    }
  }
  EXPECT_GT(hidden, 5);
}

// Independent of how the tape is laid: from the corners and centres that the truth tells.
TEST_P(InfraredWorld, TheBraceletIsRoundAndItsSegmentsAreSpacedAlongTheBand) {
  const World world = *load_world(GetParam());
  const BraceletDescription& bracelet = *world.infrared->bracelet;
  for (const Shot& shot : shots_of(GetParam())) {
    const Pose bracelet_from_world =
        (shot.truth.world_from_camera * *shot.truth.camera_from_bracelet).inverse();
    std::vector<double> angles;
    for (const MarkerTruth& marker : shot.truth.markers) {
      if (marker.name.rfind("bracelet", 0) != 0) continue;
      const Eigen::Vector3d centre = bracelet_from_world * marker.centre_in_world;
      EXPECT_NEAR(std::hypot(centre.x(), centre.z()), bracelet.radius, 1e-9);
      EXPECT_NEAR(centre.y(), 0, 1e-9);
      angles.push_back(std::atan2(centre.x(), -centre.z()));
      ASSERT_EQ(marker.corners_in_world.size(), 4U);
      EXPECT_NEAR((marker.corners_in_world[1] - marker.corners_in_world[2]).norm(), 0.007, 1e-9);
    }
    ASSERT_EQ(angles.size(),
              static_cast<std::size_t>(2 * std::numbers::pi * bracelet.radius / 0.021));
    for (std::size_t i = 1; i < angles.size(); ++i)
      EXPECT_NEAR((angles[i - 1] - angles[i]) * bracelet.radius, 0.021, 1e-9);
  }
}

// The arm does not stick out of the ring: what faces the camera and lies in the picture is seen.
TEST_P(InfraredWorld, SegmentsThatFaceTheCameraAreSeen) {
  int facing = 0;
  int seen = 0;
  for (const Shot& shot : shots_of(GetParam())) {
    for (const MarkerTruth& marker : shot.truth.markers) {
      if (marker.name.rfind("bracelet", 0) != 0 || marker.incidence > 50 * kDegree) continue;
      ++facing;
      seen += marker.visible > 0.99;
    }
  }
  // Fingers bent back over the wrist hide it now and then, and so does the picture's edge.
  EXPECT_GT(facing, 50);
  EXPECT_GT(seen, 0.9 * facing);
}

TEST_P(InfraredWorld, TheSameSeedGivesTheSameBits) {
  World world = *load_world(GetParam());
  const auto first = [&](std::uint64_t seed) {
    SimOptions options;
    options.seed = seed;
    return (*make_infrared_source(world, options)->next())->color;
  };
  const cv::Mat once = first(7);
  EXPECT_EQ(once.type(), CV_8UC1);
  EXPECT_EQ(once.size(), cv::Size(752, 480));
  EXPECT_EQ(cv::norm(once, first(7), cv::NORM_INF), 0);
  const double other = cv::norm(once, first(8), cv::NORM_INF);
  EXPECT_GT(other, 0);
}

INSTANTIATE_TEST_SUITE_P(Worlds, InfraredWorld,
                         testing::Values("ir-glove", "ir-bracelet", "ir-bracelet-far"),
                         [](const auto& one) {
                           std::string name = one.param;
                           std::erase(name, '-');
                           return name;
                         });

// Two sensors of one world, opened apart: at the same time the depth camera sees the hand where the
// infra-red truth has it.
TEST(InfraredRig, SensorsOfOneWorldAgree) {
  const auto depth =
      open_source(*parse_source_spec("sim:ir-glove,sensor=main,noise=none,near=0,rate=3,frames=12"),
                  {}, sim_source_kinds());
  ASSERT_TRUE(depth.ok()) << depth.error().message();
  const auto& shots = shots_of("ir-glove");
  int checked = 0;
  for (std::size_t i = 0; i < 12; ++i) {
    const FramePtr frame = *(*depth)->next();
    ASSERT_EQ(frame->time, shots[i].frame->time);
    EXPECT_EQ(frame->truth->hands[0].world_from_joint[0].matrix(),
              shots[i].frame->truth->hands[0].world_from_joint[0].matrix());
    for (const MarkerTruth& marker : shots[i].truth.markers) {
      if (marker.name != "square") continue;
      const Pose camera_from_world = frame->world_from_camera->inverse();
      const Eigen::Vector3d point = camera_from_world * marker.centre_in_world;
      const auto side = [&](std::size_t a, std::size_t b) -> Eigen::Vector3d {
        return marker.corners_in_world[b] - marker.corners_in_world[a];
      };
      const Eigen::Vector3d normal = camera_from_world.rotation() * side(0, 1).cross(side(1, 2));
      if (normal.normalized().dot(-point.normalized()) < 0.5) continue;  // seen too flat
      const auto pixel = project(frame->sensor->camera(), point);
      const float measured = frame->depth.at<float>(static_cast<int>(std::lround(pixel->y())),
                                                    static_cast<int>(std::lround(pixel->x())));
      // The plate lies over the highest knuckle; the back of the hand falls away below it.
      EXPECT_NEAR(static_cast<double>(measured), point.z(), 0.02) << i;
      ++checked;
    }
  }
  EXPECT_GT(checked, 4);
}

TEST(InfraredRig, RefusesWhatItDoesNotHave) {
  const auto open = [](const std::string& text) {
    return open_source(*parse_source_spec(text), {}, sim_source_kinds());
  };
  EXPECT_FALSE(open("sim:bench,sensor=ir").ok());
  EXPECT_FALSE(open("sim:ir-glove,sensor=left").ok());
  EXPECT_FALSE(open("sim:ir-glove,width=320").ok());
  EXPECT_TRUE(open("sim:ir-glove,noise=none").ok());
}

TEST(InfraredTruth, IsWrittenAsJson) {
  const auto& shots = shots_of("ir-glove");
  const nlohmann::json json = json_from_truth(shots.front().truth);
  EXPECT_EQ(json["markers"].size(), shots.front().truth.markers.size());
  EXPECT_TRUE(json["camera_from_square"].contains("rotation"));
  EXPECT_EQ(json["markers"][0]["name"], "bracelet 0");
  EXPECT_EQ(json["markers"].back()["corners"].size(), 0U);
}

}  // namespace
}  // namespace armsreach::sim
