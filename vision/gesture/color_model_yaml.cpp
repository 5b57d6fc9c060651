#include "vision/gesture/color_model_yaml.hpp"

#include <cmath>
#include <vector>

#include "vision/core/yaml_map.hpp"

namespace armsreach::gesture {
namespace {

constexpr std::size_t kMostClasses = 100;
constexpr float kLargestCount = 1e9F;
constexpr double kParts = 1e6;  // what the counts of a class are written to add up to

constexpr const char* kRemedy =
    "write it again with `armsreach calibrate skin` or `armsreach learn colour`";

float count_from(const YAML::Node& node) {
  float value = 0;
  if (!YAML::convert<float>::decode(node, value) || !(value >= 0 && value <= kLargestCount))
    throw YamlComplaint(node, "holds something that is not a number from 0 up");
  return value;
}

int cell_from(const YAML::Node& node) {
  int value = 0;
  if (!YAML::convert<int>::decode(node, value) || value < 0 || value >= kUvSide)
    throw YamlComplaint(node, "a row of uv does not begin with v and u, 0 to 127");
  return value;
}

void read_row(const YAML::Node& row, ColorHistogram* histogram) {
  if (!row.IsSequence() || row.size() < 3)
    throw YamlComplaint(row, "a row of uv is not [v, u, count, ...]");
  const int v = cell_from(row[0]);
  const int u = cell_from(row[1]);
  if (row.size() - 2 > static_cast<std::size_t>(kUvSide - u))
    throw YamlComplaint(row, "a row of uv is longer than the 128 cells there are");
  for (std::size_t i = 2; i < row.size(); ++i)
    histogram->uv(v, u + static_cast<int>(i) - 2) = count_from(row[i]);
}

ColorHistogram histogram_from(YamlMap& map, const std::string& name) {
  ColorHistogram histogram;
  const YAML::Node luma = map.find("luma");
  if (!luma.IsSequence() || luma.size() != kLumas)
    throw map.complaint(name + " has no luma of 16 numbers");
  for (int i = 0; i < kLumas; ++i) histogram.luma[i] = count_from(luma[i]);
  const YAML::Node uv = map.find("uv");
  if (!uv.IsSequence()) throw map.complaint(name + " has no list uv");
  for (const YAML::Node& row : uv) read_row(row, &histogram);
  if (histogram.empty()) throw map.complaint(name + " has no pixels");
  return histogram;
}

void read_channels(YamlMap& map, const std::string& key, double least, double most,
                   cv::Vec3f* channels) {
  if (!map.find(key)) return;
  const Eigen::Vector3d values = map.vector<3>(key);
  if (values.minCoeff() < least || values.maxCoeff() > most)
    throw map.complaint(key, "is not three numbers in their range");
  for (int i = 0; i < 3; ++i) (*channels)[i] = static_cast<float>(values[i]);
}

ColorClass class_from(YamlMap map, const ColorModel& model) {
  map.expect({"name", "luma", "uv"});
  const std::string name = map.text("name");
  if (class_named(model, name) >= 0) throw map.complaint("two classes are named '" + name + "'");
  return {name, histogram_from(map, "class '" + name + "'")};
}

ColorModel model_from(const YAML::Node& root) {
  YamlMap map(root, "");
  map.expect({"cells", "with_luma", "level", "balance", "background", "classes"});
  ColorModel model;
  if (map.number("cells", 0, kUvSide) != kUvSide) throw map.complaint("cells", "is not 128");
  model.with_luma = map.find("with_luma") ? map.flag("with_luma") : model.with_luma;
  read_channels(map, "level", 0, 255, &model.level);
  read_channels(map, "balance", 0.25, 3.9, &model.balance);
  if (!map.find("background")) throw map.complaint("the model has no background");
  YamlMap background = map.section("background");
  model.background = histogram_from(background, "background");
  const YAML::Node classes = map.find("classes");
  if (!classes.IsSequence() || classes.size() == 0 || classes.size() > kMostClasses)
    throw map.complaint("the model has no list of 1 to 100 classes");
  for (const YAML::Node& node : classes) model.classes.push_back(class_from({node, ""}, model));
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
  return read_yaml(in, where, kRemedy, model_from);
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
