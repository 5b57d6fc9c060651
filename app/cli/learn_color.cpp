// armsreach learn colour: a named class of colours, taught by masks or by pointing.
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <opencv2/imgproc.hpp>

#include "app/cli/color_files.hpp"
#include "app/cli/commands.hpp"
#include "devices/files.hpp"
#include "vision/gesture/color_pointing.hpp"
#include "vision/gesture/color_training.hpp"

namespace armsreach::app {
namespace {

constexpr int kRim = 7;  // px: pixels of both the thing and what is behind it

struct LearnColorOptions {
  std::string name;
  std::vector<std::string> pictures;
  std::string masks;
  std::optional<int> mask_value;
  std::string region;
  std::string classes;
};

Result<std::optional<cv::Rect>> read_region(const std::string& text) {
  if (text.empty()) return std::optional<cv::Rect>();
  cv::Rect region;
  char rest = 0;
  const int read = std::sscanf(text.c_str(), "%d,%d,%d,%d%c", &region.x, &region.y, &region.width,
                               &region.height, &rest);
  if (read != 4 || region.width < 1 || region.height < 1) {
    return Error{"'" + text + "' is not x,y,width,height", "--region",
                 "in pixels from the picture's top left, e.g. 120,80,40,40"};
  }
  return std::optional(region);
}

// The thing's pixels in one picture. CV_8UC1, not 0 on it.
Result<cv::Mat> thing_in(const cv::Mat& bgr, const std::filesystem::path& file,
                         const LearnColorOptions& options, const std::optional<cv::Rect>& region) {
  if (!options.masks.empty()) {
    auto mask = read_mask_of(file, options.masks, bgr.size(), options.mask_value);
    if (!mask) return mask;
    return gesture::own_colors(bgr, *mask);
  }
  if (region && (*region & cv::Rect({0, 0}, bgr.size())) != *region) {
    return Error{"the region reaches beyond the picture of " + std::to_string(bgr.cols) + "x" +
                     std::to_string(bgr.rows),
                 file.string(), "give a --region inside it"};
  }
  cv::Mat thing = gesture::pointed_out(bgr, region);
  if (cv::countNonZero(thing) > 0) return thing;
  return Error{"nothing stands out from its surroundings", file.string(),
               "say where the thing is with --region x,y,width,height or --masks DIR"};
}

void add(const cv::Mat& bgr, const cv::Mat& thing, gesture::ColorExamples* examples) {
  cv::Mat wide;
  cv::dilate(thing, wide, cv::Mat::ones(kRim, kRim, CV_8UC1));
  for (int row = 0; row < bgr.rows; ++row) {
    for (int col = 0; col < bgr.cols; ++col) {
      const bool inside = thing.at<std::uint8_t>(row, col) != 0;
      if (inside || wide.at<std::uint8_t>(row, col) == 0) {
        examples->add(bgr.at<cv::Vec3b>(row, col), inside);
      }
    }
  }
}

Status learn(const LearnColorOptions& options) {
  if (options.name == gesture::kSkin)
    return Error{"is the name of skin itself", options.name, "`calibrate skin` learns skin"};
  if (options.name.find_first_not_of(" \t") == std::string::npos)
    return Error{"is no name", "'" + options.name + "'", "name it as it shall be called"};
  auto region = read_region(options.region);
  if (!region) return region.error();
  gesture::ColorModel model;
  if (file_exists(options.classes)) {
    auto known = things_model(options.classes);
    if (!known) return known.error();
    model = *known;
  }
  auto files = list_pictures(options.pictures);
  if (!files) return files.error();
  gesture::ColorExamples examples;
  for (const auto& file : *files) {
    auto bgr = read_picture(file);
    if (!bgr) return bgr.error();
    auto thing = thing_in(*bgr, file, options, *region);
    if (!thing) return thing.error();
    add(*bgr, *thing, &examples);
  }
  auto more = gesture::taught(model, options.name, examples, "colour '" + options.name + "'");
  if (!more) return more.error();
  if (auto status = write_model_file(options.classes, *more); !status) return status;
  const auto plural = [](std::size_t count, const char* many) { return count == 1 ? "" : many; };
  std::printf("%s: %.0f pixels of %zu picture%s; %zu class%s in %s\n", options.name.c_str(),
              examples.inside.count(), files->size(), plural(files->size(), "s"),
              more->classes.size(), plural(more->classes.size(), "es"), options.classes.c_str());
  return ok();
}

}  // namespace

void add_learn_color(CLI::App& learn_verb, Task* task) {
  CLI::App* command =
      learn_verb.add_subcommand("colour", "a thing by its colour, from a few pictures of it");
  auto o = std::make_shared<LearnColorOptions>();
  command->add_option("name", o->name, "what it is called")->required();
  command->add_option("pictures", o->pictures, "pictures of it, or folders of them")->required();
  auto* masks = command->add_option("--masks", o->masks,
                                    "folder of masks, PNGs of the pictures' stems; without: what "
                                    "stands out from the picture's border");
  command->add_option("--mask-value", o->mask_value, "the thing's value in them [all but 0]")
      ->needs(masks);
  command->add_option("--region", o->region, "x,y,width,height [px] with the thing in it")
      ->excludes(masks);
  command->add_option("--classes", o->classes, "YAML file of colour classes to add it to")
      ->required();
  command->callback([task, o] { *task = [o] { return learn(*o); }; });
}

}  // namespace armsreach::app
