#include "app/cli/mono_setup.hpp"

#include <filesystem>
#include <fstream>

#include <opencv2/imgcodecs.hpp>

#include "devices/source.hpp"
#include "vision/mono_slam/target_yaml.hpp"

namespace armsreach::app {
namespace {

namespace fs = std::filesystem;

constexpr int kLargestPatch = 15;  // px

Result<mono_slam::StartTarget> read_target(const fs::path& path) {
  std::ifstream in(path);
  if (!in || fs::is_directory(path)) {
    return Error{"cannot be opened", path.string(), "check mono_slam.target in the configuration"};
  }
  auto file = mono_slam::read_target_yaml(in, path.string());
  if (!file) return file.error();
  mono_slam::StartTarget target;
  target.rectangle = file->rectangle;
  for (const auto& mark : file->marks) {
    const fs::path patch = path.parent_path() / mark.patch;
    // OpenCV says on the terminal what it cannot open.
    std::error_code ignored;
    const cv::Mat image = fs::is_regular_file(patch, ignored)
                              ? cv::imread(patch.string(), cv::IMREAD_GRAYSCALE)
                              : cv::Mat();
    if (image.empty() || image.rows != image.cols || image.rows % 2 == 0 ||
        image.rows > kLargestPatch) {
      return Error{"is not a square grey image of an odd size up to 15 px", patch.string(),
                   "mend the patch that " + path.string() + " names"};
    }
    target.marks.push_back({image, mark.point_in_world});
  }
  return target;
}

}  // namespace

std::string target_of_source(const std::string& source) {
  const auto spec = parse_source_spec(source);
  if (!spec || spec->place.empty()) return "";
  const fs::path path = fs::path(spec->place) / "target.yaml";
  std::error_code ignored;
  return fs::is_regular_file(path, ignored) ? path.string() : "";
}

Result<MonoSetup> make_mono_setup(const MonoSlamConfig& config, const std::string& target_file,
                                  std::uint64_t seed) {
  MonoSetup setup;
  mono_slam::MonoSlamOptions& options = setup.options;
  options.stated_distance = config.stated_distance;
  options.visible_points = config.visible_points;
  options.most_points = config.most_points;
  options.new_points = config.new_points == "particles" ? mono_slam::NewPoints::particles
                                                        : mono_slam::NewPoints::inverse_depth;
  options.forget_start_target_at = config.forget_start_target_at;
  options.seed = seed;
  const std::string& path = config.target.empty() ? target_file : config.target;
  if (path.empty()) return setup;
  auto target = read_target(path);
  if (!target) return target.error();
  options.target = *std::move(target);
  return setup;
}

}  // namespace armsreach::app
