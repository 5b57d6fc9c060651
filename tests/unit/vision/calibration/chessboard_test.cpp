// Corners of a drawn board, and of the photographs that everybody has.
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "tests/support/recordings.hpp"
#include "tests/unit/vision/calibration/board_views.hpp"
#include "vision/calibration/camera_calibration.hpp"

namespace armsreach::test {
namespace {

using calibration::Chessboard;

// Supersampled, so that edges lie where they are between pixels.
cv::Mat drawn_board(const Camera& camera, const Chessboard& board, const Pose& camera_from_board) {
  constexpr int kFiner = 4;
  cv::Mat fine(camera.height * kFiner, camera.width * kFiner, CV_8U, cv::Scalar(225));
  const auto corner = [&](int column, int row) {
    const auto pixel = project(
        camera, camera_from_board * Eigen::Vector3d(column * board.square, row * board.square, 0));
    // Pixel centres: (0, 0) of the coarse image is the middle of its fine pixels.
    return cv::Point(static_cast<int>(std::lround(((pixel->x() + 0.5) * kFiner - 0.5) * 16)),
                     static_cast<int>(std::lround(((pixel->y() + 0.5) * kFiner - 0.5) * 16)));
  };
  for (int row = -1; row < board.rows; ++row) {
    for (int column = -1; column < board.columns; ++column) {
      if ((row + column) % 2 != 0) continue;
      const std::vector<cv::Point> square{corner(column, row), corner(column + 1, row),
                                          corner(column + 1, row + 1), corner(column, row + 1)};
      cv::fillConvexPoly(fine, square, cv::Scalar(25), cv::LINE_8, 4);
    }
  }
  cv::Mat image;
  cv::resize(fine, image, {camera.width, camera.height}, 0, 0, cv::INTER_AREA);
  return image;
}

TEST(Chessboard, CornersAreFoundToAFewHundredthsOfAPixel) {
  const Camera camera = pinhole(640, 480, 525, 525, 319.5, 239.5);
  const Chessboard board;
  const Pose pose = board_pose(board, 0.05, -0.02, 0.45, {0.3, -0.25, 0.1});
  const auto found = find_chessboard(drawn_board(camera, board, pose), board);
  ASSERT_TRUE(found);
  const auto truth = seen_board(camera, board, pose);
  ASSERT_TRUE(truth);
  for (std::size_t i = 0; i < truth->size(); ++i) {
    EXPECT_LT(cv::norm((*found)[i] - (*truth)[i]), 0.1) << "corner " << i;
  }
}

TEST(Chessboard, NothingIsFoundWhereThereIsNone) {
  EXPECT_FALSE(find_chessboard(cv::Mat(480, 640, CV_8U, cv::Scalar(90)), Chessboard{}));
}

// OpenCV's own figures for these photographs (one focal length for both axes of a stereo pair) are
// 534.8 px and a middle within some pixels of (335.7, 240.7); free of the pair's constraints it
// differs by about one per cent.
TEST(Chessboard, ThePhotographsGiveTheirKnownCamera) {
  ARMSREACH_RECORDING_OR_SKIP(folder, "calibration/chessboard");
  const Chessboard board;
  std::vector<calibration::Corners> views;
  for (int i = 1; i <= 14; ++i) {
    char file[16];
    std::snprintf(file, sizeof file, "left%02d.jpg", i);
    const cv::Mat image = cv::imread((folder / file).string(), cv::IMREAD_GRAYSCALE);
    if (image.empty()) continue;
    auto corners = find_chessboard(image, board);
    ASSERT_TRUE(corners) << file;
    views.push_back(*std::move(corners));
  }
  const auto result =
      calibrate_camera(views, {640, 480}, board, Distortion::plumb_bob, folder.string());
  ASSERT_TRUE(result.ok()) << result.error().message();
  EXPECT_NEAR(result->camera.fx, 534.8, 5.3);
  EXPECT_NEAR(result->camera.fy, 534.8, 5.3);
  EXPECT_NEAR(result->camera.cx, 335.7, 10);
  EXPECT_NEAR(result->camera.cy, 240.7, 10);
  EXPECT_LT(result->rms, 0.3);
}

}  // namespace
}  // namespace armsreach::test
