#include "devices/tum_writer.hpp"

#include <cinttypes>
#include <cstdio>
#include <sstream>
#include <system_error>
#include <vector>

#include <opencv2/imgcodecs.hpp>

#include "devices/gimbal_lists.hpp"
#include "devices/image_file.hpp"
#include "devices/truth_json.hpp"
#include "vision/core/camera_yaml.hpp"
#include "vision/core/trajectory.hpp"

namespace armsreach {
namespace {

namespace fs = std::filesystem;

Error unwritten(const fs::path& file) {
  return {"could not be written completely", file.string(), "is the disk full?",
          Error::Kind::device};
}

Status make_folder(const fs::path& folder) {
  std::error_code failure;
  fs::create_directories(folder, failure);
  if (!failure) return ok();
  return Error{"the folder cannot be made: " + failure.message(), folder.string(),
               "give a folder that is yours"};
}

// Seconds with all nine digits, which read back as the same nanoseconds.
std::string time_text(Timestamp time) {
  const char* sign = time < 0 ? "-" : "";
  const std::int64_t ns = time < 0 ? -time : time;
  char text[40];
  std::snprintf(text, sizeof text, "%s%" PRId64 ".%09" PRId64, sign, ns / 1'000'000'000,
                ns % 1'000'000'000);
  return text;
}

// Padded, so that names sort by time.
std::string stem_of(Timestamp time) {
  constexpr std::size_t kLength = 20;  // ten digits of seconds: the clock of 1970 has as many
  const std::string text = time_text(time);
  return text.size() < kLength && time >= 0 ? std::string(kLength - text.size(), '0') + text : text;
}

}  // namespace

Status TumWriter::begin(const SensorInfo& sensor) {
  if (auto status = make_folder(folder_); !status) return status;
  if (auto status = write_camera("camera.yaml", sensor.camera(), nullptr); !status) return status;
  const bool two_cameras = sensor.color_camera && sensor.depth_camera;
  if (two_cameras && sensor.registration_stated) {
    const Pose color_from_depth = sensor.registered ? Pose() : sensor.color_from_depth;
    const auto status = write_camera("camera_color.yaml", *sensor.color_camera, &color_from_depth);
    if (!status) return status;
  }
  return ok();
}

Status TumWriter::write(const Frame& frame) {
  const std::string time = time_text(frame.time);
  const std::string stem = stem_of(frame.time);
  const std::string color = "rgb/" + stem + ".png";
  const std::string depth = "depth/" + stem + ".png";
  const double units = frame.sensor->camera().depth_units_per_metre;
  if (!frame.color.empty()) {
    if (auto status = write_image(color, frame.color); !status) return status;
    if (auto status = append(color_, time + " " + color + "\n"); !status) return status;
  }
  if (!frame.depth.empty()) {
    const cv::Mat whole = units_from_depth(frame.depth, units);
    if (auto status = write_image(depth, whole); !status) return status;
    if (auto status = append(depth_, time + " " + depth + "\n"); !status) return status;
  }
  if (!frame.color.empty() && !frame.depth.empty()) {
    const std::string pair = time + " " + color + " " + time + " " + depth + "\n";
    if (auto status = append(pairs_, pair); !status) return status;
  }
  if (frame.world_from_camera) {
    std::ostringstream pose;
    write_tum_pose(pose, {frame.time, *frame.world_from_camera});
    if (auto status = append(poses_, pose.str()); !status) return status;
  }
  return frame.truth ? write_truth(frame, stem, units) : ok();
}

Status TumWriter::write_truth(const Frame& frame, const std::string& stem, double units_per_metre) {
  TruthLine line{frame.time, *frame.truth, "", ""};
  if (!frame.truth->masks.empty()) {
    line.masks_file = "masks/" + stem + ".png";
    if (auto status = write_image(line.masks_file, frame.truth->masks); !status) return status;
  }
  if (!frame.truth->depth.empty()) {
    line.depth_file = "true_depth/" + stem + ".png";
    const cv::Mat whole = units_from_depth(frame.truth->depth, units_per_metre);
    if (auto status = write_image(line.depth_file, whole); !status) return status;
  }
  std::ostringstream text;
  write_truth_line(text, line);
  return append(truth_, text.str());
}

Status TumWriter::write_gimbal(Gimbal& gimbal, Timestamp time) {
  std::ostringstream commands;
  for (const GimbalCommand& command : gimbal.take_commands())
    write_gimbal_command(commands, command);
  if (!commands.str().empty()) {
    if (auto status = append(commands_, commands.str()); !status) return status;
  }
  const auto state = gimbal.state_at(time);
  if (!state) return ok();
  std::ostringstream line;
  write_gimbal_state(line, *state);
  return append(gimbal_, line.str());
}

Status TumWriter::append(List& list, const std::string& text) {
  const fs::path file = folder_ / list.name;
  if (!list.stream.is_open()) {
    list.stream.open(file, std::ios::binary);
    list.stream << list.head;
  }
  list.stream << text << std::flush;
  return list.stream ? ok() : Status(unwritten(file));
}

Status TumWriter::write_image(const std::string& file, const cv::Mat& image) {
  const fs::path path = folder_ / file;
  if (auto status = make_folder(path.parent_path()); !status) return status;
  // The fastest of PNG's levels: noise does not get much smaller with more work.
  std::vector<std::uint8_t> bytes;
  cv::imencode(".png", image, bytes, {cv::IMWRITE_PNG_COMPRESSION, 1});
  std::ofstream out(path, std::ios::binary);
  out.write(reinterpret_cast<const char*>(bytes.data()),
            static_cast<std::streamsize>(bytes.size()));
  out.close();
  return out ? ok() : Status(unwritten(path));
}

Status TumWriter::write_camera(const char* name, const Camera& camera,
                               const Pose* camera_from_depth) {
  CameraFile file{camera, {}};
  if (camera_from_depth) file.camera_from_depth = *camera_from_depth;
  std::ofstream out(folder_ / name, std::ios::binary);
  write_camera_yaml(out, file);
  out.close();
  return out ? ok() : Status(unwritten(folder_ / name));
}

}  // namespace armsreach
