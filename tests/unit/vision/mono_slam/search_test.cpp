#include "vision/mono_slam/search.hpp"

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "tests/unit/vision/mono_slam/cameras.hpp"
#include "tests/unit/vision/mono_slam/pictures.hpp"

namespace armsreach::mono_slam {
namespace {

using Eigen::Vector2d;

Template template_at(const cv::Mat& image, const Vector2d& pixel, int size = 15) {
  return patch_at(image, pixel, size, test::wide_angle(), Pose()).original();
}

SearchImage search_image(const cv::Mat& grey) {
  SearchImage out;
  out.set(grey);
  return out;
}

TEST(Search, FindsAShiftBelowThePixel) {
  const cv::Mat first = test::speckles(320, 240, 1);
  for (const Vector2d& shift : {Vector2d(0, 0), Vector2d(3.3, -2.4), Vector2d(-6.5, 4.75)}) {
    const SearchImage now = search_image(test::shifted(first, shift.x(), shift.y()));
    for (const Vector2d& pixel : {Vector2d(100, 80), Vector2d(220, 150)}) {
      const auto match = search(now, template_at(first, pixel), square(pixel, 10), 0.8);
      ASSERT_TRUE(match);
      // A parabola is not the true shape of the peak.
      EXPECT_LT((match->pixel - pixel - shift).norm(), 0.2);
      EXPECT_GT(match->score, 0.95);
    }
  }
}

TEST(Search, ScoresAreThoseOfMatchTemplate) {
  const cv::Mat image = test::speckles(320, 240, 2);
  const Template pattern = template_at(test::speckles(320, 240, 3), {100, 100}, 11);
  cv::Mat small(11, 11, CV_8UC1);
  for (int i = 0; i < 121; ++i) {
    small.at<unsigned char>(i / 11, i % 11) =
        static_cast<unsigned char>(pattern.samples[static_cast<std::size_t>(i)]);
  }
  cv::Mat scores;
  cv::matchTemplate(image, small, scores, cv::TM_CCOEFF_NORMED);
  cv::Point best;
  double highest = 0;
  cv::minMaxLoc(scores, nullptr, &highest, nullptr, &best);
  const auto match = search_exhaustively(search_image(image), pattern, everywhere(320, 240), -1);
  ASSERT_TRUE(match);
  EXPECT_NEAR(match->score, highest, 1e-4);  // OpenCV's is in single precision
  EXPECT_LT((match->pixel - Vector2d(best.x + 5, best.y + 5)).cwiseAbs().maxCoeff(), 0.51);
}

TEST(Search, LargeRegionsGiveWhatExhaustiveSearchGives) {
  const cv::Mat first = test::speckles(320, 240, 4);
  const SearchImage now = search_image(test::shifted(first, 31.4, -22.7));
  int same = 0;
  int searched = 0;
  for (int x = 60; x <= 240; x += 20) {
    for (int y = 60; y <= 180; y += 20) {
      const Vector2d pixel(x, y);
      const Template pattern = template_at(first, pixel);
      const Region region = square(pixel, 40);
      const auto quick = search(now, pattern, region, 0.8);
      const auto thorough = search_exhaustively(now, pattern, region, 0.8);
      ++searched;
      if (quick && thorough && (quick->pixel - thorough->pixel).norm() < 1e-9) ++same;
    }
  }
  EXPECT_GE(same, 0.97 * searched);
}

TEST(Search, NothingMatchesInTheDark) {
  const cv::Mat first = test::speckles(320, 240, 5);
  const Template pattern = template_at(first, {100, 100});
  const SearchImage dark = search_image(cv::Mat(240, 320, CV_8UC1, cv::Scalar(3)));
  EXPECT_FALSE(search(dark, pattern, everywhere(320, 240), 0.5));
  EXPECT_TRUE(search_all(dark, pattern, everywhere(320, 240), 0.5, 5).empty());
  const Template flat = template_at(cv::Mat(240, 320, CV_8UC1, cv::Scalar(90)), {100, 100});
  EXPECT_FALSE(search(search_image(first), flat, everywhere(320, 240), 0.5));
}

TEST(Search, StaysInsideItsRegionAndTheImage) {
  const cv::Mat first = test::speckles(320, 240, 6);
  const SearchImage now = search_image(first);
  const Template pattern = template_at(first, {100, 100});
  EXPECT_FALSE(search(now, pattern, square({130, 100}, 12), 0.9));
  EXPECT_FALSE(search(now, pattern, square({-40, 500}, 30), 0.9));
  EXPECT_TRUE(search(now, pattern, ellipse({104, 97}, 4 * Eigen::Matrix2d::Identity(), 3), 0.9));
  // At the very corner the windows of border pixels would leave the image.
  EXPECT_FALSE(search(now, pattern, square({0, 0}, 6), -1));
}

TEST(Search, AllPlacesBestFirst) {
  cv::Mat image = test::speckles(320, 240, 7);
  const cv::Rect from(80, 60, 31, 31);
  const cv::Mat copy = image(from).clone();
  copy.copyTo(image(cv::Rect(200, 150, 31, 31)));
  cv::Mat faint = copy.clone();
  cv::add(faint, 0.4 * test::speckles(31, 31, 8), faint);
  faint.copyTo(image(cv::Rect(40, 180, 31, 31)));
  const Template pattern = template_at(image, {95, 75});
  for (const auto& matches :
       {search_all(search_image(image), pattern, everywhere(320, 240), 0.7, 3),
        search_all_coarsely(search_image(image), pattern, 0.7, 3)}) {
    ASSERT_EQ(matches.size(), 3U);
    EXPECT_LT((matches[2].pixel - Vector2d(55, 195)).norm(), 1.0);
    EXPECT_GT(matches[1].score, matches[2].score);
  }
}

}  // namespace
}  // namespace armsreach::mono_slam
