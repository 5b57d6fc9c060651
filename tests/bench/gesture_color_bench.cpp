// Skin in a 320x240 picture: our table with its box filter, beside OpenCV's way to the same end:
// conversion to YCrCb, back projection of a UV histogram, box filter, threshold.
#include <benchmark/benchmark.h>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "tests/unit/vision/gesture/painted_skin.hpp"
#include "vision/gesture/color_blobs.hpp"
#include "vision/gesture/skin_segmenter.hpp"

namespace {

using namespace armsreach::gesture;

// Hand, wall and noise, so that the table is read all over.
cv::Mat picture() {
  cv::Mat bgr = test::hand_before(test::kWallColor);
  cv::Mat noise = test::painted(bgr.size() / 2, cv::Scalar(128, 128, 128), 60);
  noise.copyTo(bgr(cv::Rect({0, 0}, noise.size())));
  return bgr;
}

void BM_SkinTableAndBox(benchmark::State& state) {
  SkinSegmenter segmenter(test::general_model());
  const cv::Mat bgr = picture();
  for (auto _ : state) benchmark::DoNotOptimize(segmenter.segment(bgr).data);
}
BENCHMARK(BM_SkinTableAndBox)->Unit(benchmark::kMicrosecond);

void BM_SkinTableAlone(benchmark::State& state) {
  const ColorTable table = ColorTable::posteriors(test::general_model(), 0);
  const cv::Mat bgr = picture();
  cv::Mat posterior;
  for (auto _ : state) {
    table.apply(bgr, &posterior);
    benchmark::DoNotOptimize(posterior.data);
  }
}
BENCHMARK(BM_SkinTableAlone)->Unit(benchmark::kMicrosecond);

void BM_SkinOpenCv(benchmark::State& state) {
  const cv::Mat bgr = picture();
  const ColorLikelihood skin(test::general_model().classes[0].pixels, 0.01);
  cv::Mat histogram, ycrcb, projected, mask;
  cv::normalize(skin.uv, histogram, 0, 255, cv::NORM_MINMAX);
  const int channels[] = {2, 1};  // Cb, Cr as our u, v; rows are the first of a cv histogram
  const float range[] = {0, 256};
  const float* ranges[] = {range, range};
  cv::Mat transposed = histogram.t();
  for (auto _ : state) {
    cv::cvtColor(bgr, ycrcb, cv::COLOR_BGR2YCrCb);
    cv::calcBackProject(&ycrcb, 1, channels, transposed, projected, ranges);
    cv::blur(projected, projected, {5, 5});
    cv::threshold(projected, mask, 127, 255, cv::THRESH_BINARY);
    benchmark::DoNotOptimize(mask.data);
  }
}
BENCHMARK(BM_SkinOpenCv)->Unit(benchmark::kMicrosecond);

void BM_SkinReestimation(benchmark::State& state) {
  const ColorModel model = test::general_model();
  const cv::Mat bgr = test::hand_before(test::kBeigeColor);
  for (auto _ : state) benchmark::DoNotOptimize(reestimate_skin(model, 0, bgr).refused);
}
BENCHMARK(BM_SkinReestimation)->Unit(benchmark::kMicrosecond);

}  // namespace
