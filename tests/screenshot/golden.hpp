// Pictures compared with ones a person has looked at (golden/*.png).
//
// To make them anew: ARMSREACH_UPDATE_GOLDEN=1 build/tests/screenshot/screenshot_test, then look at
// each and at `git diff --stat` before committing.
#pragma once

#include <string>

#include <gtest/gtest.h>
#include <opencv2/core/mat.hpp>

namespace armsreach::render::test {

// Both pictures are blurred over 3x3 pixels first, so that an edge smoothed a little differently
// does not count. Then fewer than 0.3 % of the pixels may differ by more than 16 of 255:
// rasterisers of other Mesa versions and vector widths place samples and round colours slightly
// differently, while a thing missing, moved by two pixels or lit otherwise changes more. A failure
// leaves NAME.actual.png and NAME.diff.png and says where.
testing::AssertionResult matches_golden(const cv::Mat& picture, const std::string& name);

// The share of pixels that differ so, 0..1; the pictures have one size.
double share_that_differs(const cv::Mat& a, const cv::Mat& b);

}  // namespace armsreach::render::test
