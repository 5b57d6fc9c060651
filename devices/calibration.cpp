#include "devices/calibration.hpp"

#include <cmath>
#include <fstream>
#include <numbers>

#include "devices/files.hpp"

namespace armsreach {

Result<CameraFile> read_camera_file(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) {
    return Error{"no camera file", file.string(),
                 "write it, or give another with --camera: image_width: 640, image_height: 480, "
                 "camera_matrix: {data: [fx, 0, cx, 0, fy, cy, 0, 0, 1]}, distortion_model: "
                 "plumb_bob, distortion_coefficients: {data: [0, 0, 0, 0, 0]} and, of depth "
                 "images, depth_units_per_metre: 1000, an entry a line"};
  }
  return read_camera_yaml(in, file.string());
}

Camera guessed_camera(int width, int height) {
  const double focal_length = 0.5 * width / std::tan(0.5 * std::numbers::pi / 3);
  Camera camera =
      pinhole(width, height, focal_length, focal_length, 0.5 * (width - 1), 0.5 * (height - 1));
  camera.name = "guess";
  return camera;
}

Result<Calibration> calibration_or_guess(const OpenOptions& options,
                                         const std::filesystem::path& file, int width, int height,
                                         const std::string& component) {
  if (options.camera) return Calibration{options.camera->camera, {}};
  if (!file.empty() && file_exists(file)) {
    auto read = read_camera_file(file);
    if (!read) return std::move(read).error();
    return Calibration{read->camera, {}};
  }
  FaultEvent guess;
  guess.component = component;
  guess.message = "no calibration: assuming a pinhole camera with a horizontal field of 60 degrees";
  guess.remedy = file.empty() ? "give its camera file with --camera"
                              : "give its camera file with --camera, or as " + file.string();
  return Calibration{guessed_camera(width, height), {Event{0, guess}}};
}

}  // namespace armsreach
