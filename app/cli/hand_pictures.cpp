#include "app/cli/hand_pictures.hpp"

#include <filesystem>
#include <optional>
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

using Look = std::function<Status(const HandPicture&)>;

gesture::SkinSegmenter segmenter(const gesture::ColorModel& model, Adaptation adaptation) {
  gesture::SkinOptions options;
  options.adaptation = adaptation;
  return gesture::SkinSegmenter(model, options);
}

bool is_video(const fs::path& file) {
  for (const char* extension : {".mp4", ".avi", ".mov", ".mkv", ".webm", ".m4v"})
    if (file.extension() == extension) return true;
  return false;
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
    picture.skin = skin.segment(picture.bgr);
    if (auto status = look(picture); !status) return status;
    if (progress.due()) progress.show(file + ": frame " + std::to_string(picture.frame));
  }
}

}  // namespace

Status for_hand_pictures(const std::vector<std::string>& places, const SkinSource& source,
                         const Look& look) {
  auto model = skin_model(source.model);
  if (!model) return model.error();
  auto skin = segmenter(*model, Adaptation::image);
  Progress progress;
  for (const std::string& place : places) {
    if (!folder_exists(place) && is_video(place)) {
      if (auto status = look_at_video(place, *model, look); !status) return status;
      continue;
    }
    auto files = list_pictures({place});
    if (!files) return files.error();
    for (const fs::path& file : *files) {
      auto bgr = read_picture(file);
      if (!bgr) return bgr.error();
      HandPicture picture{file.string(), 0, *bgr, {}};
      if (source.masks.empty() && bgr->cols < kThumbnail) {
        picture.enlarged = 2;
        cv::resize(*bgr, picture.bgr, {}, 2, 2, cv::INTER_LINEAR);
      }
      if (source.masks.empty()) {
        picture.skin = skin.segment(picture.bgr);
      } else {
        auto mask = read_mask_of(file, source.masks, bgr->size(), std::nullopt);
        if (!mask) return mask.error();
        picture.skin = std::move(*mask);
      }
      if (auto status = look(picture); !status) return status;
      if (progress.due()) progress.show(picture.file);
    }
  }
  return ok();
}

}  // namespace armsreach::app
