// A map goes from a run to a mesh that any viewer of meshes opens.
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/program.hpp"

namespace armsreach::test {
namespace {

using ::testing::HasSubstr;

struct PlyHeader {
  std::size_t vertices = 0;
  std::size_t faces = 0;
  std::size_t body = 0;  // bytes after the header
};

PlyHeader read_header(const std::filesystem::path& path) {
  const std::string bytes = read_text(path);
  std::istringstream in(bytes);
  PlyHeader header;
  for (std::string line; std::getline(in, line) && line != "end_header";) {
    std::istringstream words(line);
    std::string word;
    std::string what;
    std::size_t count = 0;
    words >> word >> what >> count;
    if (word == "element") (what == "face" ? header.faces : header.vertices) = count;
  }
  header.body = bytes.size() - static_cast<std::size_t>(in.tellg());
  return header;
}

TEST(EndToEndExport, MeshAndCloudOfASavedMap) {
  TemporaryFolder folder;
  const std::string map = folder / "map.ot";
  const ProgramResult run =
      run_armsreach({"run", "--source", "sim:bench", "--frames", "12", "--pace", "every-frame",
                     "--display", "none", "--map", map});
  ASSERT_EQ(run.exit_code, 0) << run.output;
  const ProgramResult mesh = run_armsreach({"export", map, "--out", folder / "mesh.ply"});
  ASSERT_EQ(mesh.exit_code, 0) << mesh.output;
  const ProgramResult cloud =
      run_armsreach({"export", map, "--out", folder / "cloud.ply", "--cloud"});
  ASSERT_EQ(cloud.exit_code, 0) << cloud.output;

  const PlyHeader of_mesh = read_header(folder / "mesh.ply");
  const PlyHeader of_cloud = read_header(folder / "cloud.ply");
  // The bench's view is about a square metre of surface: ten thousand voxel faces.
  EXPECT_GT(of_mesh.vertices, 5000U);
  EXPECT_GT(of_mesh.faces, of_mesh.vertices) << "nearly two triangles a vertex";
  EXPECT_EQ(of_mesh.body, 27 * of_mesh.vertices + 13 * of_mesh.faces);
  EXPECT_EQ(of_cloud.vertices, of_mesh.vertices);
  EXPECT_EQ(of_cloud.faces, 0U);
  EXPECT_EQ(of_cloud.body, 27 * of_cloud.vertices);
  EXPECT_THAT(mesh.output, HasSubstr("triangles"));
  EXPECT_THAT(mesh.output, HasSubstr("m2"));
}

TEST(EndToEndExport, StockToolsReadASavedMapAndWhatTheyWriteIsExported) {
  if (std::system("command -v convert_octree >/dev/null") != 0) {
    GTEST_SKIP() << "install octomap-tools";
  }
  TemporaryFolder folder;
  const std::string map = folder / "map.ot";
  const std::string theirs = folder / "theirs.ot";
  ASSERT_EQ(run_armsreach({"run", "--source", "sim:bench", "--frames", "6", "--pace", "every-frame",
                           "--display", "none", "--map", map})
                .exit_code,
            0);
  const std::string convert = "convert_octree " + map + " " + theirs + " >/dev/null 2>&1";
  ASSERT_EQ(std::system(convert.c_str()), 0);
  for (const std::string& tree : {map, theirs}) {
    const ProgramResult result = run_armsreach({"export", tree, "--out", tree + ".ply"});
    ASSERT_EQ(result.exit_code, 0) << result.output;
  }
  // Theirs has occupancy alone: its surface is an estimate of the same surface.
  const auto ours = static_cast<double>(read_header(map + ".ply").vertices);
  EXPECT_NEAR(static_cast<double>(read_header(theirs + ".ply").vertices), ours, 0.3 * ours);
}

TEST(EndToEndExport, WhatCannotBeExportedIsSaidWithItsRemedy) {
  TemporaryFolder folder;
  write_text(folder / "empty.ot",
             "# Octomap OcTree file\nid ColorOcTree\nsize 0\nres 0.01\ndata\n");
  write_text(folder / "notes.ot", "milk, bread\n");
  const std::string out = folder / "out.ply";
  const std::vector<std::pair<std::vector<std::string>, std::string>> wrong = {
      {{"export"}, "map is required"},
      {{"export", folder / "empty.ot"}, "--out is required"},
      {{"export", "/no/such/map.ot", "--out", out}, "/no/such/map.ot: cannot be opened"},
      {{"export", folder / "notes.ot", "--out", out}, "not an OctoMap file"},
      {{"export", folder.path(), "--out", out}, "not an OctoMap file"},
      {{"export", folder / "empty.ot", "--out", out}, "has no surface"},
  };
  for (const auto& [arguments, expected] : wrong) {
    const ProgramResult result = run_armsreach(arguments);
    EXPECT_EQ(result.exit_code, 2) << result.output;
    EXPECT_THAT(result.output, HasSubstr(expected));
    EXPECT_FALSE(std::filesystem::exists(out)) << "nothing is written";
  }
}

TEST(EndToEndExport, AFolderThatIsNotThereIsNamed) {
  TemporaryFolder folder;
  const std::string map = folder / "map.ot";
  ASSERT_EQ(run_armsreach({"run", "--source", "sim:bench", "--frames", "2", "--pace", "every-frame",
                           "--display", "none", "--map", map})
                .exit_code,
            0);
  const ProgramResult result = run_armsreach({"export", map, "--out", folder / "no" / "mesh.ply"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.output, HasSubstr("mesh.ply: cannot be written"));
}

}  // namespace
}  // namespace armsreach::test
