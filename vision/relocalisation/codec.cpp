#include "vision/relocalisation/codec.hpp"

#include <cmath>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>

#include "vision/core/byte_stream.hpp"
#include "vision/core/camera_stream.hpp"

namespace armsreach::relocalisation {
namespace {

constexpr std::string_view kMagic = "ARKEYS01";
constexpr std::uint32_t kMostKeyFrames = 100'000;
constexpr std::uint32_t kMostFeatures = 100'000;

void put_pose(std::ostream& out, const Pose& pose) {
  write_values(out, pose.rotation().coeffs());
  write_values(out, pose.translation());
}

std::optional<Pose> get_pose(ValueReader& in) {
  const Eigen::Quaterniond rotation(in.get_values<Eigen::Vector4d>());
  const auto translation = in.get_values<Eigen::Vector3d>();
  constexpr double kUnit = 1e-6;
  if (!(std::abs(rotation.norm() - 1) < kUnit) || !translation.allFinite()) return std::nullopt;
  return Pose(rotation, translation);
}

void put_depth(std::ostream& out, const cv::Mat& depth) {
  for (int y = 0; y < depth.rows; ++y) write_values(out, cv::Mat_<float>(depth.row(y)));
}

bool possible_depth(float depth) { return std::isfinite(depth) && depth > 0; }

std::optional<cv::Mat> get_depth(ValueReader& in, cv::Size size) {
  cv::Mat depth(size, CV_32FC1);
  for (int y = 0; y < size.height && in.ok(); ++y) {
    for (float& value : cv::Mat_<float>(depth.row(y))) {
      value = in.get<float>();
      if (!std::isnan(value) && !possible_depth(value)) return std::nullopt;
    }
  }
  return depth;
}

void put_features(std::ostream& out, const Features& features) {
  write_value(out, static_cast<std::uint32_t>(features.size()));
  for (const Feature& place : features.places) {
    write_values(out, place.ray);
    write_value(out, place.depth);
  }
  write_values(out, features.descriptors);
}

std::optional<Features> get_features(ValueReader& in) {
  const auto count = in.get<std::uint32_t>();
  if (count > kMostFeatures) return std::nullopt;
  std::vector<Feature> places;
  for (std::uint32_t i = 0; i < count && in.ok(); ++i) {
    Feature place;
    place.ray = in.get_values<Eigen::Vector2f>();
    place.depth = in.get<float>();
    if (!place.ray.allFinite() || !possible_depth(place.depth)) return std::nullopt;
    places.push_back(place);
  }
  Features features;
  for (const Feature& place : places) features.push_back(place, in.get<Descriptor>());
  return features;
}

void put_key_frame(std::ostream& out, const KeyFrame& key_frame) {
  write_value(out, key_frame.frame);
  put_pose(out, key_frame.world_from_color);
  write_value(out, key_frame.view.pixel_size);
  write_camera(out, key_frame.view.camera);
  put_depth(out, key_frame.view.depth);
  put_features(out, key_frame.view.features);
}

// Nothing when a value cannot be; that the stream ended is for the caller to see.
std::shared_ptr<const KeyFrame> get_key_frame(ValueReader& in) {
  auto key_frame = std::make_shared<KeyFrame>();
  key_frame->frame = in.get<std::int64_t>();
  const auto pose = get_pose(in);
  key_frame->view.pixel_size = in.get<double>();
  if (!pose || !std::isfinite(key_frame->view.pixel_size) || key_frame->view.pixel_size <= 0)
    return nullptr;
  key_frame->world_from_color = *pose;
  const auto camera = read_camera(in);
  if (!camera) return nullptr;
  key_frame->view.camera = *camera;
  const auto depth = get_depth(in, {camera->width, camera->height});
  if (!depth) return nullptr;
  key_frame->view.depth = *depth;
  auto features = get_features(in);
  if (!features) return nullptr;
  key_frame->view.features = std::move(*features);
  return key_frame;
}

}  // namespace

void write_key_frames(std::ostream& out, const KeyFrames& key_frames) {
  out.write(kMagic.data(), static_cast<std::streamsize>(kMagic.size()));
  write_value(out, static_cast<std::uint32_t>(key_frames.size()));
  for (const auto& key_frame : key_frames) put_key_frame(out, *key_frame);
}

Result<KeyFrames> read_key_frames(std::istream& in, const std::string& where) {
  constexpr const char* kRemedy = "map the place again, or give another file";
  std::string magic(kMagic.size(), '\0');
  in.read(magic.data(), static_cast<std::streamsize>(magic.size()));
  if (!in || magic != kMagic) return Error{"this is not a file of key frames", where, kRemedy};
  ValueReader reader(in);
  const auto count = reader.get<std::uint32_t>();
  KeyFrames key_frames;
  for (std::uint32_t i = 0; i < count; ++i) {
    auto key_frame = i < kMostKeyFrames ? get_key_frame(reader) : nullptr;
    const std::string position =
        "key frame " + std::to_string(i + 1) + " of " + std::to_string(count);
    if (!reader.ok()) return Error{"the file ends within " + position, where, kRemedy};
    if (!key_frame) return Error{position + " has values that cannot be", where, kRemedy};
    key_frames.push_back(std::move(key_frame));
  }
  if (!reader.ok()) return Error{"the file ends before its first key frame", where, kRemedy};
  return key_frames;
}

}  // namespace armsreach::relocalisation
