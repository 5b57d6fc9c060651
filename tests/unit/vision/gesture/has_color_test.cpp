#include "vision/gesture/has_color.hpp"

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

namespace armsreach::gesture {
namespace {

TEST(HasColor, GreyImagesHaveNoneHoweverTheyAreStored) {
  cv::Mat bgr(48, 64, CV_8UC3, cv::Scalar(90, 92, 91));  // as JPEG leaves grey
  EXPECT_FALSE(has_color(bgr));
  EXPECT_FALSE(has_color(cv::Mat(48, 64, CV_8UC1, cv::Scalar(90))));
  EXPECT_FALSE(has_color(cv::Mat()));
  bgr(cv::Rect(20, 10, 30, 30)).setTo(cv::Scalar(90, 110, 160));
  EXPECT_TRUE(has_color(bgr));
}

}  // namespace
}  // namespace armsreach::gesture
