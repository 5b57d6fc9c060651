#include "app/cli/image_inputs.hpp"

#include <algorithm>
#include <cctype>
#include <system_error>

namespace armsreach::app {
namespace {

namespace fs = std::filesystem;

bool is_image(const fs::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const auto known = {".png", ".jpg", ".jpeg", ".pgm", ".ppm", ".bmp", ".tif", ".tiff"};
  return std::find(known.begin(), known.end(), ending) != known.end();
}

Result<std::vector<fs::path>> images_in(const fs::path& folder) {
  std::error_code failure;
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder, failure)) {
    if (is_image(entry.path())) files.push_back(entry.path());
  }
  if (failure) return Error{failure.message(), folder.string(), "check the folder's permissions"};
  if (files.empty()) {
    return Error{"holds no images", folder.string(), "give a folder of PNG or JPEG files"};
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

Result<std::vector<fs::path>> image_files(const std::vector<std::string>& inputs) {
  std::vector<fs::path> files;
  for (const std::string& input : inputs) {
    if (!fs::is_directory(input)) {
      files.emplace_back(input);
      continue;
    }
    auto inside = images_in(input);
    if (!inside) return inside.error();
    files.insert(files.end(), inside->begin(), inside->end());
  }
  if (files.empty()) return Error{"no images were given", "", "give image files or folders"};
  return files;
}

}  // namespace armsreach::app
