#include "vision/core/camera_yaml.hpp"

#include <cmath>
#include <limits>
#include <vector>

#include "vision/core/yaml_map.hpp"

namespace armsreach {
namespace {

constexpr int kLargestImageSide = 32768;

int side_from(YamlMap& map, const std::string& key) {
  const double value = map.number(key, 1, kLargestImageSide);
  if (value != std::floor(value)) throw map.complaint(key, "is not an image side in pixels");
  return static_cast<int>(value);
}

// A plain list, or a matrix with a `data` list.
std::vector<double> list_from(YamlMap& map, const std::string& key) {
  const YAML::Node node = map.need(key);
  return numbers_from(node.IsMap() ? YamlMap(node, key).need("data") : node, key);
}

void read_intrinsics(YamlMap& map, Camera* camera) {
  const int width = side_from(map, "image_width");
  const int height = side_from(map, "image_height");
  const std::vector<double> k = list_from(map, "camera_matrix");
  if (k.size() != 9) throw map.complaint("camera_matrix", "has not 9 numbers");
  if (k[0] <= 0 || k[4] <= 0)
    throw map.complaint("camera_matrix", "has a focal length that is not positive");
  if (k[1] != 0) throw map.complaint("camera_matrix", "has skew, which no model here has");
  *camera = pinhole(width, height, k[0], k[4], k[2], k[5]);
}

Distortion distortion_from(YamlMap& map) {
  const std::string model = map.text("distortion_model");
  for (const Distortion d : {Distortion::plumb_bob, Distortion::rational_polynomial,
                             Distortion::fisheye, Distortion::monoslam}) {
    if (model == name(d)) return d;
  }
  if (model == "equidistant") return Distortion::fisheye;  // as ROS calls it
  throw map.complaint(
      "distortion_model",
      "is '" + model + "', none of plumb_bob, rational_polynomial, fisheye, monoslam");
}

void read_distortion(YamlMap& map, Camera* camera) {
  if (!map.find("distortion_model")) return;  // a plain pinhole
  camera->distortion = distortion_from(map);
  const std::vector<double> coefficients = list_from(map, "distortion_coefficients");
  if (static_cast<int>(coefficients.size()) > coefficient_count(camera->distortion))
    throw map.complaint("distortion_coefficients", "has more numbers than its model takes");
  std::copy(coefficients.begin(), coefficients.end(), camera->coefficients.begin());
}

Pose pose_from(YamlMap map) {
  return Pose(so3_exp(map.vector<3>("rotation_vector")), map.vector<3>("translation"));
}

CalibrationRecord calibration_from(YamlMap map) {
  CalibrationRecord record;
  record.date = map.text("date");
  record.rms = map.number("rms", 0, 1e6);  // px
  record.images = static_cast<int>(map.number("images", 0, 1e6));
  return record;
}

// Keys that are not known are other programs' business: the format is ROS's.
CameraFile file_from(const YAML::Node& root) {
  if (!root.IsMap()) throw YamlComplaint(root, "not a camera file");
  YamlMap map(root, "");
  CameraFile file;
  read_intrinsics(map, &file.camera);
  read_distortion(map, &file.camera);
  if (const YAML::Node name = map.find("camera_name"); name.IsScalar())
    file.camera.name = name.Scalar();
  double& units = file.camera.depth_units_per_metre;
  units = map.number("depth_units_per_metre", 0, 1e9, units);
  if (units <= 0) throw map.complaint("depth_units_per_metre", "is not positive");
  if (map.find("camera_from_depth"))
    file.camera_from_depth = pose_from(map.section("camera_from_depth"));
  if (map.find("calibration")) file.calibration = calibration_from(map.section("calibration"));
  return file;
}

}  // namespace

Result<CameraFile> read_camera_yaml(std::istream& in, const std::string& where) {
  return read_yaml(in, where,
                   "camera files have image_width, image_height, camera_matrix {data: 9 numbers}, "
                   "distortion_model and distortion_coefficients {data: [...]}",
                   file_from);
}

void write_camera_yaml(std::ostream& out, const CameraFile& file) {
  const Camera& c = file.camera;
  const auto precision = out.precision(std::numeric_limits<double>::max_digits10);
  out << "image_width: " << c.width << "\nimage_height: " << c.height
      << "\ncamera_name: " << (c.name.empty() ? "camera" : c.name)
      << "\ncamera_matrix:\n  rows: 3\n  cols: 3\n  data: [" << c.fx << ", 0, " << c.cx << ", 0, "
      << c.fy << ", " << c.cy << ", 0, 0, 1]\n"
      << "distortion_model: " << name(c.distortion) << "\ndistortion_coefficients:\n  rows: 1\n"
      << "  cols: " << coefficient_count(c.distortion) << "\n  data: [";
  for (int i = 0; i < coefficient_count(c.distortion); ++i) {
    out << (i ? ", " : "") << c.coefficients[static_cast<size_t>(i)];
  }
  out << "]\ndepth_units_per_metre: " << c.depth_units_per_metre << "\n";
  if (file.camera_from_depth) {
    const Eigen::Vector3d r = so3_log(file.camera_from_depth->rotation());
    const Eigen::Vector3d& t = file.camera_from_depth->translation();
    out << "camera_from_depth: {rotation_vector: [" << r.x() << ", " << r.y() << ", " << r.z()
        << "], translation: [" << t.x() << ", " << t.y() << ", " << t.z() << "]}\n";
  }
  if (file.calibration) {
    out << "calibration: {date: " << file.calibration->date << ", rms: " << file.calibration->rms
        << ", images: " << file.calibration->images << "}\n";
  }
  out.precision(precision);
}

}  // namespace armsreach
