// What a reader of YAML says of a file that is wrong.
#include "vision/core/yaml_map.hpp"

#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace armsreach {
namespace {

using ::testing::Eq;
using ::testing::HasSubstr;

// A file such as {box: {width: 2}, points: [{x: 1}, {x: 2}]}: the sum of its numbers.
double sum_from(const YAML::Node& root) {
  YamlMap map(root, "");
  YamlMap box = map.section("box");
  double sum = box.number("width", 0, 10, 0);
  box.refuse_others();
  if (map.find("points")) {
    for (YamlMap& point : map.items("points"))
      sum += with_remedy("a point has x", [&] { return point.number("x", 0, 10); });
  }
  map.refuse_others();
  return sum;
}

Result<double> read(const std::string& text) {
  std::istringstream in(text);
  return read_yaml(in, "file.yaml", "see the manual", sum_from);
}

TEST(YamlMap, ReadsWhatIsThere) {
  EXPECT_EQ(*read("box: {width: 2}\npoints: [{x: 1}, {x: 2}]"), 5);
  EXPECT_EQ(*read("box:\n"), 0) << "nothing is a map without entries";
  EXPECT_EQ(*read(""), 0);
}

TEST(YamlMap, ComplainsByPathAndLine) {
  struct Broken {
    std::string text, what, where, remedy;
  };
  const std::vector<Broken> all = {
      {"box:\n  width: 11", "'box.width' is not from 0 to 10", "file.yaml:2", "see the manual"},
      {"box:\n  hieght: 1", "unknown key 'box.hieght'; known here: width", "file.yaml:2", ""},
      {"points:\n  - {x: 1}\n  - {}", "'points[1].x' is missing", "file.yaml:3", "a point has x"},
      {"points: 3", "'points' is not a list", "file.yaml:1", "see the manual"},
      {"\nbox: 3", "'box' is not a map", "file.yaml:2", ""},
      {"[1]", "is not a map", "file.yaml:1", ""},
      {"box: [", "not readable as YAML", "file.yaml", "see the manual"},
  };
  for (const Broken& broken : all) {
    const auto sum = read(broken.text);
    ASSERT_FALSE(sum) << broken.text;
    EXPECT_THAT(sum.error().what, HasSubstr(broken.what));
    EXPECT_THAT(sum.error().where, Eq(broken.where));
    EXPECT_THAT(sum.error().remedy, HasSubstr(broken.remedy));
  }
}

}  // namespace
}  // namespace armsreach
