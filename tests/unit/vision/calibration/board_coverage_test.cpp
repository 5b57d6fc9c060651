// What a person is told to do with the board.
#include "vision/calibration/board_coverage.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/vision/calibration/board_views.hpp"

namespace armsreach::test {
namespace {

using calibration::BoardCoverage;
using calibration::Chessboard;
using ::testing::HasSubstr;

const Camera kCamera = pinhole(640, 480, 525, 525, 319.5, 239.5);

class CoveredCamera : public ::testing::Test {
 protected:
  calibration::Corners seen(double x, double y, double depth, const Eigen::Vector3d& tilt) const {
    const auto corners = seen_board(kCamera, board_, board_pose(board_, x, y, depth, tilt));
    EXPECT_TRUE(corners) << "the test's own view leaves the image";
    return corners.value_or(calibration::Corners{});
  }
  void show(double x, double y, double depth, const Eigen::Vector3d& tilt = {0, 0, 0}) {
    const auto corners = seen(x, y, depth, tilt);
    if (!corners.empty() && coverage_.adds(corners)) coverage_.take(corners);
  }

  Chessboard board_;
  BoardCoverage coverage_{board_, {640, 480}};
};

TEST_F(CoveredCamera, TheSameViewAddsNothing) {
  const auto view = seen(0, 0, 0.5, {0.1, 0, 0});
  EXPECT_TRUE(coverage_.adds(view));
  coverage_.take(view);
  EXPECT_FALSE(coverage_.adds(view));
  EXPECT_TRUE(coverage_.adds(seen(0.3, 0.2, 0.5, {0.1, 0, 0})));
}

TEST_F(CoveredCamera, AsksForTheSideThatIsMissing) {
  EXPECT_THAT(coverage_.advice(), HasSubstr("show the whole board"));
  show(0, 0, 0.5);
  show(0, -0.2, 0.5);
  show(0, 0.2, 0.5);
  show(0, 0, 0.3, {0.6, 0, 0});
  show(0, 0, 0.9, {0, 0.6, 0});
  EXPECT_LT(coverage_.progress()[0], 0.1);
  EXPECT_THAT(coverage_.advice(), ::testing::AnyOf(HasSubstr("left"), HasSubstr("right")));
  show(-0.4, 0, 0.6);
  EXPECT_THAT(coverage_.advice(), HasSubstr("right"));
}

TEST_F(CoveredCamera, IsCompleteWhenAllOfItIsSeen) {
  for (const double x : {-0.32, 0.0, 0.32}) {
    for (const double y : {-0.2, 0.0, 0.24}) {
      show(x, y, 0.6);
      show(x, y, 0.6, {0.5, 0, 0});
      show(x, y, 0.6, {0, 0.5, 0});
    }
  }
  EXPECT_FALSE(coverage_.complete());  // never came near
  show(0, 0, 0.26);
  show(0, 0, 1.2);
  EXPECT_TRUE(coverage_.complete()) << coverage_.advice();
  EXPECT_EQ(coverage_.advice(), "");
}

}  // namespace
}  // namespace armsreach::test
