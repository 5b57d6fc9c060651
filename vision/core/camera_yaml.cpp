#include "vision/core/camera_yaml.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <sstream>
#include <vector>

#include <yaml-cpp/yaml.h>

namespace armsreach {
namespace {

constexpr int kLargestImageSide = 32768;

// Reads entries of one file and turns every complaint into the same kind of error.
class Reader {
 public:
  Reader(const YAML::Node& root, const std::string& where) : root_(root), where_(where) {}

  Error error(const std::string& what) const {
    return {what, where_,
            "camera files have image_width, image_height, camera_matrix {data: 9 numbers}, "
            "distortion_model and distortion_coefficients {data: [...]}"};
  }

  Result<double> number(const std::string& key) const {
    const YAML::Node node = root_[key];
    if (!node) return error("entry '" + key + "' is missing");
    double value = 0;
    if (!YAML::convert<double>::decode(node, value) || !std::isfinite(value)) {
      return error("entry '" + key + "' is not a finite number");
    }
    return value;
  }

  Result<int> side(const std::string& key) const {
    auto value = number(key);
    if (!value) return value.error();
    if (*value < 1 || *value > kLargestImageSide || *value != std::floor(*value)) {
      return error("entry '" + key + "' is not an image side in pixels");
    }
    return static_cast<int>(*value);
  }

  // `node` is a plain list or a matrix with a `data` list.
  Result<std::vector<double>> list(const YAML::Node& node, const std::string& key) const {
    if (!node) return error("entry '" + key + "' is missing");
    const YAML::Node data = node.IsMap() ? node["data"] : node;
    if (!data || !data.IsSequence()) return error("entry '" + key + "' has no list of numbers");
    std::vector<double> values;
    for (const YAML::Node& item : data) {
      double value = 0;
      if (!YAML::convert<double>::decode(item, value) || !std::isfinite(value)) {
        return error("entry '" + key + "' holds something that is not a finite number");
      }
      values.push_back(value);
    }
    return values;
  }

 private:
  YAML::Node root_;
  std::string where_;
};

Status read_intrinsics(const YAML::Node& root, const Reader& reader, Camera* camera) {
  auto width = reader.side("image_width");
  if (!width) return width.error();
  auto height = reader.side("image_height");
  if (!height) return height.error();
  auto matrix = reader.list(root["camera_matrix"], "camera_matrix");
  if (!matrix) return matrix.error();
  if (matrix->size() != 9) return reader.error("camera_matrix has not 9 numbers");
  const std::vector<double>& k = *matrix;
  if (k[0] <= 0 || k[4] <= 0)
    return reader.error("camera_matrix has a focal length that is not positive");
  if (k[1] != 0) return reader.error("camera_matrix has skew, which no model here has");
  *camera = pinhole(*width, *height, k[0], k[4], k[2], k[5]);
  return ok();
}

Status read_distortion(const YAML::Node& root, const Reader& reader, Camera* camera) {
  const YAML::Node model = root["distortion_model"];
  if (!model) return ok();  // a plain pinhole
  if (!model.IsScalar()) return reader.error("distortion_model is not a name");
  bool known = false;
  for (const Distortion d : {Distortion::plumb_bob, Distortion::rational_polynomial,
                             Distortion::fisheye, Distortion::monoslam}) {
    if (model.Scalar() != name(d)) continue;
    camera->distortion = d;
    known = true;
  }
  if (model.Scalar() == "equidistant") {  // what ROS calls the fisheye
    camera->distortion = Distortion::fisheye;
    known = true;
  }
  if (!known) {
    return reader.error("distortion_model '" + model.Scalar() +
                        "' is none of plumb_bob, rational_polynomial, fisheye, monoslam");
  }
  auto coefficients = reader.list(root["distortion_coefficients"], "distortion_coefficients");
  if (!coefficients) return coefficients.error();
  if (static_cast<int>(coefficients->size()) > coefficient_count(camera->distortion)) {
    return reader.error("distortion_coefficients has more numbers than " + model.Scalar() +
                        " takes");
  }
  std::copy(coefficients->begin(), coefficients->end(), camera->coefficients.begin());
  return ok();
}

Result<std::optional<Pose>> read_camera_from_depth(const YAML::Node& root, const Reader& reader) {
  const YAML::Node node = root["camera_from_depth"];
  if (!node) return std::optional<Pose>();
  if (!node.IsMap()) return reader.error("camera_from_depth is not a map");
  auto rotation = reader.list(node["rotation_vector"], "camera_from_depth.rotation_vector");
  if (!rotation) return rotation.error();
  auto translation = reader.list(node["translation"], "camera_from_depth.translation");
  if (!translation) return translation.error();
  if (rotation->size() != 3 || translation->size() != 3) {
    return reader.error("camera_from_depth needs three numbers each");
  }
  return std::optional<Pose>(
      Pose(so3_exp(Eigen::Vector3d(rotation->data())), Eigen::Vector3d(translation->data())));
}

Result<std::optional<CalibrationRecord>> read_calibration(const YAML::Node& root,
                                                          const Reader& reader) {
  const YAML::Node node = root["calibration"];
  if (!node) return std::optional<CalibrationRecord>();
  CalibrationRecord record;
  const bool whole = node.IsMap() && node["date"] && node["date"].IsScalar() &&
                     YAML::convert<double>::decode(node["rms"], record.rms) &&
                     YAML::convert<int>::decode(node["images"], record.images);
  if (!whole || !std::isfinite(record.rms)) {
    return reader.error("calibration is not {date, rms, images}");
  }
  record.date = node["date"].Scalar();
  return std::optional<CalibrationRecord>(record);
}

Result<CameraFile> read_checked(const YAML::Node& root, const std::string& where) {
  const Reader reader(root, where);
  if (!root.IsMap()) return reader.error("not a camera file");
  CameraFile file;
  if (auto status = read_intrinsics(root, reader, &file.camera); !status) return status.error();
  if (auto status = read_distortion(root, reader, &file.camera); !status) return status.error();
  if (root["camera_name"] && root["camera_name"].IsScalar()) {
    file.camera.name = root["camera_name"].Scalar();
  }
  if (root["depth_units_per_metre"]) {
    auto units = reader.number("depth_units_per_metre");
    if (!units) return units.error();
    if (*units <= 0) return reader.error("depth_units_per_metre is not positive");
    file.camera.depth_units_per_metre = *units;
  }
  auto camera_from_depth = read_camera_from_depth(root, reader);
  if (!camera_from_depth) return camera_from_depth.error();
  file.camera_from_depth = *camera_from_depth;
  auto calibration = read_calibration(root, reader);
  if (!calibration) return calibration.error();
  file.calibration = *calibration;
  return file;
}

}  // namespace

Result<CameraFile> read_camera_yaml(std::istream& in, const std::string& where) {
  try {
    return read_checked(YAML::Load(in), where);
  } catch (const YAML::Exception& e) {
    return Error{"not readable as YAML: " + std::string(e.what()), where,
                 "see the README for an example camera file"};
  }
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
