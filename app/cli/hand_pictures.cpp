#include "app/cli/hand_pictures.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <system_error>
#include <utility>

#include <opencv2/imgproc.hpp>

#include "app/cli/color_files.hpp"
#include "app/runtime/progress.hpp"
#include "devices/files.hpp"
#include "devices/open.hpp"
#include "vision/gesture/skin_segmenter.hpp"

namespace armsreach::app {
namespace {

namespace fs = std::filesystem;
using Adaptation = gesture::SkinOptions::Adaptation;

constexpr int kThumbnail = 160;  // px: narrower pictures are enlarged

gesture::SkinSegmenter segmenter(const gesture::ColorModel& model, Adaptation adaptation) {
  gesture::SkinOptions options;
  options.adaptation = adaptation;
  return gesture::SkinSegmenter(model, options);
}

bool is_video(const fs::path& file) {
  std::string extension = file.extension();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const std::array known = {".mp4", ".avi", ".mov", ".mkv", ".webm", ".m4v"};
  return std::find(known.begin(), known.end(), extension) != known.end();
}

// Pictures and videos of a folder by name; what is no folder as it is.
Result<std::vector<fs::path>> files_at(const std::string& place) {
  if (!folder_exists(place)) return list_pictures({place});
  std::vector<fs::path> videos;
  std::error_code failure;
  for (fs::directory_iterator entry(place, failure), end; !failure && entry != end;
       entry.increment(failure)) {
    if (is_video(entry->path())) videos.push_back(entry->path());
  }
  auto files = list_pictures({place});
  if (!files && videos.empty()) return files;
  if (files) videos.insert(videos.end(), files->begin(), files->end());
  std::sort(videos.begin(), videos.end());
  return videos;
}

Status look_at_video(const std::string& file, const gesture::ColorModel& model, const Look& look) {
  auto source = open_source(SourceSpec{"video", file, {}}, {});
  if (!source) return source.error();
  // A video is one scene.
  auto skin = segmenter(model, Adaptation::stream);
  Progress progress;
  for (;;) {
    auto frame = (*source)->next();
    if (!frame) return frame.error();
    if (!*frame) return ok();
    HandPicture picture{file, (*frame)->index, (*frame)->color, {}};
    picture.skins = skin.segmentations(picture.bgr);
    if (auto status = look(picture); !status) return status;
    if (progress.due()) progress.show(file + ": frame " + std::to_string(picture.frame));
  }
}

Status look_at_picture(const fs::path& file, const std::string& masks, gesture::SkinSegmenter* skin,
                       const Look& look) {
  auto bgr = read_picture(file);
  if (!bgr) return bgr.error();
  HandPicture picture{file.string(), 0, *bgr, {}};
  if (masks.empty()) {
    if (bgr->cols < kThumbnail) {
      picture.enlarged = 2;
      cv::resize(*bgr, picture.bgr, {}, 2, 2, cv::INTER_LINEAR);
    }
    picture.skins = skin->segmentations(picture.bgr);
  } else {
    auto mask = read_mask_of(file, masks, bgr->size(), std::nullopt);
    if (!mask) return mask.error();
    picture.skins = {*std::move(mask)};
  }
  return look(picture);
}

// `failed` says what becomes of an error.
Status for_each(const std::vector<std::string>& places, const SkinSource& source, const Look& look,
                const std::function<Status(const Error&)>& failed) {
  auto model = skin_model(source.model);
  if (!model) return model.error();
  auto skin = segmenter(*model, Adaptation::image);
  Progress progress;
  for (const std::string& place : places) {
    auto files = files_at(place);
    if (!files) {
      if (auto status = failed(files.error()); !status) return status;
      continue;
    }
    for (const fs::path& file : *files) {
      const Status status = is_video(file) ? look_at_video(file, *model, look)
                                           : look_at_picture(file, source.masks, &skin, look);
      if (!status) {
        if (auto stop = failed(status.error()); !stop) return stop;
      }
      if (progress.due()) progress.show(file.string());
    }
  }
  return ok();
}

}  // namespace

Status for_hand_pictures(const std::vector<std::string>& places, const SkinSource& source,
                         const Look& look) {
  return for_each(places, source, look, [](const Error& error) -> Status { return error; });
}

Status for_readable_hand_pictures(const std::vector<std::string>& places, const SkinSource& source,
                                  const std::function<void(const HandPicture&)>& look) {
  int seen = 0;
  std::vector<Error> left_out;
  const auto status = for_each(
      places, source,
      [&](const HandPicture& picture) {
        ++seen;
        look(picture);
        return ok();
      },
      [&](const Error& error) {
        left_out.push_back(error);
        return ok();
      });
  if (!status) return status;
  if (seen == 0 && !left_out.empty()) return left_out[0];
  for (const Error& error : left_out)
    std::fprintf(stderr, "armsreach: left out: %s\n", error.message().c_str());
  if (!left_out.empty())
    std::fprintf(stderr, "armsreach: %zu could not be read\n", left_out.size());
  return ok();
}

}  // namespace armsreach::app
