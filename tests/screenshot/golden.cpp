#include "tests/screenshot/golden.hpp"

#include <cstdlib>
#include <filesystem>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace armsreach::render::test {
namespace {

constexpr double kShareAllowed = 0.003;
constexpr double kLevelsAllowed = 16;

// Largest difference of the channels at each pixel, after the blur.
cv::Mat difference(const cv::Mat& a, const cv::Mat& b) {
  cv::Mat smooth_a;
  cv::Mat smooth_b;
  cv::blur(a, smooth_a, {3, 3});
  cv::blur(b, smooth_b, {3, 3});
  cv::Mat each;
  cv::absdiff(smooth_a, smooth_b, each);
  cv::Mat channels[3];
  cv::split(each, channels);
  return cv::max(channels[0], cv::max(channels[1], channels[2]));
}

}  // namespace

double share_that_differs(const cv::Mat& a, const cv::Mat& b) {
  const cv::Mat apart = difference(a, b) > kLevelsAllowed;
  return cv::countNonZero(apart) / static_cast<double>(apart.total());
}

testing::AssertionResult matches_golden(const cv::Mat& picture, const std::string& name) {
  const std::filesystem::path golden =
      std::filesystem::path(ARMSREACH_GOLDEN_DIR) / (name + ".png");
  if (std::getenv("ARMSREACH_UPDATE_GOLDEN")) {
    std::filesystem::create_directories(golden.parent_path());
    cv::imwrite(golden.string(), picture, {cv::IMWRITE_PNG_COMPRESSION, 9});
    return testing::AssertionSuccess();
  }
  const std::filesystem::path out(ARMSREACH_SCREENSHOT_OUT);
  const std::string actual = (out / (name + ".actual.png")).string();
  const cv::Mat expected = cv::imread(golden.string());
  if (expected.size() != picture.size()) {
    cv::imwrite(actual, picture);
    return testing::AssertionFailure()
           << golden << " is missing or of another size; see " << actual;
  }
  const double share = share_that_differs(picture, expected);
  if (share <= kShareAllowed) return testing::AssertionSuccess();
  const std::string diff = (out / (name + ".diff.png")).string();
  cv::imwrite(actual, picture);
  cv::imwrite(diff, difference(picture, expected) * 4);
  return testing::AssertionFailure() << 100 * share << " % of the pixels differ from " << golden
                                     << "; see " << actual << " and " << diff;
}

}  // namespace armsreach::render::test
