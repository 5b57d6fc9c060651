#include "tests/unit/vision/mono_slam/mono_recording.hpp"

#include <algorithm>
#include <fstream>
#include <iomanip>
#include <limits>
#include <sstream>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "vision/core/camera_yaml.hpp"
#include "vision/core/registration.hpp"
#include "vision/mono_slam/target_yaml.hpp"

namespace armsreach::mono_slam::test {
namespace {

CameraFile read_camera(const std::filesystem::path& path) {
  std::ifstream in(path);
  return read_camera_yaml(in, path.string()).value();
}

cv::Mat metres(const cv::Mat& image, double units) {
  cv::Mat out;
  image.convertTo(out, CV_32F, 1 / units);
  out.setTo(std::numeric_limits<float>::quiet_NaN(), image == 0);
  return out;
}

}  // namespace

MonoRecording read_desk(const std::filesystem::path& folder) {
  MonoRecording out;
  out.camera = read_camera(folder / "camera.yaml").camera;
  std::ifstream in(folder / "target.yaml");
  const TargetFile file = read_target_yaml(in, "target.yaml").value();
  out.target.emplace();
  for (const TargetFile::Mark& mark : file.marks) {
    out.target->marks.push_back(
        {cv::imread((folder / mark.patch).string(), cv::IMREAD_GRAYSCALE), mark.point_in_world});
  }
  std::vector<std::filesystem::path> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder / "frames")) {
    names.push_back(entry.path());
  }
  std::sort(names.begin(), names.end());
  for (const auto& name : names) {
    out.frames.push_back(cv::imread(name.string(), cv::IMREAD_GRAYSCALE));
  }
  return out;
}

MonoRecording read_rgbd(const std::filesystem::path& folder, std::size_t frames) {
  MonoRecording out;
  const CameraFile color = read_camera(folder / "camera_color.yaml");
  const Camera depth_camera = read_camera(folder / "camera.yaml").camera;
  out.camera = resized(color.camera, 320, 240);
  std::ifstream list(folder / "associations.txt");
  std::string line;
  while (out.frames.size() < frames && std::getline(list, line)) {
    std::istringstream words(line);
    std::string time, rgb, depth_time, depth;
    if (!(words >> time >> rgb >> depth_time >> depth) || time[0] == '#') continue;
    const cv::Mat grey = cv::imread((folder / rgb).string(), cv::IMREAD_GRAYSCALE);
    cv::Mat small;
    cv::resize(grey, small, cv::Size(320, 240), 0, 0, cv::INTER_AREA);
    out.frames.push_back(small);
    if (!out.first_depth.empty()) continue;
    const cv::Mat image = cv::imread((folder / depth).string(), cv::IMREAD_UNCHANGED);
    out.first_depth = registered_depth(metres(image, depth_camera.depth_units_per_metre),
                                       depth_camera, out.camera, *color.camera_from_depth);
  }
  std::ifstream truth(folder / "groundtruth.txt");
  out.truth = read_tum_trajectory(truth, "groundtruth.txt").value();
  for (TimedPose& pose : out.truth) {
    pose.world_from_camera = pose.world_from_camera * color.camera_from_depth->inverse();
  }
  out.truth.resize(std::min(out.truth.size(), frames));
  return out;
}

Summary run(const MonoRecording& recording, const MonoSlamOptions& options, const Edit& edit) {
  Summary out;
  MonoSlam slam(recording.camera, options);
  for (std::size_t i = 0; i < recording.frames.size(); ++i) {
    MonoInput input;
    input.time = recording.time(i);
    input.grey = recording.frames[i];
    if (i == 0) input.depth = recording.first_depth;
    if (edit && !edit(i, &input)) continue;
    out.results.push_back(slam.step(input));
    const MonoResult& result = out.results.back();
    if (result.state == TrackingState::lost) ++out.lost;
    if (result.state != TrackingState::tracking) continue;
    out.estimate.push_back({result.time, result.world_from_camera});
    for (const MapPoint& point : result.points) {
      if (point.outcome != Outcome::measured) continue;
      out.innovations.push_back(point.innovation.norm());
      out.residuals.push_back(point.residual);
    }
  }
  return out;
}

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::sort(values.begin(), values.end());
  const double at = share * static_cast<double>(values.size() - 1);
  return values[static_cast<std::size_t>(at)];
}

}  // namespace armsreach::mono_slam::test
