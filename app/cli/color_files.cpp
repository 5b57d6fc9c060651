#include "app/cli/color_files.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <sstream>
#include <system_error>
#include <utility>

#include "app/runtime/output_file.hpp"
#include "devices/files.hpp"
#include "devices/image_file.hpp"
#include "render/assets.hpp"
#include "vision/gesture/color_model_yaml.hpp"
#include "vision/gesture/has_color.hpp"

namespace armsreach::app {
namespace {

namespace fs = std::filesystem;

// 8 bits of one or three channels, or 16 bits of one.
Result<cv::Mat> read_any_mask(const fs::path& file) {
  if (auto labels = read_mask_image(file)) return labels;
  auto picture = read_color_image(file);
  if (!picture || picture->channels() == 1) return picture;
  cv::Mat greatest(picture->size(), CV_8UC1);
  for (int row = 0; row < picture->rows; ++row) {
    for (int col = 0; col < picture->cols; ++col) {
      const auto& color = picture->at<cv::Vec3b>(row, col);
      greatest.at<std::uint8_t>(row, col) = std::max({color[0], color[1], color[2]});
    }
  }
  return greatest;
}

}  // namespace

Result<std::vector<fs::path>> list_pictures(const std::vector<std::string>& places) {
  std::vector<fs::path> files;
  for (const std::string& place : places) {
    if (!file_exists(place)) return Error{"is not there", place, "check the path"};
    if (!folder_exists(place)) {
      files.emplace_back(place);
      continue;
    }
    auto inside = images_by_name(place);
    if (!inside) return inside;
    files.insert(files.end(), inside->begin(), inside->end());
  }
  return files;
}

Result<cv::Mat> read_picture(const fs::path& file) {
  auto picture = read_color_image(file);
  if (!picture) {
    return Error{picture.error().what, file.string(),
                 "give whole pictures: JPEG, PNG, PGM, PPM and BMP are read"};
  }
  if (gesture::has_color(*picture)) return picture;
  return Error{"is a grey picture, which has no colours", file.string(), "give a colour picture"};
}

Result<cv::Mat> read_mask_of(const fs::path& picture, const std::string& folder,
                             const cv::Size& size, const std::optional<int>& value) {
  fs::path file = fs::path(folder) / (picture.stem().string() + ".png");
  if (const fs::path other = fs::path(folder) / (picture.stem().string() + ".mask.png");
      file_exists(other)) {
    file = other;
  }
  if (!file_exists(file)) {
    return Error{"has no mask", picture.string(), "put one at " + file.string()};
  }
  auto mask = read_any_mask(file);
  if (!mask) return mask;
  if (mask->size() != size) {
    return Error{"is " + std::to_string(mask->cols) + "x" + std::to_string(mask->rows) +
                     ", its picture " + std::to_string(size.width) + "x" +
                     std::to_string(size.height),
                 file.string(), "give masks of the pictures' size"};
  }
  return value ? cv::Mat(*mask == *value) : cv::Mat(*mask != 0);
}

Result<gesture::ColorModel> read_model_file(const std::string& path) {
  std::ifstream in(path);
  if (!in || folder_exists(path)) {
    return Error{"cannot be opened", path,
                 "give a file written by `calibrate skin` or `learn colour`"};
  }
  return gesture::read_color_model(in, path);
}

Result<gesture::ColorModel> things_model(const std::string& path) {
  auto model = read_model_file(path);
  if (!model || gesture::class_named(*model, gesture::kSkin) < 0) return model;
  return Error{"is a model of skin, not of things", path, "give a file written by `learn colour`"};
}

Status write_model_file(const std::string& path, const gesture::ColorModel& model) {
  std::stringstream text;
  gesture::write_color_model(text, model);
  if (auto again = gesture::read_color_model(text, path); !again) return again.error();
  return write_file(path, [&](std::ostream& out) { out << text.str(); });
}

Result<gesture::ColorModel> skin_model(const std::string& path) {
  if (!path.empty() && path != "simulated") {
    auto model = read_model_file(path);
    if (!model || gesture::class_named(*model, gesture::kSkin) >= 0) return model;
    return Error{"has no class 'skin'", path, "give a file written by `calibrate skin`"};
  }
  const std::string name = path.empty() ? "skin/default.yaml" : "skin/simulated.yaml";
  std::istringstream in{std::string(render::asset(name))};
  return gesture::read_color_model(in, name);
}

}  // namespace armsreach::app
