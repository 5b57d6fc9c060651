// What a user who mistypes is told, and with which exit code.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/program.hpp"

namespace armsreach::test {
namespace {

using ::testing::HasSubstr;

TEST(EndToEndCommandLine, HelpEverywhere) {
  for (const std::vector<std::string>& verb :
       std::vector<std::vector<std::string>>{{},
                                             {"run"},
                                             {"record"},
                                             {"demo"},
                                             {"sources"},
                                             {"evaluate"},
                                             {"evaluate", "trajectory"},
                                             {"evaluate", "gaze"},
                                             {"export"}}) {
    std::vector<std::string> arguments = verb;
    arguments.push_back("--help");
    const ProgramResult result = run_armsreach(arguments);
    EXPECT_EQ(result.exit_code, 0) << result.output;
    EXPECT_THAT(result.output, HasSubstr("Usage"));
  }
}

TEST(EndToEndCommandLine, SourcesSaysWhatCannotBeOpenedAndWhy) {
  const ProgramResult result = run_armsreach({"sources"});
  EXPECT_EQ(result.exit_code, 0);
  for (const char* kind : {"tum:", "images:", "video:", "camera:", "sim:bench"}) {
    EXPECT_THAT(result.output, HasSubstr(kind));
  }
}

TEST(EndToEndCommandLine, WrongCommandsExitWithTwoAndSayWhatToDo) {
  TemporaryFolder folder;
  write_text(folder / "typo.yaml", "mappings: {}\n");
  write_text(folder / "loop.yaml", "threads: false\n");
  write_text(folder / "mesh.yaml", "actions: [{click: [1, 1], insert: teapott}]\n");
  write_text(folder / "unmapped.yaml", "mapping: {enabled: false}\n");
  write_text(folder / "camera.yaml", "image_width: -3\n");
  const std::string typo = folder / "typo.yaml";
  const std::string loop = folder / "loop.yaml";
  const std::string camera = folder / "camera.yaml";
  const std::vector<std::pair<std::vector<std::string>, std::string>> wrong = {
      {{}, "subcommand"},
      {{"runn"}, "subcommand"},
      {{"run"}, "--source"},
      {{"run", "--source", "tum:/no/such/folder"}, "/no/such/folder"},
      {{"run", "--source", "sim:nowhere"}, "nowhere"},
      {{"run", "--source", "magic:1"}, "magic"},
      {{"run", "--source", "sim:bench,speeed=2"}, "speeed"},
      {{"run", "--source", "sim:bench", "--frames", "-3"}, "--frames"},
      {{"run", "--source", "sim:bench", "--pace", "slow"}, "--pace"},
      {{"run", "--source", "sim:bench", "--experience", "cooking"}, "cooking"},
      {{"run", "--source", "sim:bench", "--config", "/no/such.yaml"}, "/no/such.yaml"},
      {{"run", "--source", "sim:bench", "--config", typo}, "mappings"},
      {{"run", "--source", "sim:bench", "--config", loop}, "every-frame"},
      {{"run", "--source", "sim:bench", "--config", folder.path()}, "cannot be opened"},
      {{"run", "--source", "sim:bench", "--config", folder / "mesh.yaml"}, "teapott"},
      {{"run", "--source", "sim:bench", "--config", folder / "unmapped.yaml", "--map", "m.ot"},
       "--map"},
      {{"run", "--source", "sim:bench", "--camera", camera}, "image_width"},
      {{"run", "--source", "sim:bench", "--display", "none", "--record", "a.mp4"}, "--record"},
      {{"run", "--source", "sim:bench", "--display", "egl", "--frames", "1", "--trajectory",
        "/no/such/folder/t.txt"},
       "/no/such/folder/t.txt"},
      {{"evaluate", "trajectory", "--estimate", "/no/a", "--truth", "/no/b"}, "/no/a"},
  };
  for (const auto& [arguments, expected] : wrong) {
    const ProgramResult result = run_armsreach(arguments);
    EXPECT_EQ(result.exit_code, 2) << result.output;
    EXPECT_THAT(result.output, HasSubstr(expected));
  }
}

}  // namespace
}  // namespace armsreach::test
