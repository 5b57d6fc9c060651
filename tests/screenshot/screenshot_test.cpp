// Golden pictures of both layouts, drawn by EGL and by OSMesa and compared with the same files.
#include <cmath>
#include <limits>
#include <memory>
#include <string>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "render/context.hpp"
#include "render/renderer.hpp"
#include "tests/screenshot/golden.hpp"
#include "tests/screenshot/tiny_world.hpp"

namespace armsreach::render::test {
namespace {

Camera bent_camera(int width, int height) {
  Camera camera = pinhole(width, height, 0.82 * width, 0.82 * width, 0.5 * width, 0.49 * height);
  camera.coefficients = {-0.22, 0.06, 0.001, -0.0005, 0};
  return camera;
}

Scene full_scene(int width, int height) {
  Scene scene = tiny_scene(bent_camera(width, height), world_from_viewer());
  scene.objects = {standing(1, "teapot", -0.02, 0.02), standing(2, "cube", 0.24, 0.0),
                   standing(3, "axes", 0.22, -0.18), standing(4, "table", 0.3, 0.24)};
  scene.objects[1].selected = true;
  scene.labels = {{"teapot", {-0.02, 0.02, 0.15}}, {"block", {-0.12, -0.13, 0.11}}};
  for (int i = 0; i < 12; ++i) {
    Feature feature;
    const double angle = 0.7 * i;
    feature.pixel = {static_cast<float>(width * (0.5 + 0.42 * std::cos(angle))),
                     static_cast<float>(height * (0.5 + 0.4 * std::sin(1.9 * angle)))};
    const float c = std::cos(static_cast<float>(i));
    const float s = std::sin(static_cast<float>(i));
    const Eigen::Matrix2f turn{{c, -s}, {s, c}};
    feature.covariance = turn * Eigen::Vector2f(9, 2).asDiagonal() * turn.transpose();
    if (i % 6 == 0) feature.covariance.setZero();
    feature.state = static_cast<FeatureState>(i % 3);
    scene.features.push_back(feature);
  }
  scene.cursors = {
      {{0.72F * static_cast<float>(width), 0.8F * static_cast<float>(height)}, true, "point"}};
  Trail trail;
  trail.color = {0.35F, 0.84F, 0.75F};
  for (int i = 0; i <= 40; ++i)
    trail.points_in_world.emplace_back(-0.5F + 0.024F * static_cast<float>(i), -0.3F,
                                       0.02F + 0.05F * std::sin(0.3F * static_cast<float>(i)));
  scene.trails = {trail};
  scene.surface = tiny_surface(0.01F);
  scene.tracking_rms = 0.94;
  scene.tracking_inliers = 4123;
  scene.frame_rate = 30;
  scene.latency = 0.038;
  scene.stages = {{"tracker", 42, 0, 0.0007, 0.0009, 0.0012},
                  {"mapper", 14, 1, 0.011, 0.016, 0.02}};
  scene.messages = {{Severity::info, "teapot inserted"}, {Severity::warning, "depth has holes"}};
  return scene;
}

class Screenshot : public testing::TestWithParam<ContextKind> {
 protected:
  void SetUp() override {
    auto context = make_context({.kind = GetParam()});
    ASSERT_TRUE(context.ok()) << context.error().message();
    context_ = *std::move(context);
  }

  std::unique_ptr<Renderer> renderer(const RendererOptions& options) {
    auto made = Renderer::make(*context_, options);
    if (!made) {
      ADD_FAILURE() << made.error().message();
      return nullptr;
    }
    EXPECT_TRUE((*made)->take_notes().empty()) << "fonts are missing: see ./dev setup";
    return *std::move(made);
  }

  std::unique_ptr<Context> context_;
};

TEST_P(Screenshot, Wearer) {
  const auto drawing = renderer({.width = 320, .height = 240});
  drawing->draw(full_scene(320, 240), {});
  EXPECT_TRUE(matches_golden(drawing->read_picture(), "wearer"));
}

TEST_P(Screenshot, WearerLetterboxedWithInliersAndNoPose) {
  const auto drawing = renderer({.width = 400, .height = 240});
  Scene scene = full_scene(320, 240);
  scene.pose_known = false;
  scene.tracking_state = "lost";
  scene.inliers = cv::Mat(60, 80, CV_32F, cv::Scalar(1));
  scene.inliers(cv::Rect(20, 15, 40, 30)).setTo(0.1);
  drawing->show_inliers(true);
  drawing->draw(scene, {});
  EXPECT_TRUE(matches_golden(drawing->read_picture(), "wearer_lost"));
}

// A hand with the outline of an ellipse that comes in over the lower border.
Hand hand_at(float x, float y, float size) {
  Hand hand;
  hand.center = hand.tip = {x, y};
  hand.size = size;
  for (int i = 0; i < 48; ++i) {
    const float angle = 0.1309F * static_cast<float>(i);
    hand.outline.emplace_back(x + 0.5F * size * std::cos(angle), y + 0.8F * size * std::sin(angle));
  }
  return hand;
}

// A plain colour camera: no tracking, no pose.
TEST_P(Screenshot, Hands) {
  const auto drawing = renderer({.width = 480, .height = 360});
  Scene scene = tiny_scene(pinhole(480, 360, 400, 400, 239.5, 179.5), world_from_viewer());
  scene.pose_known = false;
  scene.tracking_state.clear();
  Hand pointing = hand_at(130, 290, 110);
  pointing.gesture = "point";
  pointing.score = 0.93F;
  for (int i = 1; i <= 6; ++i) pointing.rings.push_back(18.F * static_cast<float>(i));
  Hand grasping = hand_at(390, 230, 70);
  grasping.gesture = "grasp";
  grasping.score = 0.88F;
  grasping.angle = -0.8F;
  grasping.wedge = 0.26F;
  Hand unknown = hand_at(430, 60, 50);
  scene.hands = {pointing, grasping, unknown};
  scene.cursors = {{{130, 196}, true, ""}};
  scene.marks = {{"mug", {255, 70}, {50, 60}, true}, {"ball", {30, 60}, {40, 40}, false}};
  drawing->draw(scene, {});
  EXPECT_TRUE(matches_golden(drawing->read_picture(), "hands"));
}

// What is not a number is left out, not drawn somewhere.
TEST_P(Screenshot, AHandThatIsNowhereIsNotDrawn) {
  const auto drawing = renderer({.width = 320, .height = 240});
  Scene scene = full_scene(320, 240);
  drawing->draw(scene, {});
  const cv::Mat without = drawing->read_picture();
  Hand nowhere = hand_at(100, 100, 50);
  nowhere.center.x() = std::numeric_limits<float>::quiet_NaN();
  scene.hands = {nowhere};
  drawing->draw(scene, {});
  EXPECT_EQ(cv::norm(without, drawing->read_picture(), cv::NORM_INF), 0);
}

TEST_P(Screenshot, OperatorDesk) {
  const auto drawing = renderer({.width = 960, .height = 540, .layout = Layout::operator_desk});
  drawing->draw(full_scene(320, 240), {});
  EXPECT_TRUE(matches_golden(drawing->read_picture(), "desk"));
}

// A plain camera's map: points of each state, one of them hardly known, one still guessed at.
TEST_P(Screenshot, SparseMap) {
  const auto drawing = renderer({.width = 960, .height = 540, .layout = Layout::operator_desk});
  Scene scene = tiny_scene(pinhole(320, 240, 262, 262, 159.5, 119.5), world_from_viewer());
  scene.depth.release();
  scene.up_in_world = {0, 0, 1};
  scene.world_axes = true;
  for (int i = 0; i < 24; ++i) {
    MapPoint point;
    point.point_in_world = {-0.45F + 0.18F * static_cast<float>(i % 6),
                            -0.3F + 0.2F * static_cast<float>(i / 6), 0};
    const float along = 1e-5F * static_cast<float>(1 + i * i);
    point.covariance = Eigen::Vector3f(2e-5F, along, 1e-5F).asDiagonal();
    point.state = static_cast<FeatureState>(i % 5 == 0 ? 2 : 1);
    if (i == 9) point.covariance *= 400;
    if (i == 9) point.state = FeatureState::candidate;
    scene.points.push_back(point);
  }
  for (int i = 0; i < 20; ++i) {
    const float t = 0.05F * static_cast<float>(i);
    scene.particles.push_back({{0.5F, -0.4F + t, 0.3F * t}, 1 - t});
  }
  drawing->draw(scene, {});
  EXPECT_TRUE(matches_golden(drawing->read_picture(), "sparse"));
}

TEST_P(Screenshot, SamePictureTwice) {
  const auto drawing = renderer({.width = 320, .height = 240});
  const Scene scene = full_scene(320, 240);
  drawing->draw(scene, {});
  const cv::Mat first = drawing->read_picture();
  drawing->draw(scene, {});
  EXPECT_EQ(cv::norm(first, drawing->read_picture(), cv::NORM_INF), 0);
}

INSTANTIATE_TEST_SUITE_P(Kinds, Screenshot, testing::Values(ContextKind::egl, ContextKind::osmesa),
                         [](const auto& kind) { return std::string(name(kind.param)); });

TEST(Golden, ComparisonSeesAMovedEdgeAndForgivesASmoothedOne) {
  cv::Mat picture(100, 100, CV_8UC3, cv::Scalar::all(200));
  picture(cv::Rect(20, 20, 40, 40)).setTo(cv::Scalar::all(80));
  cv::Mat moved(100, 100, CV_8UC3, cv::Scalar::all(200));
  moved(cv::Rect(22, 20, 40, 40)).setTo(cv::Scalar::all(80));
  EXPECT_GT(share_that_differs(picture, moved), 0.003);
  cv::Mat smoothed = picture.clone();
  smoothed(cv::Rect(20, 20, 1, 40)).setTo(cv::Scalar::all(110));
  EXPECT_LT(share_that_differs(picture, smoothed), 0.003);
}

}  // namespace
}  // namespace armsreach::render::test
