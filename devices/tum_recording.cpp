#include "devices/tum_recording.hpp"

#include <algorithm>
#include <fstream>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "devices/calibration.hpp"
#include "devices/files.hpp"
#include "devices/image_file.hpp"
#include "devices/recorded_truth.hpp"
#include "devices/tum_lists.hpp"
#include "vision/core/trajectory.hpp"

namespace armsreach {
namespace {

namespace fs = std::filesystem;

// Truth is interpolated across at most this; motion capture comes at 100 Hz and more.
constexpr Timestamp kLongestGap = 100'000'000;  // ns
// Else the nearest pose counts when it is this near.
constexpr Timestamp kNearestTolerance = 20'000'000;  // ns

struct Lists {
  std::vector<ListedFrame> frames;
  Events events;
};

struct TruePoses {
  Trajectory world_from_listed;
  Pose listed_from_camera;  // the listed poses are the depth camera's
};

class TumRecording : public Recording {
 public:
  TumRecording(const fs::path& folder, Lists lists, TruePoses poses, RecordedTruth truth,
               SensorInfo sensor)
      : folder_(folder),
        frames_(std::move(lists.frames)),
        events_(std::move(lists.events)),
        poses_(std::move(poses)),
        truth_(std::move(truth)),
        sensor_(std::make_shared<const SensorInfo>(std::move(sensor))) {}

  const std::shared_ptr<const SensorInfo>& sensor() const override { return sensor_; }
  std::optional<std::int64_t> size() const override {
    return static_cast<std::int64_t>(frames_.size());
  }
  Timestamp time(std::int64_t index) const override {
    return frames_[static_cast<std::size_t>(index)].time();
  }
  Events take_events() override { return std::exchange(events_, {}); }

  Result<std::optional<Frame>> read(std::int64_t index) override {
    if (index >= *size()) return std::optional<Frame>();
    const ListedFrame& listed = frames_[static_cast<std::size_t>(index)];
    Frame frame;
    frame.index = index;
    frame.time = listed.time();
    frame.sensor = sensor_;
    frame.world_from_camera = pose_at(frame.time);
    auto truth = truth_.at(frame.time, sensor_->camera().depth_units_per_metre);
    if (!truth) return std::move(truth).error();
    frame.truth = std::move(*truth);
    if (frame.truth) frame.world_from_camera = frame.truth->world_from_camera;
    if (!listed.color.file.empty()) {
      const fs::path file = folder_ / listed.color.file;
      auto color = read_color_image(file);
      if (!color) return std::move(color).error();
      const auto fits = check_size(color->size(), *sensor_->color_camera, "colour", file);
      if (!fits) return fits.error();
      frame.color = *color;
    }
    if (!listed.depth.file.empty()) {
      const fs::path file = folder_ / listed.depth.file;
      auto depth = read_depth_image(file, sensor_->depth_camera->depth_units_per_metre);
      if (!depth) return std::move(depth).error();
      const auto fits = check_size(depth->size(), *sensor_->depth_camera, "depth", file);
      if (!fits) return fits.error();
      frame.depth = *depth;
    }
    return std::optional<Frame>(std::move(frame));
  }

 private:
  std::optional<Pose> pose_at(Timestamp time) const {
    const Trajectory& poses = poses_.world_from_listed;
    const auto after =
        std::lower_bound(poses.begin(), poses.end(), time,
                         [](const TimedPose& pose, Timestamp t) { return pose.time < t; });
    const auto before = after == poses.begin() ? after : after - 1;
    if (after != poses.end() && before != after && after->time - before->time <= kLongestGap) {
      const double fraction = static_cast<double>(time - before->time) /
                              static_cast<double>(after->time - before->time);
      return interpolate(before->world_from_camera, after->world_from_camera, fraction) *
             poses_.listed_from_camera;
    }
    for (const auto& candidate : {after, before}) {
      if (candidate == poses.end() || std::abs(candidate->time - time) > kNearestTolerance)
        continue;
      return candidate->world_from_camera * poses_.listed_from_camera;
    }
    return std::nullopt;
  }

  fs::path folder_;
  std::vector<ListedFrame> frames_;
  Events events_;
  TruePoses poses_;
  RecordedTruth truth_;
  std::shared_ptr<const SensorInfo> sensor_;
};

// Absent lists are empty.
Result<std::vector<ListedFile>> read_list(const fs::path& file) {
  if (!file_exists(file)) return std::vector<ListedFile>();
  std::ifstream in(file);
  return read_tum_list(in, file.string());
}

Result<Lists> read_pairs_by_time(const fs::path& folder) {
  auto color = read_list(folder / "rgb.txt");
  if (!color) return std::move(color).error();
  auto depth = read_list(folder / "depth.txt");
  if (!depth) return std::move(depth).error();
  if (color->empty() && depth->empty()) {
    return Error{"not a TUM recording: rgb.txt and depth.txt are missing", folder.string(),
                 "give the folder that holds them; for a folder of images use images:DIR"};
  }
  Lists lists;
  if (depth->empty()) {
    for (ListedFile& file : *color) lists.frames.push_back({std::move(file), {}});
    return lists;
  }
  if (color->empty()) {
    for (ListedFile& file : *depth) lists.frames.push_back({{}, std::move(file)});
    return lists;
  }
  lists.frames = associate(*color, *depth);
  if (lists.frames.empty()) {
    return Error{"no colour and depth image are within 20 ms of each other", folder.string(),
                 "correct the times in rgb.txt and depth.txt, or write associations.txt"};
  }
  if (const std::size_t alone = depth->size() - lists.frames.size(); alone > 0) {
    FaultEvent fault{"tum:" + folder.string(),
                     std::to_string(alone) + " of " + std::to_string(depth->size()) +
                         " depth images have no colour image within 20 ms and are left out",
                     "write associations.txt to pair them by hand"};
    lists.events.push_back({lists.frames.front().time(), std::move(fault)});
  }
  return lists;
}

Result<Lists> read_lists(const fs::path& folder) {
  const fs::path associations = folder / "associations.txt";
  if (!file_exists(associations)) return read_pairs_by_time(folder);
  std::ifstream in(associations);
  auto frames = read_tum_associations(in, associations.string());
  if (!frames) return std::move(frames).error();
  return Lists{std::move(*frames), {}};
}

// A list is data from elsewhere: it may name files of its own recording and no others. Links in the
// folder were made by whoever keeps it and are followed.
Status check_inside(const ListedFile& listed) {
  if (stays_inside(listed.file)) return ok();
  return Error{"'" + listed.file + "' leaves the recording's folder", listed.line,
               "list files below the folder, by relative paths"};
}

Status check_all_inside(const std::vector<ListedFrame>& frames) {
  for (const ListedFrame& frame : frames) {
    for (const ListedFile* listed : {&frame.color, &frame.depth}) {
      if (auto inside = check_inside(*listed); !inside) return inside;
    }
  }
  return ok();
}

struct Cameras {
  std::optional<CameraFile> main;   // camera.yaml
  std::optional<CameraFile> color;  // camera_color.yaml
};

Result<Cameras> read_cameras(const fs::path& folder, const OpenOptions& options) {
  Cameras cameras;
  if (options.camera) {
    (options.camera->camera_from_depth ? cameras.color : cameras.main) = options.camera;
  }
  if (!cameras.color && file_exists(folder / "camera_color.yaml")) {
    auto file = read_camera_file(folder / "camera_color.yaml");
    if (!file) return std::move(file).error();
    if (!file->camera_from_depth) {
      return Error{"entry 'camera_from_depth' is missing", (folder / "camera_color.yaml").string(),
                   "add camera_from_depth: {rotation_vector: [0, 0, 0], translation: [0, 0, 0]} "
                   "with the colour camera's pose, or remove the file of registered images"};
    }
    cameras.color = std::move(*file);
  }
  if (!cameras.main) {
    auto file = read_camera_file(folder / "camera.yaml");
    if (!file) return std::move(file).error();
    cameras.main = std::move(*file);
  }
  return cameras;
}

double mean_rate(const std::vector<ListedFrame>& frames) {
  if (frames.size() < 2) return SensorInfo().rate;
  const Timestamp span = frames.back().time() - frames.front().time();
  return static_cast<double>(frames.size() - 1) / seconds_from_timestamp(span);
}

bool same_lens(const Camera& a, const Camera& b) {
  return a.width == b.width && a.height == b.height && a.fx == b.fx && a.fy == b.fy &&
         a.cx == b.cx && a.cy == b.cy && a.distortion == b.distortion &&
         a.coefficients == b.coefficients;
}

SensorInfo sensor_of(const std::vector<ListedFrame>& frames, const Cameras& cameras) {
  SensorInfo sensor;
  sensor.rate = mean_rate(frames);
  if (!frames.front().depth.file.empty()) sensor.depth_camera = cameras.main->camera;
  if (!frames.front().color.file.empty()) {
    sensor.color_camera = (cameras.color ? cameras.color : cameras.main)->camera;
  }
  if (cameras.color && sensor.color_camera && sensor.depth_camera) {
    sensor.color_from_depth = *cameras.color->camera_from_depth;
    // The driver's registration, written down: both pictures are one camera's.
    sensor.registered = sensor.color_from_depth.log().norm() == 0 &&
                        same_lens(*sensor.color_camera, *sensor.depth_camera);
  }
  sensor.registration_stated = cameras.color || !sensor.color_camera || !sensor.depth_camera;
  return sensor;
}

Result<TruePoses> read_poses(const fs::path& folder, const SensorInfo& sensor,
                             const Cameras& cameras) {
  TruePoses poses;
  // Without depth "camera" means the colour camera, while the file tells of the depth camera.
  if (!sensor.depth_camera && cameras.color) {
    poses.listed_from_camera = cameras.color->camera_from_depth->inverse();
  }
  const fs::path file = folder / "groundtruth.txt";
  if (!file_exists(file)) return poses;
  std::ifstream in(file);
  auto trajectory = read_tum_trajectory(in, file.string());
  if (!trajectory) return std::move(trajectory).error();
  poses.world_from_listed = std::move(*trajectory);
  return poses;
}

}  // namespace

Result<std::unique_ptr<Recording>> open_tum_recording(const fs::path& folder,
                                                      const OpenOptions& options) {
  if (!folder_exists(folder)) {
    return Error{"no such folder", folder.string(), "give the folder of a TUM recording"};
  }
  auto lists = read_lists(folder);
  if (!lists) return std::move(lists).error();
  if (auto inside = check_all_inside(lists->frames); !inside) return inside.error();
  auto cameras = read_cameras(folder, options);
  if (!cameras) return std::move(cameras).error();
  SensorInfo sensor = sensor_of(lists->frames, *cameras);
  sensor.name = options.sensor;
  auto poses = read_poses(folder, sensor, *cameras);
  if (!poses) return std::move(poses).error();
  auto truth = RecordedTruth::open(folder);
  if (!truth) return std::move(truth).error();
  return std::make_unique<TumRecording>(folder, std::move(*lists), std::move(*poses),
                                        std::move(*truth), std::move(sensor));
}

}  // namespace armsreach
