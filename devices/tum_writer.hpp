// Writes a sensor's frames as a recording that `tum:DIR` plays (tum_recording.hpp): images without
// loss, depth in the camera's own units, and where the source knows it, the truth. Every list is
// complete after each frame, so that a recording that is broken off is a shorter recording.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include "devices/gimbal.hpp"
#include "vision/core/frame.hpp"
#include "vision/core/result.hpp"

namespace armsreach {

class TumWriter {
 public:
  // `folder` is made; it may not hold anything yet.
  explicit TumWriter(std::filesystem::path folder) : folder_(std::move(folder)) {}

  Status begin(const SensorInfo& sensor);
  Status write(const Frame& frame);
  // What the gimbal was told and where it was at the frame's time.
  Status write_gimbal(Gimbal& gimbal, Timestamp time);

 private:
  // A text file that appears with its first line.
  struct List {
    const char* name;
    const char* head;
    std::ofstream stream{};
  };
  Status append(List& list, const std::string& text);
  Status write_image(const std::string& file, const cv::Mat& image);
  Status write_camera(const char* name, const Camera& camera, const Pose* camera_from_depth);
  Status write_truth(const Frame& frame, const std::string& stem, double units_per_metre);

  std::filesystem::path folder_;
  List color_{"rgb.txt", "# time file\n"};
  List depth_{"depth.txt", "# time file\n"};
  List pairs_{"associations.txt", "# time colour time depth\n"};
  List poses_{"groundtruth.txt", "# time tx ty tz qx qy qz qw, world from camera\n"};
  List gimbal_{"gimbal.txt", "# time pan tilt roll pan-rate tilt-rate roll-rate\n"};
  List commands_{"commands.jsonl", ""};
  List truth_{"truth.jsonl", ""};
};

}  // namespace armsreach
