#include "vision/gesture/color_training.hpp"

#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "painted_skin.hpp"
#include "vision/gesture/color_pointing.hpp"
#include "vision/gesture/color_table.hpp"

namespace armsreach::gesture::test {
namespace {

using ::testing::HasSubstr;

TEST(ColorTraining, RefusesWhatHasNoColoursOrAnotherSize) {
  ColorExamples examples;
  const cv::Mat picture = painted({40, 30}, kSkinColor);
  const auto grey =
      add_examples(cv::Mat(30, 40, CV_8UC1), cv::Mat(30, 40, CV_8UC1), "a.png", &examples);
  ASSERT_FALSE(grey.ok());
  EXPECT_THAT(grey.error().message(), HasSubstr("a.png: is a grey image"));
  const auto other = add_examples(picture, cv::Mat(20, 40, CV_8UC1), "a.png", &examples);
  ASSERT_FALSE(other.ok());
  EXPECT_THAT(other.error().message(), HasSubstr("is 40x30, its mask 40x20"));
}

TEST(ColorTraining, RefusesToLearnFromNothing) {
  ColorExamples examples;
  const cv::Mat picture = painted({40, 30}, kSkinColor);
  ASSERT_TRUE(add_examples(picture, cv::Mat::zeros(30, 40, CV_8UC1), "a.png", &examples).ok());
  const auto model = general_skin_model({examples}, "a.png");
  ASSERT_FALSE(model.ok());
  EXPECT_THAT(model.error().message(), HasSubstr("no more than 0 pixels"));
  EXPECT_FALSE(fitted_skin_model(general_model(), examples, "a.png").ok());
  EXPECT_FALSE(taught({}, "ball", examples, "a.png").ok());
  const auto nameless = taught({}, "", examples, "a.png");
  ASSERT_FALSE(nameless.ok());
  EXPECT_THAT(nameless.error().what, HasSubstr("no name"));
}

TEST(ColorTraining, ReadsListsOfPixels) {
  std::istringstream good("b,g,r,label\n120,150,205,1\r\n70, 110, 60, 2\n\n");
  ColorExamples examples;
  ASSERT_TRUE(add_pixel_list(good, "list.csv", &examples).ok());
  EXPECT_EQ(examples.inside.count(), 1);
  EXPECT_EQ(examples.outside.count(), 1);
  EXPECT_EQ(level_of(examples), cv::Vec3f(120.5F, 150.5F, 205.5F));
  for (const char* bad :
       {"120,150,205\n", "1,2,256,1\n", "1,2,3,4\n", "1,2,3,1,5\n", "1,-2,3,1\n"}) {
    std::istringstream in(std::string("1,2,3,1\n") + bad);
    const auto status = add_pixel_list(in, "list.csv", &examples);
    ASSERT_FALSE(status.ok()) << bad;
    EXPECT_THAT(status.error().message(), HasSubstr("list.csv:2"));
  }
}

TEST(ColorTraining, BalancesHueAndNotBrightness) {
  const ColorModel model = general_model();
  const ColorModel darker = balanced(model, model.level * 0.5F);
  const ColorModel bluer = balanced(model, {model.level[0] * 1.5F, model.level[1], model.level[2]});
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(darker.balance[i], 1, 1e-5);
  EXPECT_LT(bluer.balance[0], 1);
  EXPECT_GT(bluer.balance[1], 1);
  EXPECT_EQ(balanced({}, model.level).balance, cv::Vec3f(1, 1, 1));  // no M_T is known
}

TEST(ColorPointing, FindsWhatStandsOut) {
  cv::Mat picture = painted({320, 200}, cv::Scalar(50, 60, 40), 6);
  const cv::Rect ball(60, 90, 30, 30), other(200, 50, 34, 34);
  picture(ball).setTo(cv::Scalar(220, 120, 40));
  const cv::Mat alone = pointed_out(picture, std::nullopt);
  EXPECT_GT(f1(alone(ball), cv::Mat(ball.size(), CV_8UC1, cv::Scalar(255))), 0.9);
  EXPECT_LT(cv::countNonZero(alone), 1.5 * ball.area());
  picture(other).setTo(cv::Scalar(30, 40, 230));
  const cv::Mat pointed = pointed_out(picture, cv::Rect(40, 70, 80, 80));
  EXPECT_GT(cv::countNonZero(pointed(ball)), 0.8 * ball.area());
  EXPECT_EQ(cv::countNonZero(pointed(other)), 0);
  EXPECT_EQ(cv::countNonZero(pointed_out(painted({80, 60}, kWallColor), std::nullopt)), 0);
}

TEST(ColorPointing, AMaskLosesItsRim) {
  cv::Mat picture = painted({320, 200}, cv::Scalar(50, 60, 40), 6);
  const cv::Rect ball(60, 90, 30, 30);
  picture(ball).setTo(cv::Scalar(220, 120, 40));
  cv::Mat mask = cv::Mat::zeros(picture.size(), CV_8UC1);
  mask(cv::Rect(50, 80, 50, 50)).setTo(255);
  const cv::Mat own = own_colors(picture, mask);
  EXPECT_EQ(cv::countNonZero(own(ball)), ball.area());
  EXPECT_LT(cv::countNonZero(own), 1.3 * ball.area());  // the filter reaches 2 px beyond it
}

}  // namespace
}  // namespace armsreach::gesture::test
