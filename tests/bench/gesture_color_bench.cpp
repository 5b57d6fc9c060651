// Skin in a 320x240 picture: our table with its box filter, beside OpenCV's way to the same end:
// conversion to YCrCb, back projection of a UV histogram, box filter, threshold.
#include <benchmark/benchmark.h>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "tests/bench/beside.hpp"
#include "tests/unit/vision/gesture/painted_skin.hpp"
#include "vision/gesture/color_blobs.hpp"
#include "vision/gesture/skin_segmenter.hpp"

namespace {

using namespace armsreach;
using namespace armsreach::gesture;

// Hand, wall and noise, so that the table is read all over.
cv::Mat picture() {
  cv::Mat bgr = test::hand_before(test::kWallColor);
  cv::Mat noise = test::painted(bgr.size() / 2, cv::Scalar(128, 128, 128), 60);
  noise.copyTo(bgr(cv::Rect({0, 0}, noise.size())));
  return bgr;
}

// OpenCV's way.
class BackProjection {
 public:
  BackProjection() {
    const ColorLikelihood skin(test::general_model().classes[0].pixels, 0.01);
    cv::Mat scaled;
    cv::normalize(skin.uv, scaled, 0, 255, cv::NORM_MINMAX);
    histogram_ = scaled.t();
  }
  void segment(const cv::Mat& bgr) {
    const int channels[] = {2, 1};  // Cb, Cr as our u, v; rows are the first of a cv histogram
    const float range[] = {0, 256};
    const float* ranges[] = {range, range};
    cv::cvtColor(bgr, ycrcb_, cv::COLOR_BGR2YCrCb);
    cv::calcBackProject(&ycrcb_, 1, channels, histogram_, projected_, ranges);
    cv::blur(projected_, projected_, {5, 5});
    cv::threshold(projected_, mask_, 127, 255, cv::THRESH_BINARY);
    benchmark::DoNotOptimize(mask_.data);
  }

 private:
  cv::Mat histogram_, ycrcb_, projected_, mask_;
};

void skin_beside_back_projection(benchmark::State& state) {
  SkinSegmenter segmenter(test::general_model());
  BackProjection peer;
  const cv::Mat bgr = picture();
  bench::Beside both;
  for (auto _ : state) {
    both.ours([&] { benchmark::DoNotOptimize(segmenter.segment(bgr).data); });
    both.peer([&] { peer.segment(bgr); });
  }
  both.report(state);
}
BENCHMARK(skin_beside_back_projection)->Unit(benchmark::kMillisecond);

void skin_reestimation(benchmark::State& state) {
  const ColorModel model = test::general_model();
  const cv::Mat bgr = test::hand_before(test::kBeigeColor);
  for (auto _ : state) benchmark::DoNotOptimize(reestimate_skin(model, 0, bgr).refused);
}
BENCHMARK(skin_reestimation)->Unit(benchmark::kMillisecond);

}  // namespace
