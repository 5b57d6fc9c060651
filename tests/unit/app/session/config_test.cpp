#include "app/session/config.hpp"

#include <sstream>

#include <gtest/gtest.h>

namespace armsreach::app {
namespace {

Result<Config> read(const std::string& text) {
  std::istringstream in(text);
  return read_config(in, "with-teapot.yaml");
}

TEST(Config, AnEmptyFileIsAllDefaults) {
  const auto config = read("");
  ASSERT_TRUE(config) << config.error().message();
  EXPECT_TRUE(config->mapping.enabled);
  EXPECT_EQ(config->tracking.alpha, 0.95);
}

TEST(Config, ReadsWhatItDocuments) {
  const auto config = read(
      "layout: operator\nsize: [1280, 720]\nthreads: false\nlag: 2\n"
      "tracking: {alpha: 1, iterations: 7, width: 160}\nmapping: {enabled: false, resolution: "
      "0.02}\n"
      "actions: [{frame: 30, click: [320, 240.5], view: live, insert: teapot}]\n");
  ASSERT_TRUE(config) << config.error().message();
  EXPECT_EQ(config->layout, "operator");
  EXPECT_EQ(config->height, 720);
  EXPECT_FALSE(config->threads);
  EXPECT_EQ(config->tracking.width, 160);
  EXPECT_FALSE(config->mapping.enabled);
  ASSERT_EQ(config->actions.size(), 1U);
  EXPECT_EQ(config->actions[0].frame, 30);
  EXPECT_EQ(config->actions[0].click.y(), 240.5);
  EXPECT_EQ(config->actions[0].insert, "teapot");
}

TEST(Config, AVoiceIsAutoOffOrAWavFile) {
  EXPECT_EQ(read("")->speech.voice, "auto");
  EXPECT_EQ(read("speech: {voice: off}")->speech.voice, "off");
  EXPECT_EQ(read("speech: {voice: out/what-was-said.wav}")->speech.voice, "out/what-was-said.wav");
  for (const char* text : {"speech: {voice: loud}", "speech: {voice: .wav}", "speech: {voice: ''}",
                           "speech: {voices: auto}", "speech: auto"}) {
    EXPECT_FALSE(read(text)) << text;
  }
}

TEST(Config, ReadsWhatAPlainCameraIsTrackedBy) {
  const auto config = read(
      "tracking: {method: mono}\n"
      "mono_slam: {target: sheet.yaml, stated_distance: 0.7, visible_points: 20, most_points: 80,\n"
      "  new_points: particles, forget_start_target_at: 60}\n");
  ASSERT_TRUE(config) << config.error().message();
  EXPECT_EQ(config->tracking.method, "mono");
  EXPECT_EQ(config->mono_slam.target, "sheet.yaml");
  EXPECT_EQ(config->mono_slam.stated_distance, 0.7);
  EXPECT_EQ(config->mono_slam.visible_points, 20);
  EXPECT_EQ(config->mono_slam.most_points, 80);
  EXPECT_EQ(config->mono_slam.new_points, "particles");
  EXPECT_EQ(config->mono_slam.forget_start_target_at, 60);
  EXPECT_FALSE(read("")->mono_slam.forget_start_target_at);
  for (const char* text :
       {"tracking: {method: stereo}", "mono_slam: {visible: 3}", "mono_slam: {new_points: lines}",
        "mono_slam: {visible_points: 50, most_points: 40}", "mono_slam: {stated_distance: 0}",
        "mono_slam: {forget_start_target_at: 0}"}) {
    EXPECT_FALSE(read(text)) << text;
  }
}

TEST(Config, GazeLeapsToThingsAndPlaces) {
  const auto config = read("gaze: {mode: saccade, target: [1, -0.5, 2]}\n");
  ASSERT_TRUE(config) << config.error().message();
  EXPECT_EQ(config->gaze.point_in_world, Eigen::Vector3d(1, -0.5, 2));
  EXPECT_EQ(read("gaze: {mode: fixate, target: 'point:12'}")->gaze.target, "point:12");
  EXPECT_TRUE(read("gaze: {mode: saccade, target: 'object:1'}"));
  for (const char* text :
       {"gaze: {target: [1, 2]}", "gaze: {target: [1, 2, 3]}", "gaze: {mode: stare}",
        "gaze: {mode: saccade, target: 'point:'}", "gaze: {mode: saccade, target: 'point:x'}",
        "gaze: {mode: follow, target: 'object:1'}",
        "gaze: {mode: saccade, target: [1, 2, .nan]}"}) {
    EXPECT_FALSE(read(text)) << text;
  }
}

TEST(Config, ReadsWhatTheWearableTakes) {
  const auto config = read(
      "gesture: {vocabulary: asl-digits, table: mine.yaml, window: 0.4, insert: '', reach: 1,\n"
      "  cursor_filter: {enabled: false}}\n"
      "gaze: {mode: follow, target: 'colour:mug'}\nshow: {rings: true}\n");
  ASSERT_TRUE(config) << config.error().message();
  EXPECT_EQ(config->gesture.vocabulary, "asl-digits");
  EXPECT_EQ(config->gesture.table, "mine.yaml");
  EXPECT_EQ(config->gesture.insert, "");
  EXPECT_FALSE(config->gesture.cursor_filter.enabled);
  EXPECT_EQ(config->gaze.target, "colour:mug");
  EXPECT_TRUE(config->show.rings);
  EXPECT_FALSE(read("gesture: {fingers: 5}"));
  EXPECT_FALSE(read("gaze: {target: 'colour:'}"));
  EXPECT_FALSE(read("gaze: {mode: stare}"));
  EXPECT_FALSE(read("show: {outline: true}"));
}

TEST(Config, RefusesByName) {
  const std::vector<std::pair<std::string, std::string>> broken = {
      {"mappings: {enabled: true}", "unknown key 'mappings'"},
      {"mapping: {resolutoin: 0.01}", "unknown key 'mapping.resolutoin'"},
      {"actions: [{frame: 1, click: [1, 1], insret: cube}]", "unknown key 'actions[0].insret'"},
      {"mapping: {resolution: -1}", "mapping.resolution"},
      {"mapping: {resolution: .nan}", "mapping.resolution"},
      {"tracking: {alpha: 2}", "tracking.alpha"},
      {"tracking: 7", "not a map"},
      {"layout: fancy", "layout"},
      {"size: [12]", "size"},
      {"size: [1, 1]", "size"},
      {"size: [640, 0]", "size"},
      {"size: [640.5, 480]", "size"},
      {"actions: {frame: 1}", "actions"},
      {"actions: [{frame: -1, click: [1, 1]}]", "actions[0].frame"},
      {"actions: [{view: left, click: [1, 1]}]", "actions[0].view"},
      {"actions: [{frame: 3}]", "neither click nor layout"},
      {"actions: [{click: [1]}]", "actions[0].click"},
      {"[1, 2", "YAML"},
      {"- 1", "not a map"},
  };
  for (const auto& [text, expected] : broken) {
    const auto config = read(text);
    ASSERT_FALSE(config) << text;
    EXPECT_NE(config.error().message().find(expected), std::string::npos)
        << text << " -> " << config.error().message();
    const bool parsed = expected != "YAML";  // yaml-cpp says the line itself
    EXPECT_EQ(config.error().where, parsed ? "with-teapot.yaml:1" : "with-teapot.yaml");
  }
}

}  // namespace
}  // namespace armsreach::app
