// What the live view draws, checked by measurement: projection through every lens, occlusion,
// contact shadows, clicks.
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "render/context.hpp"
#include "render/renderer.hpp"
#include "tests/screenshot/tiny_world.hpp"

namespace armsreach::render::test {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

class LiveView : public testing::TestWithParam<ContextKind> {
 protected:
  void SetUp() override {
    auto context = make_context({.kind = GetParam()});
    ASSERT_TRUE(context.ok()) << context.error().message();
    context_ = *std::move(context);
  }
  cv::Mat picture_of(const Scene& scene, int width, int height) {
    auto renderer = Renderer::make(*context_, {.width = width, .height = height});
    EXPECT_TRUE(renderer.ok());
    (*renderer)->draw(scene, {});
    return (*renderer)->read_picture();
  }
  std::unique_ptr<Context> context_;
};

std::vector<Camera> bent_cameras() {
  Camera plumb_bob = pinhole(640, 480, 400, 402, 322, 238);
  plumb_bob.coefficients = {-0.28, 0.08, 0.002, -0.001, -0.008};
  Camera rational = plumb_bob;
  rational.distortion = Distortion::rational_polynomial;
  rational.coefficients = {0.9, 0.3, 0.001, -0.0008, 0.02, 1.2, 0.45, 0.05};
  Camera fisheye = pinhole(640, 480, 260, 261, 318, 241);
  fisheye.distortion = Distortion::fisheye;
  fisheye.coefficients = {0.05, -0.01, 0.003, -0.001};
  Camera monoslam = pinhole(640, 480, 390, 390, 324, 250);
  monoslam.distortion = Distortion::monoslam;
  monoslam.coefficients = {2.2e-6};
  return {pinhole(640, 480, 420, 420, 319.5, 239.5), plumb_bob, rational, fisheye, monoslam};
}

// A cube a few pixels large shows where a point is drawn: the centroid of its pixels is the
// projection of its centre but for perspective within the cube (under 0.1 px here) and quantised
// shading, hence the 0.6 px.
TEST_P(LiveView, ObjectsAreDrawnWhereTheCameraModelPutsThem) {
  for (const Camera& camera : bent_cameras()) {
    for (const Vector2d& place : {Vector2d(320, 240), Vector2d(30, 80), Vector2d(600, 60),
                                  Vector2d(50, 440), Vector2d(590, 430), Vector2d(320, 30)}) {
      const Vector3d centre = 0.8 * unproject(camera, place).normalized();
      Scene scene;
      scene.background = cv::Mat::zeros(camera.height, camera.width, CV_8UC3);
      scene.camera = camera;
      scene.pose_known = true;
      VirtualObject cube = standing(1, "cube", 0, 0);
      cube.scale = 0.2;  // 16 mm, its centre 8 mm above its foot
      const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.6, Vector3d(1, 0.3, 0.2).normalized()));
      cube.world_from_object = Pose(turn, centre - turn * Vector3d(0, 0, 0.008));
      scene.objects = {cube};

      cv::Mat grey;
      cv::cvtColor(picture_of(scene, 640, 480), grey, cv::COLOR_BGR2GRAY);
      const Vector2d expected = *project(camera, centre);
      const cv::Rect window(static_cast<int>(expected.x()) - 20,
                            static_cast<int>(expected.y()) - 20, 41, 41);
      cv::Mat seen;
      cv::threshold(grey(window & cv::Rect(0, 0, 640, 480)), seen, 6, 1, cv::THRESH_BINARY);
      const cv::Moments moments = cv::moments(seen, true);
      ASSERT_GT(moments.m00, 20) << name(camera.distortion) << " nothing drawn near " << place;
      const cv::Rect inside = window & cv::Rect(0, 0, 640, 480);
      const Vector2d drawn(inside.x + moments.m10 / moments.m00,
                           inside.y + moments.m01 / moments.m00);
      EXPECT_LT((drawn - expected).norm(), 0.6)
          << name(camera.distortion) << " expected " << expected.transpose() << ", drawn "
          << drawn.transpose();
    }
  }
}

double mean_difference(const cv::Mat& a, const cv::Mat& b, const cv::Rect& where) {
  cv::Mat apart;
  cv::absdiff(a(where), b(where), apart);
  const cv::Scalar mean = cv::mean(apart);
  return (mean[0] + mean[1] + mean[2]) / 3;
}

// The teapot fills the picture's middle at 0.9 m; the scene's depth is nearer on the left half,
// unknown on the upper right and farther on the lower right.
TEST_P(LiveView, NearerDepthHidesAndUnknownDepthDoesNot) {
  const Camera camera = pinhole(320, 240, 300, 300, 159.5, 119.5);
  Scene scene;
  scene.background = cv::Mat(240, 320, CV_8UC3, cv::Scalar(90, 90, 90));
  scene.camera = camera;
  scene.pose_known = true;
  const cv::Mat empty = picture_of(scene, 320, 240);
  VirtualObject teapot = standing(1, "teapot", 0, 0);
  Eigen::Matrix3d axes;  // upright and 0.9 m ahead
  axes << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  teapot.world_from_object = Pose(Eigen::Quaterniond(axes), {0, 0.07, 0.9});
  scene.objects = {teapot};
  scene.depth = cv::Mat(240, 320, CV_32F, cv::Scalar(2));
  scene.depth(cv::Rect(0, 0, 160, 240)).setTo(0.5);
  scene.depth(cv::Rect(160, 0, 160, 120)).setTo(std::numeric_limits<float>::quiet_NaN());
  const cv::Mat picture = picture_of(scene, 320, 240);
  EXPECT_LT(mean_difference(picture, empty, {130, 100, 28, 40}), 0.5);
  EXPECT_GT(mean_difference(picture, empty, {162, 108, 20, 12}), 20);
  EXPECT_GT(mean_difference(picture, empty, {162, 122, 20, 12}), 20);
  // The edge is soft: its column is neither the object's colour nor the background's, but nothing
  // is seen two pixels inside the hidden half.
  EXPECT_LT(mean_difference(picture, empty, {150, 110, 8, 20}), 0.5);
}

// Under a thing that stands on white the white is darker, and unchanged a hand's breadth away.
TEST_P(LiveView, AnObjectDarkensThePlaneItStandsOn) {
  for (const std::string& mesh : std::vector<std::string>{"teapot", "cube", "table"}) {
    Scene scene = tiny_scene(pinhole(320, 240, 300, 300, 159.5, 119.5), world_from_viewer());
    scene.background.setTo(cv::Scalar::all(220));
    scene.depth.release();
    scene.objects = {standing(1, mesh, 0, 0)};
    const cv::Mat picture = picture_of(scene, 320, 240);
    // Just in front of the foot's front edge, which is where the footprint of each mesh ends.
    const double front = mesh == "teapot" ? -0.075 : mesh == "cube" ? -0.042 : -0.06;
    const auto at = [&](double y) {
      const auto pixel =
          project(scene.camera, scene.world_from_camera.inverse() * Vector3d(0, y, 0));
      return picture.at<cv::Vec3b>(static_cast<int>(std::lround(pixel->y())),
                                   static_cast<int>(std::lround(pixel->x())))[1];
    };
    EXPECT_LT(at(front), 205) << mesh;
    EXPECT_EQ(at(-0.3), 220) << mesh;
  }
}

TEST_P(LiveView, AClickGivesThePixelOfTheVideoAndItsRay) {
  Camera camera = pinhole(320, 240, 260, 260, 161, 119);
  camera.coefficients = {-0.2, 0.05, 0, 0, 0};
  const Scene scene = tiny_scene(camera, world_from_viewer());
  // 640x600: the video is shown at twice its size, 60 px from the upper edge.
  auto renderer = Renderer::make(*context_, {.width = 640, .height = 600});
  ASSERT_TRUE(renderer.ok());
  InputState input;
  input.mouse = {401, 261};  // edges: 200.5 and 100.5 of the video, centres 200 and 100
  input.clicked[0] = input.down[0] = true;
  const Requests requests = (*renderer)->draw(scene, input);
  ASSERT_EQ(requests.clicks.size(), 1U);
  const ViewClick& click = requests.clicks.front();
  EXPECT_EQ(click.view, ViewKind::live);
  EXPECT_NEAR(click.pixel.x(), 200, 1e-9);
  EXPECT_NEAR(click.pixel.y(), 100, 1e-9);
  ASSERT_TRUE(click.ray_in_world.has_value());
  const Vector3d on_ray =
      click.ray_in_world->origin_in_world + click.ray_in_world->direction_in_world;
  const auto seen_at = project(camera, scene.world_from_camera.inverse() * on_ray);
  ASSERT_TRUE(seen_at.has_value());
  EXPECT_LT((*seen_at - click.pixel).norm(), 1e-6);

  input.mouse = {320, 30};  // on the bar above the video
  EXPECT_TRUE((*renderer)->draw(scene, input).clicks.empty());
}

INSTANTIATE_TEST_SUITE_P(Kinds, LiveView, testing::Values(ContextKind::egl, ContextKind::osmesa),
                         [](const auto& kind) { return std::string(name(kind.param)); });

TEST(DeskClicks, AMapClickIsARayAndADragIsNot) {
  auto context = make_context({.kind = ContextKind::egl});
  ASSERT_TRUE(context.ok()) << context.error().message();
  auto renderer =
      Renderer::make(**context, {.width = 960, .height = 540, .layout = Layout::operator_desk});
  ASSERT_TRUE(renderer.ok());
  Scene scene = tiny_scene(pinhole(320, 240, 260, 260, 159.5, 119.5), world_from_viewer());
  scene.surface = tiny_surface(0.02F);
  (*renderer)->draw(scene, {});
  const auto press_and_release = [&](const Eigen::Vector2f& from, const Eigen::Vector2f& to) {
    InputState input;
    input.mouse = from;
    input.clicked[0] = input.down[0] = true;
    EXPECT_TRUE((*renderer)->draw(scene, input).clicks.empty());
    input.clicked[0] = false;
    input.mouse = to;
    EXPECT_TRUE((*renderer)->draw(scene, input).clicks.empty());
    input.down[0] = false;
    return (*renderer)->draw(scene, input).clicks;
  };
  const auto clicks = press_and_release({300, 200}, {300, 200});
  ASSERT_EQ(clicks.size(), 1U);
  EXPECT_EQ(clicks[0].view, ViewKind::map);
  ASSERT_TRUE(clicks[0].ray_in_world.has_value());
  // The middle of the map view looks at the scene: its ray passes within half a metre of it.
  const Ray& ray = *clicks[0].ray_in_world;
  const Vector3d to_scene = Vector3d(0, 0.1, 0.1) - ray.origin_in_world;
  const double distance = to_scene.cross(ray.direction_in_world.normalized()).norm();
  EXPECT_LT(distance, 0.5);
  EXPECT_TRUE(press_and_release({300, 200}, {360, 230}).empty());
  const auto top = press_and_release({100, 450}, {100, 450});
  ASSERT_EQ(top.size(), 1U);
  EXPECT_EQ(top[0].view, ViewKind::top);
  EXPECT_LT(top[0].ray_in_world->direction_in_world.normalized().z(), -0.98);
}

}  // namespace
}  // namespace armsreach::render::test
