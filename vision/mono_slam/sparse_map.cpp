#include "vision/mono_slam/sparse_map.hpp"

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <string_view>
#include <utility>

#include <Eigen/Cholesky>

#include "vision/core/byte_stream.hpp"
#include "vision/core/camera_stream.hpp"

namespace armsreach::mono_slam {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;

constexpr std::string_view kMagic = "ARSPARS2";
constexpr std::string_view kWithoutCamera = "ARSPARS1";
constexpr std::uint32_t kMostPoints = 500;
constexpr std::int32_t kSide = 2 * Patch::kReach + 1;
constexpr double kFarthest = 1e4;  // m and px: what cannot be

void put_patch(std::ostream& out, const Patch& patch) {
  write_value(out, std::int32_t{patch.size});
  write_values(out, patch.pixel);
  write_values(out, patch.normal_in_world);
  write_values(out, patch.world_from_camera.rotation().coeffs());
  write_values(out, patch.world_from_camera.translation());
  for (int y = 0; y < kSide; ++y) {
    out.write(patch.grey.ptr<char>(y), kSide);
  }
}

// Nothing when a value cannot be; that the stream ended is for the caller to see.
std::optional<Patch> get_patch(ValueReader& in) {
  constexpr double kUnit = 1e-6;
  Patch patch;
  patch.size = in.get<std::int32_t>();
  patch.pixel = in.get_values<Eigen::Vector2d>();
  patch.normal_in_world = in.get_values<Vector3d>();
  const Eigen::Quaterniond rotation(in.get_values<Eigen::Vector4d>());
  const auto translation = in.get_values<Vector3d>();
  patch.grey.create(kSide, kSide, CV_8UC1);
  for (int y = 0; y < kSide && in.ok(); ++y) {
    for (unsigned char& value : cv::Mat_<unsigned char>(patch.grey.row(y))) {
      value = in.get<unsigned char>();
    }
  }
  const bool possible = (patch.size == 11 || patch.size == 13 || patch.size == 15) &&
                        patch.pixel.cwiseAbs().maxCoeff() < kFarthest &&
                        std::abs(patch.normal_in_world.norm() - 1) < kUnit &&
                        std::abs(rotation.norm() - 1) < kUnit &&
                        translation.cwiseAbs().maxCoeff() < kFarthest;
  if (!possible) return std::nullopt;
  patch.world_from_camera = Pose(rotation, translation);
  return patch;
}

bool get_point(ValueReader& in, SparseMap* map) {
  Landmark landmark;
  const auto position = in.get_values<Vector3d>();
  landmark.of_target = in.get<std::uint8_t>() != 0;
  const auto attempts = in.get<std::uint32_t>();
  const auto successes = in.get<std::uint32_t>();
  auto patch = get_patch(in);
  const bool possible =
      position.cwiseAbs().maxCoeff() < kFarthest && successes <= attempts && attempts < 0x7fffffff;
  if (!patch || !possible) return false;
  landmark.attempts = static_cast<int>(attempts);
  landmark.successes = static_cast<int>(successes);
  landmark.patch = std::move(*patch);
  landmark.latest = landmark.patch.original();
  map->landmarks.push_back(std::move(landmark));
  map->points_in_world.push_back(position);
  return true;
}

// Symmetric as it is stored by halves; nothing unless it is also positive.
std::optional<MatrixXd> get_covariance(ValueReader& in, Eigen::Index rows) {
  MatrixXd out(rows, rows);
  for (Eigen::Index row = 0; row < rows && in.ok(); ++row) {
    for (Eigen::Index column = 0; column <= row; ++column) {
      out(row, column) = out(column, row) = in.get<double>();
    }
  }
  if (!in.ok()) return out;
  if (!out.allFinite() || Eigen::LLT<MatrixXd>(out).info() != Eigen::Success) return std::nullopt;
  return out;
}

}  // namespace

void write_sparse_map(std::ostream& out, const SparseMap& map) {
  out.write(kMagic.data(), static_cast<std::streamsize>(kMagic.size()));
  write_camera(out, map.camera);
  write_value(out, static_cast<std::uint32_t>(map.landmarks.size()));
  for (std::size_t i = 0; i < map.landmarks.size(); ++i) {
    const Landmark& landmark = map.landmarks[i];
    write_values(out, map.points_in_world[i]);
    write_value(out, static_cast<std::uint8_t>(landmark.of_target ? 1 : 0));
    write_value(out, static_cast<std::uint32_t>(landmark.attempts));
    write_value(out, static_cast<std::uint32_t>(landmark.successes));
    put_patch(out, landmark.patch);
  }
  for (Eigen::Index row = 0; row < map.covariance.rows(); ++row) {
    for (Eigen::Index column = 0; column <= row; ++column)
      write_value(out, map.covariance(row, column));
  }
}

Result<SparseMap> read_sparse_map(std::istream& in, const std::string& where) {
  constexpr const char* kRemedy = "map the place again, or give another file";
  std::string magic(kMagic.size(), '\0');
  in.read(magic.data(), static_cast<std::streamsize>(magic.size()));
  if (in && magic == kWithoutCamera) {
    return Error{"the map was saved by an older version and does not say what camera saw it", where,
                 kRemedy};
  }
  if (!in || magic != kMagic) return Error{"this is not a file of a sparse map", where, kRemedy};
  ValueReader reader(in);
  const auto camera = read_camera(reader);
  const auto count = reader.get<std::uint32_t>();
  if (!reader.ok()) return Error{"the file ends before its first point", where, kRemedy};
  if (!camera) return Error{"the camera has values that cannot be", where, kRemedy};
  SparseMap map;
  map.camera = *camera;
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::string position = "point " + std::to_string(i + 1) + " of " + std::to_string(count);
    const bool possible = i < kMostPoints && get_point(reader, &map);
    if (!reader.ok()) return Error{"the file ends within " + position, where, kRemedy};
    if (!possible) return Error{position + " has values that cannot be", where, kRemedy};
  }
  auto covariance = get_covariance(reader, 3 * static_cast<Eigen::Index>(count));
  if (!reader.ok()) return Error{"the file ends within the covariance", where, kRemedy};
  if (!covariance) return Error{"the covariance is not positive", where, kRemedy};
  map.covariance = std::move(*covariance);
  if (in.peek() != std::istream::traits_type::eof())
    return Error{"the file goes on after the map", where, kRemedy};
  return map;
}

Status check_same_camera(const SparseMap& map, const Camera& camera, const std::string& where) {
  const Camera& known = map.camera;
  // px, at the picture's edge: a calibration that was repeated is the same camera's.
  constexpr double kSame = 2;
  const auto differ = [&](double x, double y) {
    const Eigen::Vector2d pixel(x * (camera.width - 1), y * (camera.height - 1));
    const auto seen = project(known, unproject(camera, pixel));
    return !seen || (*seen - pixel).norm() > kSame;
  };
  const bool same = known.width == camera.width && known.height == camera.height &&
                    !differ(0, 0.5) && !differ(1, 0.5) && !differ(0.5, 0) && !differ(0.5, 1);
  if (same) return ok();
  char what[160];
  std::snprintf(
      what, sizeof what,
      "the map is another camera's: it is of %dx%d px and a focal length of %.1f px, this "
      "camera of %dx%d and %.1f",
      known.width, known.height, known.fx, camera.width, camera.height, camera.fx);
  return Error{what, where,
               "use the camera (or the --camera file) the map was made with, or give --session "
               "another folder"};
}

}  // namespace armsreach::mono_slam
