#include "vision/gesture/hand_texture.hpp"

#include <cmath>
#include <numbers>
#include <numeric>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

namespace armsreach::gesture {
namespace {

// A bright oval with two dark creases, and what a detector would say of it.
struct Drawn {
  cv::Mat bgr;
  HandObservation hand;
};

Drawn drawn(double angle, double size, const cv::Scalar& around = cv::Scalar(90, 60, 30)) {
  const double degrees = angle * 180 / std::numbers::pi;
  const cv::Point2d center(160, 120);
  const auto at = [&](double x, double y) {
    return cv::Point2d(center.x + size * (x * std::cos(angle) - y * std::sin(angle)),
                       center.y + size * (x * std::sin(angle) + y * std::cos(angle)));
  };
  Drawn one{cv::Mat(240, 320, CV_8UC3, around), {}};
  const cv::Size axes(cvRound(0.9 * size), cvRound(1.2 * size));
  cv::ellipse(one.bgr, center, axes, degrees, 0, 360, cv::Scalar(120, 150, 200), cv::FILLED,
              cv::LINE_AA);
  const int width = std::max(1, cvRound(0.1 * size));
  for (const double x : {-0.3, 0.2})
    cv::line(one.bgr, at(x, -0.6), at(x, 0.1), cv::Scalar(60, 80, 120), width, cv::LINE_AA);
  cv::ellipse2Poly(center, axes, cvRound(degrees), 0, 360, 4, one.hand.outline);
  one.hand.center = {center.x, center.y};
  one.hand.area = cv::contourArea(one.hand.outline);
  one.hand.angle = angle;
  return one;
}

double alike(const TextureFeatures& one, const TextureFeatures& other) {
  const auto product = [](const TextureFeatures& a, const TextureFeatures& b) {
    return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
  };
  return product(one, other) / std::sqrt(product(one, one) * product(other, other));
}

TextureFeatures features_of(const Drawn& one) { return texture_features(one.bgr, one.hand); }

// 0.9 leaves room for how lines are drawn on pixels; the creases turned across them give 0.75.
TEST(HandTexture, IsTheSameTurnedAndNearer) {
  const TextureFeatures upright = features_of(drawn(0, 40));
  EXPECT_GT(alike(upright, features_of(drawn(0.7, 40))), 0.9);
  EXPECT_GT(alike(upright, features_of(drawn(-2.5, 40))), 0.9);
  EXPECT_GT(alike(upright, features_of(drawn(0, 80))), 0.9);
  Drawn across = drawn(0, 40);
  across.hand.angle = std::numbers::pi / 2;
  EXPECT_LT(alike(upright, features_of(across)), 0.85);
}

// A slanted crease tells one hand from the other.
TEST(HandTexture, OfTheOtherHandIsThatOfTheMirrorImage) {
  Drawn one = drawn(0, 40);
  cv::line(one.bgr, {140, 130}, {175, 150}, cv::Scalar(60, 80, 120), 4, cv::LINE_AA);
  Drawn mirror{cv::Mat(), one.hand};
  cv::flip(one.bgr, mirror.bgr, 1);
  mirror.hand.center.x() = one.bgr.cols - 1 - one.hand.center.x();
  for (cv::Point& at : mirror.hand.outline) at.x = one.bgr.cols - 1 - at.x;
  const TextureFeatures features = features_of(one), of_mirror = features_of(mirror);
  const double unmirrored = alike(features, of_mirror);
  // How the outline falls on pixels costs less than a fifth of what the mirror does.
  EXPECT_LT(1 - alike(mirrored(features), of_mirror), (1 - unmirrored) / 5);
  EXPECT_LT(unmirrored, 0.95);
  EXPECT_EQ(mirrored(mirrored(features)), features);
}

TEST(HandTexture, DoesNotLookAround) {
  const TextureFeatures dark = features_of(drawn(0.3, 40));
  const TextureFeatures light = features_of(drawn(0.3, 40, cv::Scalar(250, 250, 250)));
  EXPECT_GT(alike(dark, light), 0.97);  // pixels of the outline are of both
}

TEST(HandTexture, HardlyDependsOnTheLight) {
  Drawn dim = drawn(0.3, 40);
  dim.bgr *= 0.5;
  EXPECT_GT(alike(features_of(drawn(0.3, 40)), features_of(dim)), 0.97);
}

TEST(HandTexture, MayReachBeyondTheImage) {
  Drawn one = drawn(0.3, 40);
  for (const cv::Rect& part : {cv::Rect(150, 110, 20, 20), cv::Rect(0, 0, 1, 1)}) {
    one.hand.center = {2.0, 1.0};
    for (const float value : texture_features(one.bgr(part), one.hand))
      ASSERT_TRUE(std::isfinite(value));
  }
  one.hand.center = {-1000, -1000};  // nothing of it is seen
  for (const float value : features_of(one)) ASSERT_TRUE(std::isfinite(value));
}

TEST(HandTexture, AModelIsWrittenAndReadBack) {
  TextureModel model;
  model.constant = -0.25;
  for (std::size_t i = 0; i < kTextureSize; ++i)
    model.weights[i] = static_cast<float>(i % 7) / 8 - 0.5F;
  std::stringstream file;
  write_texture_model(file, model);
  const auto read = read_texture_model(file, "file");
  ASSERT_TRUE(read.ok());
  EXPECT_EQ(read->constant, model.constant);
  EXPECT_EQ(read->weights, model.weights);
  const TextureFeatures features = features_of(drawn(0, 40));
  EXPECT_NEAR(read->log_odds(features), model.log_odds(features), 1e-9);
}

TEST(HandTexture, AFileThatIsNoModelIsRefused) {
  std::stringstream whole;
  write_texture_model(whole, TextureModel());
  const std::string text = whole.str();
  for (const std::string& wrong :
       {std::string(), std::string("armsreach-rings 1\n0\n"), text + "0", text + "more",
        text.substr(0, text.size() - 8), "armsreach-texture 1\nnan" + text.substr(21)}) {
    std::istringstream in(wrong);
    const auto model = read_texture_model(in, "hands.txt");
    ASSERT_FALSE(model.ok()) << wrong.substr(0, 40);
    EXPECT_THAT(model.error().message(), testing::HasSubstr("hands.txt"));
    EXPECT_THAT(model.error().message(), testing::HasSubstr("learn hands"));
  }
}

}  // namespace
}  // namespace armsreach::gesture
