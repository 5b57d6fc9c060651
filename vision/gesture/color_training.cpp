#include "vision/gesture/color_training.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numeric>

#include "vision/gesture/color_histogram.hpp"

namespace armsreach::gesture {
namespace {

constexpr double kFewestPixels = 50;   // to learn anything from
constexpr double kGeneralSpread = 2;   // cells; see tests/unit/vision/gesture/skin_people_test.cpp
constexpr double kTaughtSpread = 2.5;  // cells: another light, another side of the thing
constexpr double kFittedWeight = 0.9;  // of the user's own pixels

Status check_enough(const ColorExamples& examples, const std::string& where) {
  if (examples.inside.count() < kFewestPixels) {
    return Error{"has no more than " + std::to_string(static_cast<int>(examples.inside.count())) +
                     " pixels to learn from",
                 where, "give images or masks where at least 50 pixels are the thing's"};
  }
  if (examples.outside.count() < kFewestPixels) {
    return Error{"has hardly any background", where,
                 "give images or masks that leave some of the surroundings visible"};
  }
  return ok();
}

// A whole number 0..255 at `text`, which moves past it; -1 where there is none.
int read_level(const char*& text) {
  char* end = nullptr;
  const long value = std::strtol(text, &end, 10);
  if (end == text || value < 0 || value > 255) return -1;
  text = end;
  while (*text == ',' || *text == ' ' || *text == '\t' || *text == '\r') ++text;
  return static_cast<int>(value);
}

}  // namespace

void ColorExamples::add(const cv::Vec3b& bgr, bool is_inside) {
  static const ColorProjection projection;
  (is_inside ? inside : outside).add(projection(bgr));
  for (int i = 0; is_inside && i < 3; ++i) ++channels[i][bgr[i]];
}

Status add_examples(const cv::Mat& bgr, const cv::Mat& mask, const std::string& where,
                    ColorExamples* examples) {
  if (bgr.type() != CV_8UC3) {
    return Error{"is a grey image, which has no colours to learn from", where,
                 "give colour images"};
  }
  if (mask.size() != bgr.size()) {
    return Error{"is " + std::to_string(bgr.cols) + "x" + std::to_string(bgr.rows) + ", its mask " +
                     std::to_string(mask.cols) + "x" + std::to_string(mask.rows),
                 where, "give masks of the images' size"};
  }
  for (int row = 0; row < bgr.rows; ++row) {
    for (int col = 0; col < bgr.cols; ++col) {
      examples->add(bgr.at<cv::Vec3b>(row, col), mask.at<std::uint8_t>(row, col) != 0);
    }
  }
  return ok();
}

Status add_pixel_list(std::istream& in, const std::string& where, ColorExamples* examples) {
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    const bool heading = number == 1 && !line.empty() && (line[0] < '0' || line[0] > '9');
    if (heading || line.find_first_not_of(" \t\r") == std::string::npos) continue;
    const char* text = line.c_str();
    std::array<int, 4> values{};
    for (int& value : values) value = read_level(text);
    const bool good = *std::min_element(values.begin(), values.end()) >= 0 && *text == '\0' &&
                      (values[3] == 1 || values[3] == 2);
    if (!good) {
      return Error{"'" + line.substr(0, 40) + "' is not a pixel",
                   where + ":" + std::to_string(number),
                   "lines are b,g,r,label: levels 0-255, then 1 for skin or 2 for other things"};
    }
    examples->add(
        cv::Vec3b(static_cast<std::uint8_t>(values[0]), static_cast<std::uint8_t>(values[1]),
                  static_cast<std::uint8_t>(values[2])),
        values[3] == 1);
  }
  if (in.bad()) return Error{"cannot be read to its end", where, "check the disk"};
  return ok();
}

cv::Vec3f level_of(const ColorExamples& examples) {
  cv::Vec3f level;
  for (int i = 0; i < 3; ++i) {
    const auto& counts = examples.channels[i];
    double left = std::accumulate(counts.begin(), counts.end(), 0.0) / 2;
    std::size_t middle = 0;
    while (middle + 1 < counts.size() && (left -= counts[middle]) > 0) ++middle;
    level[i] = static_cast<float>(middle) + 0.5F;
  }
  return level;
}

Result<ColorModel> general_skin_model(const std::vector<ColorExamples>& sets,
                                      const std::string& where) {
  CV_Assert(!sets.empty());
  ColorModel model;
  model.classes.push_back({kSkin, {}});
  ColorHistogram& skin = model.classes[0].pixels;
  for (std::size_t i = 0; i < sets.size(); ++i) {
    if (auto status = check_enough(sets[i], where); !status) return status.error();
    const double share = 1 / static_cast<double>(i + 1);
    skin = blend(skin, sets[i].inside, share);
    model.background = blend(model.background, sets[i].outside, share);
  }
  skin = spread(skin, kGeneralSpread);
  model.background = spread(model.background, kGeneralSpread);
  model.level = level_of(sets[0]);
  return model;
}

Result<ColorModel> fitted_skin_model(const ColorModel& general, const ColorExamples& examples,
                                     const std::string& where) {
  if (auto status = check_enough(examples, where); !status) return status.error();
  ColorModel model = general;
  ColorHistogram& skin = model.classes[std::max(0, class_named(model, kSkin))].pixels;
  skin = blend(skin, examples.inside, kFittedWeight);
  model.background = blend(model.background, examples.outside, kFittedWeight);
  model.level = level_of(examples);
  return model;
}

ColorModel balanced(const ColorModel& model, const cv::Vec3f& level) {
  constexpr float kMost = 2;  // of one channel against the others: beyond that it was not skin
  ColorModel fitted = model;
  float product = 1;
  for (int i = 0; i < 3; ++i) {
    if (model.level[i] <= 0 || level[i] <= 0) return model;
    fitted.balance[i] = model.level[i] / level[i];
    product *= fitted.balance[i];
  }
  for (float& gain : fitted.balance.val) {
    gain = std::clamp(gain / std::cbrt(product), 1 / kMost, kMost);
  }
  return fitted;
}

Result<ColorModel> taught(const ColorModel& model, const std::string& name,
                          const ColorExamples& examples, const std::string& where) {
  if (name.find_first_not_of(" \t") == std::string::npos)
    return Error{"has no name", where, "say what the thing is called"};
  if (auto status = check_enough(examples, where); !status) return status.error();
  ColorModel more = model;
  more.with_luma = true;
  const int known = class_named(more, name);
  ColorClass taught{name, spread(examples.inside, kTaughtSpread)};
  if (known >= 0) {
    more.classes[known] = taught;
  } else {
    more.classes.push_back(taught);
  }
  // Every lesson's surroundings weigh the same, however large its images.
  const double lessons = static_cast<double>(more.classes.size());
  more.background = blend(more.background, spread(examples.outside, kTaughtSpread), 1 / lessons);
  return more;
}

}  // namespace armsreach::gesture
