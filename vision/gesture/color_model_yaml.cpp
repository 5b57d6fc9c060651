#include "vision/gesture/color_model_yaml.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <utility>
#include <vector>

#include <yaml-cpp/yaml.h>

namespace armsreach::gesture {
namespace {

constexpr std::size_t kMostClasses = 100;
constexpr float kLargestCount = 1e9F;
constexpr double kParts = 1e6;  // what the counts of a class are written to add up to

Error complaint(const YAML::Node& node, const std::string& where, const std::string& what) {
  std::string place = where;
  if (!node.Mark().is_null()) place.append(":").append(std::to_string(node.Mark().line + 1));
  return {what, place,
          "write it again with `armsreach calibrate skin` or `armsreach learn colour`"};
}

Status check_keys(const YAML::Node& map, const std::string& where, const std::string& what,
                  std::initializer_list<const char*> known) {
  if (!map.IsMap()) return complaint(map, where, what + " is not a map");
  for (const auto& entry : map) {
    const std::string key = entry.first.IsScalar() ? entry.first.Scalar() : "?";
    if (std::find(known.begin(), known.end(), key) != known.end()) continue;
    return complaint(entry.first, where, "unknown key '" + key + "' in " + what);
  }
  return ok();
}

Result<float> read_number(const YAML::Node& node, const std::string& where, float most) {
  float value = 0;
  if (!YAML::convert<float>::decode(node, value) || !(value >= 0 && value <= most)) {
    return complaint(node, where, "holds something that is not a number from 0 up");
  }
  return value;
}

Result<int> read_cell(const YAML::Node& node, const std::string& where) {
  int value = 0;
  if (!YAML::convert<int>::decode(node, value) || value < 0 || value >= kUvSide) {
    return complaint(node, where, "a row of uv does not begin with v and u, 0 to 127");
  }
  return value;
}

Status read_row(const YAML::Node& row, const std::string& where, ColorHistogram* histogram) {
  if (!row.IsSequence() || row.size() < 3) {
    return complaint(row, where, "a row of uv is not [v, u, count, ...]");
  }
  auto v = read_cell(row[0], where);
  if (!v) return std::move(v).error();
  auto u = read_cell(row[1], where);
  if (!u) return std::move(u).error();
  if (row.size() - 2 > static_cast<std::size_t>(kUvSide - *u)) {
    return complaint(row, where, "a row of uv is longer than the 128 cells there are");
  }
  for (std::size_t i = 2; i < row.size(); ++i) {
    auto count = read_number(row[i], where, kLargestCount);
    if (!count) return std::move(count).error();
    histogram->uv(*v, *u + static_cast<int>(i) - 2) = *count;
  }
  return ok();
}

Result<ColorHistogram> read_histogram(const YAML::Node& node, const std::string& where,
                                      const std::string& name) {
  ColorHistogram histogram;
  const YAML::Node luma = node["luma"];
  if (!luma || !luma.IsSequence() || luma.size() != kLumas) {
    return complaint(node, where, name + " has no luma of 16 numbers");
  }
  for (int i = 0; i < kLumas; ++i) {
    auto count = read_number(luma[i], where, kLargestCount);
    if (!count) return std::move(count).error();
    histogram.luma[i] = *count;
  }
  const YAML::Node uv = node["uv"];
  if (!uv || !uv.IsSequence()) return complaint(node, where, name + " has no list uv");
  for (const YAML::Node& row : uv) {
    if (auto status = read_row(row, where, &histogram); !status) return status.error();
  }
  if (histogram.empty()) return complaint(node, where, name + " has no pixels");
  return histogram;
}

Result<cv::Vec3f> read_channels(const YAML::Node& node, const std::string& where, float least,
                                float most) {
  cv::Vec3f channels;
  bool good = node.IsSequence() && node.size() == 3;
  for (int i = 0; good && i < 3; ++i) {
    good = YAML::convert<float>::decode(node[i], channels[i]) && channels[i] >= least &&
           channels[i] <= most;
  }
  if (!good) return complaint(node, where, "level or balance is not three numbers in their range");
  return channels;
}

Result<ColorClass> read_class(const YAML::Node& node, const std::string& where,
                              const ColorModel& model) {
  const auto keys = check_keys(node, where, "a class", {"name", "luma", "uv"});
  if (!keys) return keys.error();
  const YAML::Node name = node["name"];
  if (!name || !name.IsScalar() || name.Scalar().empty()) {
    return complaint(node, where, "a class has no name");
  }
  if (class_named(model, name.Scalar()) >= 0) {
    return complaint(name, where, "two classes are named '" + name.Scalar() + "'");
  }
  auto pixels = read_histogram(node, where, "class '" + name.Scalar() + "'");
  if (!pixels) return std::move(pixels).error();
  return ColorClass{name.Scalar(), std::move(*pixels)};
}

Status read_settings(const YAML::Node& root, const std::string& where, ColorModel* model) {
  int cells = 0;
  if (!root["cells"] || !YAML::convert<int>::decode(root["cells"], cells) || cells != kUvSide) {
    return complaint(root, where, "entry 'cells' is not 128");
  }
  const YAML::Node luma = root["with_luma"];
  if (luma && !YAML::convert<bool>::decode(luma, model->with_luma)) {
    return complaint(luma, where, "with_luma is neither true nor false");
  }
  if (root["level"]) {
    auto level = read_channels(root["level"], where, 0, 255);
    if (!level) return std::move(level).error();
    model->level = *level;
  }
  if (root["balance"]) {
    auto balance = read_channels(root["balance"], where, 0.25F, 3.9F);
    if (!balance) return std::move(balance).error();
    model->balance = *balance;
  }
  return ok();
}

Result<ColorModel> read_checked(const YAML::Node& root, const std::string& where) {
  const auto keys = check_keys(root, where, "the model",
                               {"cells", "with_luma", "level", "balance", "background", "classes"});
  if (!keys) return keys.error();
  ColorModel model;
  if (auto status = read_settings(root, where, &model); !status) return status.error();
  const YAML::Node background = root["background"];
  if (!background || !background.IsMap()) {
    return complaint(root, where, "the model has no background");
  }
  auto pixels = read_histogram(background, where, "background");
  if (!pixels) return std::move(pixels).error();
  model.background = std::move(*pixels);
  const YAML::Node classes = root["classes"];
  if (!classes || !classes.IsSequence() || classes.size() == 0 || classes.size() > kMostClasses) {
    return complaint(root, where, "the model has no list of 1 to 100 classes");
  }
  for (const YAML::Node& node : classes) {
    auto one = read_class(node, where, model);
    if (!one) return std::move(one).error();
    model.classes.push_back(std::move(*one));
  }
  return model;
}

// The runs of row v that hold something; a single 0 between two is cheaper than another run.
void write_row(std::ostream& out, const std::string& indent, int v, const std::vector<long>& row) {
  const auto empty = [&](std::size_t u) { return u >= row.size() || row[u] == 0; };
  for (std::size_t begin = 0; begin < row.size(); ++begin) {
    if (empty(begin)) continue;
    std::size_t end = begin;
    while (!empty(end) || (end < row.size() && !empty(end + 1))) ++end;
    out << indent << "  - [" << v << ", " << begin;
    for (std::size_t u = begin; u < end; ++u) out << ", " << row[u];
    out << "]\n";
    begin = end;
  }
}

void write_histogram(std::ostream& out, const std::string& indent,
                     const ColorHistogram& histogram) {
  const double scale = histogram.empty() ? 0 : kParts / histogram.count();
  const auto parts = [&](float count) { return std::lround(scale * static_cast<double>(count)); };
  out << indent << "luma: [";
  for (int i = 0; i < kLumas; ++i) out << (i > 0 ? ", " : "") << parts(histogram.luma[i]);
  out << "]\n" << indent << "uv:\n";
  std::vector<long> row(kUvSide);
  for (int v = 0; v < kUvSide; ++v) {
    for (int u = 0; u < kUvSide; ++u) row[u] = parts(histogram.uv(v, u));
    write_row(out, indent, v, row);
  }
}

void write_channels(std::ostream& out, const char* key, const cv::Vec3f& channels) {
  out << key << ": [" << channels[0] << ", " << channels[1] << ", " << channels[2] << "]\n";
}

}  // namespace

Result<ColorModel> read_color_model(std::istream& in, const std::string& where) {
  try {
    return read_checked(YAML::Load(in), where);
  } catch (const YAML::Exception& e) {
    return Error{"not readable as YAML: " + std::string(e.what()), where,
                 "write it again with `armsreach calibrate skin` or `armsreach learn colour`"};
  }
}

void write_color_model(std::ostream& out, const ColorModel& model) {
  out << "cells: " << kUvSide << "\nwith_luma: " << (model.with_luma ? "true" : "false") << "\n";
  write_channels(out, "level", model.level);
  write_channels(out, "balance", model.balance);
  out << "background:\n";
  write_histogram(out, "  ", model.background);
  out << "classes:\n";
  for (const ColorClass& one : model.classes) {
    YAML::Emitter name;
    name << YAML::DoubleQuoted << one.name;
    out << "  - name: " << name.c_str() << "\n";
    write_histogram(out, "    ", one.pixels);
  }
}

}  // namespace armsreach::gesture
