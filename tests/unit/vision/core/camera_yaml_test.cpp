#include "vision/core/camera_yaml.hpp"

#include <sstream>

#include <gtest/gtest.h>

namespace armsreach {
namespace {

constexpr const char* kGood =
    "image_width: 640\nimage_height: 480\ncamera_name: kinect\n"
    "camera_matrix:\n  rows: 3\n  cols: 3\n  data: [585.0, 0, 320, 0, 584, 240, 0, 0, 1]\n"
    "distortion_model: plumb_bob\ndistortion_coefficients: {rows: 1, cols: 5, data: [0.1, 0, 0, 0, "
    "0]}\n"
    "depth_units_per_metre: 5000\n";

Result<CameraFile> read(const std::string& text) {
  std::istringstream in(text);
  return read_camera_yaml(in, "camera.yaml");
}

std::string with(const std::string& from, const std::string& to) {
  std::string text = kGood;
  text.replace(text.find(from), from.size(), to);
  return text;
}

TEST(CameraYaml, ReadsWhatRosWrites) {
  const auto file = read(kGood);
  ASSERT_TRUE(file) << file.error().message();
  EXPECT_EQ(file->camera.fy, 584);
  EXPECT_EQ(file->camera.coefficients[0], 0.1);
  EXPECT_EQ(file->camera.depth_units_per_metre, 5000);
  EXPECT_FALSE(file->camera_from_depth);
}

TEST(CameraYaml, WritesWhatItReads) {
  auto file =
      read(std::string(kGood) +
           "camera_from_depth: {rotation_vector: [0, 0.1, 0.0075], translation: [-0.02, 0, 0]}");
  ASSERT_TRUE(file);
  std::stringstream stream;
  write_camera_yaml(stream, *file);
  const auto again = read_camera_yaml(stream, "again");
  ASSERT_TRUE(again) << again.error().message();
  EXPECT_EQ(again->camera.fx, file->camera.fx);
  EXPECT_EQ(again->camera.coefficients, file->camera.coefficients);
  EXPECT_LT((again->camera_from_depth->matrix() - file->camera_from_depth->matrix()).norm(), 1e-12);
}

TEST(CameraYaml, NamesTheEntryThatIsWrong) {
  const std::vector<std::pair<std::string, std::string>> broken = {
      {with("image_width: 640\n", ""), "image_width"},
      {with("640", "-640"), "image_width"},
      {with("480", "tall"), "image_height"},
      {with("585.0", ".nan"), "camera_matrix"},
      {with("585.0", "-585"), "focal length"},
      {with("585.0, 0,", "585.0,"), "camera_matrix"},
      {with("plumb_bob", "plum"), "plum"},
      {with("5000", "0"), "depth_units_per_metre"},
      {with("5000", ".inf"), "depth_units_per_metre"},
      {"just text", "not a camera file"},
      {"a: [1, 2", "YAML"},
      {"", "not a camera file"},
  };
  for (const auto& [text, expected] : broken) {
    const auto file = read(text);
    ASSERT_FALSE(file) << text;
    EXPECT_NE(file.error().message().find(expected), std::string::npos) << file.error().message();
    EXPECT_FALSE(file.error().remedy.empty());
    EXPECT_EQ(file.error().where.rfind("camera.yaml", 0), 0U);
  }
}

}  // namespace
}  // namespace armsreach
