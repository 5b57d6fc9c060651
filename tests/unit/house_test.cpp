// The floors of the house: a file includes only from its own floor or below.
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace {

namespace fs = std::filesystem;

// A room is the part of a path that a floor is made of: "vision/core", "render", "devices/sim", ...
std::string room_of(const std::string& path) {
  const auto first = path.find('/');
  const std::string top = path.substr(0, first);
  if (top == "vision") return path.substr(0, path.find('/', first + 1));
  if (path.rfind("devices/sim/", 0) == 0) return "devices/sim";
  return top;
}

// What a room may include from, besides itself.
std::set<std::string> rooms_below(const std::string& room) {
  if (room == "vision/core") return {};
  if (room == "render" || room == "devices" || room.rfind("vision/", 0) == 0)
    return {"vision/core"};
  if (room == "devices/sim") return {"vision/core", "devices", "render"};
  return {"*"};  // app and tests
}

bool allowed(const std::string& from, const std::string& to) {
  if (from == to) return true;
  const std::set<std::string> below = rooms_below(from);
  return (below.count("*") && to != "tests") || below.count(to);
}

std::vector<std::string> climbs(const std::string& file, std::istream& text) {
  static const std::regex include(
      R"(^\s*#\s*include\s*"((app|render|vision|devices|tests)/[^"]+)\")");
  std::vector<std::string> found;
  std::string line;
  while (std::getline(text, line)) {
    std::smatch match;
    if (!std::regex_search(line, match, include)) continue;
    if (!allowed(room_of(file), room_of(match[1])))
      found.push_back(file + " includes " + match[1].str());
  }
  return found;
}

TEST(House, NoIncludeClimbsAFloor) {
  const fs::path root = ARMSREACH_SOURCE_DIR;
  int files = 0;
  for (const char* top : {"app", "render", "vision", "devices"}) {
    for (const auto& entry : fs::recursive_directory_iterator(root / top)) {
      const std::string extension = entry.path().extension();
      if (extension != ".cpp" && extension != ".hpp") continue;
      ++files;
      std::ifstream text(entry.path());
      for (const std::string& climb : climbs(fs::relative(entry.path(), root), text)) {
        ADD_FAILURE() << climb;
      }
    }
  }
  EXPECT_GT(files, 10);
}

TEST(House, TheCheckItselfFindsAClimb) {
  std::istringstream text("#include \"app/cli.hpp\"\n#include \"vision/mapping/map.hpp\"\n");
  EXPECT_EQ(climbs("vision/alignment/aligner.cpp", text).size(), 2U);
  std::istringstream fine("#include \"vision/core/pose.hpp\"\n");
  EXPECT_TRUE(climbs("render/scene.hpp", fine).empty());
}

}  // namespace
