// An inserted object stands still on what it was put on: corners of the table around its foot,
// followed in the raw video by optical flow, stay where their first place in 3D is projected.
#include <cmath>
#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>

#include "devices/open.hpp"
#include "tests/support/program.hpp"
#include "tests/support/recordings.hpp"
#include "vision/core/trajectory.hpp"

namespace armsreach::test {
namespace {

using nlohmann::json;

constexpr double kFootRadius = 0.10;  // m around the object's foot
constexpr int kCorners = 20;

struct View {
  Camera camera;
  Pose world_from_camera;
  cv::Mat grey;
};

struct Followed {
  Eigen::Vector3d point_in_world;
  cv::Point2f pixel;
};

Pose pose_from_json(const json& j) {
  const auto& t = j["translation"];
  const auto& q = j["rotation"];
  return {Eigen::Quaterniond(q[3].get<double>(), q[0].get<double>(), q[1].get<double>(),
                             q[2].get<double>()),
          {t[0].get<double>(), t[1].get<double>(), t[2].get<double>()}};
}

// The insertion of a run's events: when, and where it stands.
std::pair<Timestamp, Pose> insertion(const std::filesystem::path& events) {
  std::ifstream in(events);
  for (std::string line; std::getline(in, line);) {
    const json event = json::parse(line);
    if (event["type"] == "insert") {
      return {timestamp_from_seconds(event["t"].get<double>()),
              pose_from_json(event["world_from_object"])};
    }
  }
  ADD_FAILURE() << "nothing was inserted:\n" << read_text(events);
  return {};
}

std::vector<View> views(const std::string& source_text, const Trajectory& trajectory) {
  auto spec = parse_source_spec(source_text);
  auto source = open_source(*spec, {});
  const SensorInfo& sensor = *(*source)->sensor();
  std::vector<View> all;
  for (auto frame = (*source)->next(); frame.ok() && *frame; frame = (*source)->next()) {
    View view;
    view.camera = *sensor.color_camera;
    for (const TimedPose& pose : trajectory) {
      if (std::abs(pose.time - (*frame)->time) < 5'000'000) {
        view.world_from_camera = pose.world_from_camera * sensor.color_from_depth.inverse();
      }
    }
    cv::cvtColor((*frame)->color, view.grey, cv::COLOR_BGR2GRAY);
    all.push_back(view);
  }
  return all;
}

// Corners of the image whose rays meet the object's ground plane close to its foot.
std::vector<Followed> corners_around(const View& view, const Pose& world_from_object) {
  std::vector<cv::Point2f> corners;
  cv::goodFeaturesToTrack(view.grey, corners, 3000, 0.001, 3);
  const Pose object_from_camera = world_from_object.inverse() * view.world_from_camera;
  std::vector<Followed> around;
  for (const cv::Point2f& corner : corners) {
    const Eigen::Vector3d ray =
        object_from_camera.rotation() * unproject(view.camera, Eigen::Vector2d(corner.x, corner.y));
    const Eigen::Vector3d& from = object_from_camera.translation();
    const Eigen::Vector3d foot = from - (from.z() / ray.z()) * ray;
    if (foot.head<2>().norm() > kFootRadius) continue;
    around.push_back({world_from_object * foot, corner});
    if (static_cast<int>(around.size()) == kCorners) break;
  }
  return around;
}

// Follows the corners into the next image; those that do not return to where they came from by
// half a pixel are given up.
void follow(const View& from, const View& to, std::vector<Followed>* corners) {
  std::vector<cv::Point2f> before;
  for (const Followed& corner : *corners) before.push_back(corner.pixel);
  if (before.empty()) return;
  std::vector<cv::Point2f> after;
  std::vector<cv::Point2f> back;
  std::vector<uchar> found;
  std::vector<uchar> found_back;
  cv::calcOpticalFlowPyrLK(from.grey, to.grey, before, after, found, cv::noArray());
  cv::calcOpticalFlowPyrLK(to.grey, from.grey, after, back, found_back, cv::noArray());
  std::vector<Followed> kept;
  for (size_t i = 0; i < before.size(); ++i) {
    const bool inside = after[i].x > 8 && after[i].y > 8 &&
                        after[i].x < static_cast<float>(to.grey.cols - 8) &&
                        after[i].y < static_cast<float>(to.grey.rows - 8);
    if (!found[i] || !found_back[i] || !inside || cv::norm(back[i] - before[i]) > 0.5) continue;
    kept.push_back({(*corners)[i].point_in_world, after[i]});
  }
  *corners = kept;
}

struct Deviation {
  double rms = 0;  // px
  int samples = 0;
};

Deviation deviation(const std::string& source, const std::string& click) {
  TemporaryFolder folder;
  write_text(folder / "config.yaml",
             "actions: [{frame: 15, click: " + click + ", view: live, insert: teapot}]\n");
  const ProgramResult run = run_armsreach(
      {"run", "--source", source, "--pace", "every-frame", "--display", "none", "--config",
       folder / "config.yaml", "--trajectory", folder / "t.txt", "--events", folder / "e.jsonl"});
  EXPECT_EQ(run.exit_code, 0) << run.output;
  const auto [time, world_from_object] = insertion(folder / "e.jsonl");
  std::ifstream in(folder / "t.txt");
  const auto trajectory = read_tum_trajectory(in, "t.txt");
  const std::vector<View> all = views(source, *trajectory);
  const size_t first = static_cast<size_t>(std::lround(seconds_from_timestamp(time) * 30));

  std::vector<Followed> corners = corners_around(all[first], world_from_object);
  EXPECT_EQ(corners.size(), static_cast<size_t>(kCorners));
  Deviation result;
  double sum2 = 0;
  for (size_t i = first + 1; i < all.size(); ++i) {
    follow(all[i - 1], all[i], &corners);
    for (const Followed& corner : corners) {
      const auto pixel =
          project(all[i].camera, all[i].world_from_camera.inverse() * corner.point_in_world);
      if (!pixel) continue;
      sum2 += (*pixel - Eigen::Vector2d(corner.pixel.x, corner.pixel.y)).squaredNorm();
      ++result.samples;
    }
  }
  result.rms = std::sqrt(sum2 / std::max(result.samples, 1));
  std::printf("corners deviate by %.2f px rms over %d samples\n", result.rms, result.samples);
  return result;
}

TEST(EndToEndStanding, TheTeapotStandsOnTheKitchenTable) {
  ARMSREACH_RECORDING_OR_SKIP(path, "rgbd/redkitchen");
  // Beside the papers, where the table has corners to follow.
  const Deviation d = deviation("tum:" + path.string(), "[420, 215]");
  EXPECT_GT(d.samples, 500);
  EXPECT_LT(d.rms, 3.0);
}

TEST(EndToEndStanding, TheTeapotStandsOnTheLivingroomFloor) {
  ARMSREACH_RECORDING_OR_SKIP(path, "rgbd/livingroom");
  // A glossy floor: its corners are partly reflections and slide (at [420, 400] by 2.2 px rms even
  // under the true poses), and beside the chair's legs what is followed is not the floor at all.
  // The spot is one where it is.
  const Deviation d = deviation("tum:" + path.string(), "[440, 430]");
  EXPECT_GT(d.samples, 500);
  EXPECT_LT(d.rms, 2.0);
}

}  // namespace
}  // namespace armsreach::test
