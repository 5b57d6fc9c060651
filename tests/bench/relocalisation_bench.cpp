// A kidnapped frame against 10, 50 and 200 key frames: the whole answer, and its ranking and
// matching beside cv::BFMatcher over all key frames' descriptors.
#include <map>

#include <benchmark/benchmark.h>
#include <opencv2/core/mat.hpp>
#include <opencv2/features2d.hpp>

#include "tests/unit/vision/relocalisation/painted_room.hpp"
#include "vision/relocalisation/matching.hpp"
#include "vision/relocalisation/relocaliser.hpp"

namespace {

using namespace armsreach;
using namespace armsreach::relocalisation;

constexpr int kViews = 20;  // of each painted room, all round from its centre

// Views of as many rooms as are needed; made once for each number.
const Relocaliser& mapped(int key_frames) {
  static std::map<int, Relocaliser> maps;
  const auto found = maps.find(key_frames);
  if (found != maps.end()) return found->second;
  RelocaliserOptions options;
  options.most_key_frames = key_frames;
  options.key_distance = 0.0005;  // the rooms stand a millimetre from each other
  Relocaliser relocaliser(options);
  for (int i = 0; i < key_frames; ++i) {
    const test::PaintedRoom room(static_cast<std::uint64_t>(1 + i / kViews));
    relocaliser.consider(test::tracked(
        room.frame(test::registered_sensor(), test::at(0.001 * i, 6.28 / kViews * i), i)));
  }
  return maps.emplace(key_frames, std::move(relocaliser)).first->second;
}

FramePtr query() {
  return test::PaintedRoom(1).frame(test::registered_sensor(), test::at(0.05, 0.2));
}

void relocalise(benchmark::State& state) {
  const Relocaliser& relocaliser = mapped(static_cast<int>(state.range(0)));
  const FramePtr frame = query();
  for (auto _ : state) {
    const auto candidate = relocaliser.relocalise(*frame);
    if (!candidate) state.SkipWithError("not recognised");
  }
  state.counters["key_frames"] = static_cast<double>(relocaliser.key_frames().size());
}

void find_features_of_query(benchmark::State& state) {
  const FramePtr frame = query();
  for (auto _ : state) benchmark::DoNotOptimize(view_of(*frame, 500));
}

void rank_and_match(benchmark::State& state) {
  const Relocaliser& relocaliser = mapped(static_cast<int>(state.range(0)));
  const Features features = view_of(*query(), 500)->features;
  const RelocaliserOptions options;
  for (auto _ : state) {
    int position = 0;
    for (const auto& key_frame : relocaliser.key_frames()) {
      const auto most = position++ < options.most_tried ? features.size() + options.most_glanced
                                                        : options.most_glanced;
      benchmark::DoNotOptimize(
          match_features(features, key_frame->view.features, options.match_ratio, most));
    }
  }
}

cv::Mat float_descriptors(const Features& features) {
  cv::Mat rows(static_cast<int>(features.size()), static_cast<int>(Descriptor().size()), CV_32FC1);
  for (int y = 0; y < rows.rows; ++y) {
    for (int x = 0; x < rows.cols; ++x)
      rows.at<float>(y, x) = static_cast<float>(features.descriptors[y][x]);
  }
  return rows;
}

void match_with_bf_matcher(benchmark::State& state) {
  const Relocaliser& relocaliser = mapped(static_cast<int>(state.range(0)));
  const cv::Mat features = float_descriptors(view_of(*query(), 500)->features);
  std::vector<cv::Mat> known;
  for (const auto& key_frame : relocaliser.key_frames())
    known.push_back(float_descriptors(key_frame->view.features));
  const cv::BFMatcher matcher(cv::NORM_L2);
  std::vector<std::vector<cv::DMatch>> matches;
  for (auto _ : state) {
    for (const cv::Mat& descriptors : known) matcher.knnMatch(features, descriptors, matches, 2);
  }
}

BENCHMARK(find_features_of_query)->Unit(benchmark::kMillisecond);
BENCHMARK(relocalise)->Arg(10)->Arg(50)->Arg(200)->Unit(benchmark::kMillisecond);
BENCHMARK(rank_and_match)->Arg(10)->Arg(50)->Arg(200)->Unit(benchmark::kMillisecond);
BENCHMARK(match_with_bf_matcher)->Arg(10)->Arg(50)->Arg(200)->Unit(benchmark::kMillisecond);

}  // namespace
