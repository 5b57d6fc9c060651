// A small TUM recording in a temporary folder, for tests to break.
#pragma once

#include <filesystem>
#include <string>

#include <opencv2/core/mat.hpp>

#include "tests/support/program.hpp"
#include "vision/core/time.hpp"

namespace armsreach::test {

class RecordedFolder : public TemporaryFolder {
 public:
  void write(const std::string& name, const std::string& text) const;
  std::string read(const std::string& name) const;
  void replace(const std::string& name, const std::string& from, const std::string& to) const;
  void remove(const std::string& name) const { std::filesystem::remove(path() / name); }
  // Cuts a file's end off.
  void truncate(const std::string& name, double kept_fraction) const;
};

// 32x24 pixels, three frames at 0, 0.1 and 0.2 s in rgb/N.png and depth/N.png with rgb.txt,
// depth.txt, camera.yaml (5000 units a metre) and groundtruth.txt.
constexpr int kWidth = 32;
constexpr int kHeight = 24;
constexpr Timestamp kStep = 100'000'000;  // ns
void write_small_recording(const RecordedFolder& folder);

std::string camera_yaml(int width, int height);
// A textured image, so that a cut-off file is cut within its pixels.
cv::Mat color_image(int width, int height, int seed);

}  // namespace armsreach::test
