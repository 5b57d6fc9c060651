// What telling a gesture costs: against templates, hands and K, beside cv::matchTemplate over the
// same poses, and a whole frame.
#include <numbers>

#include <benchmark/benchmark.h>
#include <opencv2/imgproc.hpp>

#include "devices/sim/hand/gesture.hpp"
#include "devices/sim/hand/silhouette.hpp"
#include "devices/sim/random.hpp"
#include "tests/bench/beside.hpp"
#include "vision/gesture/gesture_detector.hpp"

namespace {

using namespace armsreach;
using namespace armsreach::gesture;

cv::Mat hand(sim::Gesture gesture, int side, double roll) {
  sim::HandSurfaceOptions options;
  options.cell = 0.005;
  options.forearm = 0.28;
  const sim::HandSurface surface(sim::mean_anatomy(), options);
  sim::SilhouetteCamera camera(side);
  sim::HandView view;
  view.roll = roll;
  return camera.draw(surface, sim::pose_of(gesture, surface.anatomy()), view) > 0;
}

// So many templates of five gestures, each a little different.
TemplateSet bank(const RingLayout& layout, int count) {
  TemplateSet set{layout, {}};
  sim::Random random(1);
  std::vector<HandShape> shapes;
  for (int g = 0; g < 5; ++g) {
    const cv::Mat mask = hand(static_cast<sim::Gesture>(g), 160, 0);
    shapes.push_back(HandFinder().find(mask).at(0).readings.at(0));
  }
  for (int i = 0; i < count; ++i) {
    auto one = template_of(std::to_string(i % 5), shapes[static_cast<std::size_t>(i % 5)], layout);
    for (int flip = 0; flip < layout.samples; ++flip)
      one.signature.set(random.below(layout.rings()), random.below(layout.samples));
    one.upright = false;  // every turn is searched
    set.templates.push_back(one);
  }
  return set;
}

RingSignature seen_hand(const RingLayout& layout) {
  const auto blobs = HandFinder().find(hand(sim::Gesture::L, 240, 0.5));
  return signature_of(blobs.at(0).readings.at(0), layout);
}

// A hand among templates at every turn.
void ring_match(benchmark::State& state) {
  const auto templates = static_cast<int>(state.range(0));
  const RingLayout layout = linear_rings(static_cast<int>(state.range(1)));
  const RingMatcher matcher(bank(layout, templates));
  const RingSignature seen = seen_hand(layout);
  for (auto _ : state) benchmark::DoNotOptimize(matcher.match(seen, Hands::as_learnt));
}
BENCHMARK(ring_match)
    ->ArgNames({"templates", "k"})
    ->ArgsProduct({{300}, {15, 30, 45, 90, 120}})
    ->Unit(benchmark::kMillisecond);

// The same poses by images: every template, turned by every step, against the hand's image at its
// size.
class TurnedImages {
 public:
  explicit TurnedImages(int turns) {
    for (int turn = 0; turn < turns; ++turn) {
      turned_.push_back(image(sim::Gesture::open, 2 * std::numbers::pi * turn / turns));
    }
    seen_ = image(sim::Gesture::L, 0);
  }
  void match() {
    for (const cv::Mat& one : turned_) {
      cv::matchTemplate(seen_, one, score_, cv::TM_CCORR_NORMED);
      benchmark::DoNotOptimize(score_.data);
    }
  }

 private:
  static cv::Mat image(sim::Gesture gesture, double roll) {
    cv::Mat small;
    cv::resize(hand(gesture, 160, roll), small, {64, 64});
    return small;
  }
  std::vector<cv::Mat> turned_;
  cv::Mat seen_;
  cv::Mat score_;
};

void match_beside_match_template(benchmark::State& state) {
  const auto templates = static_cast<int>(state.range(0));
  const RingLayout layout = linear_rings();
  const RingMatcher matcher(bank(layout, templates));
  const RingSignature seen = seen_hand(layout);
  TurnedImages images(layout.samples);
  bench::Beside both;
  for (auto _ : state) {
    both.ours([&] { benchmark::DoNotOptimize(matcher.match(seen, Hands::as_learnt)); });
    both.peer([&] {
      for (int i = 0; i < templates; ++i) images.match();
    });
  }
  both.report(state);
}
BENCHMARK(match_beside_match_template)
    ->ArgName("templates")
    ->Arg(3)
    ->Arg(30)
    ->Arg(100)
    ->Arg(300)
    ->Unit(benchmark::kMillisecond);

// Shape, texture and gesture of a frame's hands from its mask and colours, 320x240.
void gestures_of_a_frame(benchmark::State& state) {
  const auto templates = static_cast<int>(state.range(0));
  const bool two = state.range(1) == 2;
  cv::Mat frame(240, 320, CV_8UC1, cv::Scalar(0));
  const cv::Mat one = hand(sim::Gesture::L, 150, 0);
  one.copyTo(frame(cv::Rect(5, 90, 150, 150)));
  if (two) one.copyTo(frame(cv::Rect(165, 90, 150, 150)));
  cv::Mat bgr(frame.size(), CV_8UC3);
  cv::RNG(1).fill(bgr, cv::RNG::UNIFORM, 60, 90);
  cv::add(bgr, cv::Scalar(30, 60, 110), bgr, frame);
  GestureDetectorOptions options;
  options.texture = TextureModel();
  const GestureDetector detector(bank(linear_rings(), templates), options);
  for (auto _ : state) benchmark::DoNotOptimize(detector.detect(frame, bgr));
}
BENCHMARK(gestures_of_a_frame)
    ->ArgNames({"templates", "hands"})
    ->ArgsProduct({{3, 30, 100, 300}, {1, 2}})
    ->Unit(benchmark::kMillisecond);

}  // namespace
