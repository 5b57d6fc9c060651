#include "vision/relocalisation/codec.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string_view>
#include <type_traits>
#include <utility>

namespace armsreach::relocalisation {
namespace {

static_assert(std::endian::native == std::endian::little,
              "values are stored as they lie in memory");

constexpr std::string_view kMagic = "ARKEYS01";
constexpr std::uint32_t kMostKeyFrames = 100'000;
constexpr std::uint32_t kMostFeatures = 100'000;
constexpr std::int32_t kLargestImage = 4096;  // px, either way

template <class T>
void put(std::ostream& out, const T& value) {
  static_assert(std::is_trivially_copyable_v<T>);
  out.write(reinterpret_cast<const char*>(&value), sizeof value);
}

// Reads values until the stream fails; a failed reader gives zeros.
class Reader {
 public:
  explicit Reader(std::istream& in) : in_(in) {}
  bool ok() const { return in_.good(); }
  template <class T>
  T get() {
    static_assert(std::is_trivially_copyable_v<T>);
    T value{};
    in_.read(reinterpret_cast<char*>(&value), sizeof value);
    return ok() ? value : T{};
  }

 private:
  std::istream& in_;
};

void put_pose(std::ostream& out, const Pose& pose) {
  for (const double value : pose.rotation().coeffs()) put(out, value);
  for (const double value : pose.translation()) put(out, value);
}

std::optional<Pose> get_pose(Reader& in) {
  Eigen::Quaterniond rotation;
  Eigen::Vector3d translation;
  for (double& value : rotation.coeffs()) value = in.get<double>();
  for (double& value : translation) value = in.get<double>();
  constexpr double kUnit = 1e-6;
  if (!(std::abs(rotation.norm() - 1) < kUnit) || !translation.allFinite()) return std::nullopt;
  return Pose(rotation, translation);
}

void put_camera(std::ostream& out, const Camera& camera) {
  put(out, std::int32_t{camera.width});
  put(out, std::int32_t{camera.height});
  put(out, static_cast<std::int32_t>(camera.distortion));
  for (const double value : {camera.fx, camera.fy, camera.cx, camera.cy}) put(out, value);
  for (const double value : camera.coefficients) put(out, value);
}

std::optional<Camera> get_camera(Reader& in) {
  Camera camera;
  camera.width = in.get<std::int32_t>();
  camera.height = in.get<std::int32_t>();
  const auto distortion = in.get<std::int32_t>();
  for (double* value : {&camera.fx, &camera.fy, &camera.cx, &camera.cy}) *value = in.get<double>();
  for (double& value : camera.coefficients) value = in.get<double>();
  const auto possible = [](std::int32_t size) { return size > 0 && size <= kLargestImage; };
  if (!possible(camera.width) || !possible(camera.height)) return std::nullopt;
  if (distortion < 0 || distortion > static_cast<std::int32_t>(Distortion::monoslam))
    return std::nullopt;
  camera.distortion = static_cast<Distortion>(distortion);
  const auto finite = [](double value) { return std::isfinite(value); };
  if (!(camera.fx > 0 && camera.fy > 0) || !finite(camera.fx) || !finite(camera.fy) ||
      !finite(camera.cx) || !finite(camera.cy) ||
      !std::all_of(camera.coefficients.begin(), camera.coefficients.end(), finite))
    return std::nullopt;
  return camera;
}

void put_depth(std::ostream& out, const cv::Mat& depth) {
  for (int y = 0; y < depth.rows; ++y) {
    for (int x = 0; x < depth.cols; ++x) put(out, depth.at<float>(y, x));
  }
}

bool possible_depth(float depth) { return std::isfinite(depth) && depth > 0; }

std::optional<cv::Mat> get_depth(Reader& in, cv::Size size) {
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
  put(out, static_cast<std::uint32_t>(features.size()));
  for (const Feature& place : features.places) {
    put(out, place.ray.x());
    put(out, place.ray.y());
    put(out, place.depth);
  }
  for (const Descriptor& descriptor : features.descriptors) put(out, descriptor);
}

std::optional<Features> get_features(Reader& in) {
  const auto count = in.get<std::uint32_t>();
  if (count > kMostFeatures) return std::nullopt;
  std::vector<Feature> places;
  for (std::uint32_t i = 0; i < count && in.ok(); ++i) {
    Feature place;
    place.ray.x() = in.get<float>();
    place.ray.y() = in.get<float>();
    place.depth = in.get<float>();
    if (!place.ray.allFinite() || !possible_depth(place.depth)) return std::nullopt;
    places.push_back(place);
  }
  Features features;
  for (const Feature& place : places) features.push_back(place, in.get<Descriptor>());
  return features;
}

void put_key_frame(std::ostream& out, const KeyFrame& key_frame) {
  put(out, key_frame.frame);
  put_pose(out, key_frame.world_from_color);
  put(out, key_frame.view.pixel_size);
  put_camera(out, key_frame.view.camera);
  put_depth(out, key_frame.view.depth);
  put_features(out, key_frame.view.features);
}

// Nothing when a value cannot be; that the stream ended is for the caller to see.
std::shared_ptr<const KeyFrame> get_key_frame(Reader& in) {
  auto key_frame = std::make_shared<KeyFrame>();
  key_frame->frame = in.get<std::int64_t>();
  const auto pose = get_pose(in);
  key_frame->view.pixel_size = in.get<double>();
  if (!pose || !std::isfinite(key_frame->view.pixel_size) || key_frame->view.pixel_size <= 0)
    return nullptr;
  key_frame->world_from_color = *pose;
  const auto camera = get_camera(in);
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
  put(out, static_cast<std::uint32_t>(key_frames.size()));
  for (const auto& key_frame : key_frames) put_key_frame(out, *key_frame);
}

Result<KeyFrames> read_key_frames(std::istream& in, const std::string& where) {
  constexpr const char* kRemedy = "map the place again, or give another file";
  std::string magic(kMagic.size(), '\0');
  in.read(magic.data(), static_cast<std::streamsize>(magic.size()));
  if (!in || magic != kMagic) return Error{"this is not a file of key frames", where, kRemedy};
  Reader reader(in);
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
