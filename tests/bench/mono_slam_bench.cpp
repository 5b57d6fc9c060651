// The filter's update beside a textbook's, template search beside cv::matchTemplate, and a whole
// frame. Peers take turns in one loop, so that their ratio holds on a busy machine.
#include <algorithm>
#include <cmath>
#include <ctime>
#include <numeric>
#include <optional>
#include <vector>

#include <benchmark/benchmark.h>
#include <opencv2/imgproc.hpp>

#include "tests/bench/beside.hpp"
#include "tests/bench/textbook_ekf.hpp"
#include "vision/mono_slam/mono_slam.hpp"
#include "vision/mono_slam/search.hpp"

namespace armsreach::mono_slam {
namespace {

using bench::Beside;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kSigma = 0.5;

Camera camera() { return pinhole(320, 240, 200, 200, 159.5, 119.5); }

Vector2d pixel_of(std::size_t point) {
  return {20.0 + 28 * static_cast<double>(point % 11),
          15.0 + 20 * static_cast<double>(point / 11 % 11)};
}

// A map of points before a camera that stands still.
Filter filter_with(std::size_t points) {
  Filter filter(camera(), static_cast<int>(points), kSigma);
  filter.start(CameraState(), 1e-4 * CameraCovariance::Identity());
  for (std::size_t i = 0; i < points; ++i) {
    filter.add_point(pixel_of(i), 1 + 0.1 * static_cast<double>(i % 7), 0.1);
  }
  return filter;
}

// Twelve measurements, spread over the map.
std::vector<Measurement> measurements(const Filter& filter) {
  std::vector<Measurement> out;
  const auto ids = filter.ids();
  for (std::size_t i = 0; i < 12; ++i) {
    const std::size_t point = i * ids.size() / 12;
    out.push_back({*filter.predict(ids[point]), pixel_of(point)});
  }
  return out;
}

MatrixXd dense_jacobian(const Filter& filter, const std::vector<Measurement>& all) {
  MatrixXd h = MatrixXd::Zero(2 * static_cast<Eigen::Index>(all.size()), filter.rows());
  const auto ids = filter.ids();
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto at = 2 * static_cast<Eigen::Index>(i);
    const auto point = std::find(ids.begin(), ids.end(), all[i].prediction.id) - ids.begin();
    h.block<2, kCameraRows>(at, 0) = all[i].prediction.sighting.by_camera;
    h.block<2, 3>(at, kCameraRows + 3 * point) = all[i].prediction.sighting.by_point;
  }
  return h;
}

void update_beside_textbook(benchmark::State& state) {
  Filter filter = filter_with(static_cast<std::size_t>(state.range(0)));
  std::vector<int> all(12);
  std::iota(all.begin(), all.end(), 0);
  Beside both;
  for (auto _ : state) {
    filter.predict(1.0 / 30, MotionNoise(), std::nullopt);
    const auto measured = measurements(filter);
    TextbookEkf peer{Eigen::VectorXd::Zero(filter.rows()), filter.covariance()};
    const MatrixXd h = dense_jacobian(filter, measured);

    const JointInnovation* joint = nullptr;
    both.ours([&] {
      joint = &filter.innovation(measured);
      filter.update(all);
    });
    both.peer([&] { peer.update(h, joint->value, kSigma * kSigma); });
    if ((peer.covariance - filter.covariance()).cwiseAbs().maxCoeff() > 1e-9) {
      state.SkipWithError("the two do not agree");
    }
  }
  both.report(state);
}
BENCHMARK(update_beside_textbook)
    ->ArgName("points")
    ->Arg(12)
    ->Arg(25)
    ->Arg(50)
    ->Arg(100)
    ->Arg(150)
    ->Unit(benchmark::kMillisecond);

cv::Mat speckles(int seed) {
  cv::RNG random(static_cast<std::uint64_t>(seed));
  cv::Mat out(240, 320, CV_8UC1);
  random.fill(out, cv::RNG::UNIFORM, 0, 256);
  cv::GaussianBlur(out, out, cv::Size(), 2);
  cv::normalize(out, out, 0, 255, cv::NORM_MINMAX);
  return out;
}

// A 15x15 template in a round region of this radius; the peer searches the square around it.
void search_beside_match_template(benchmark::State& state) {
  const cv::Mat grey = speckles(1);
  const int radius = static_cast<int>(state.range(0));
  SearchImage image;
  image.set(grey);
  const Vector2d pixel(163, 118);
  const Template pattern = patch_at(grey, pixel, 15, camera(), Pose()).original();
  const cv::Mat small = grey(cv::Rect(156, 111, 15, 15)).clone();
  const cv::Rect around(163 - radius - 7, 118 - radius - 7, 2 * radius + 15, 2 * radius + 15);
  const Region region = ellipse(pixel, radius * radius / 9.0 * Eigen::Matrix2d::Identity(), 3);
  Beside both;
  cv::Mat scores;
  for (auto _ : state) {
    std::optional<Match> match;
    both.ours([&] { match = search(image, pattern, region, 0.8); });
    cv::Point best;
    both.peer([&] {
      cv::matchTemplate(grey(around), small, scores, cv::TM_CCOEFF_NORMED);
      cv::minMaxLoc(scores, nullptr, nullptr, nullptr, &best);
    });
    if (!match || (match->pixel - pixel).norm() > 0.5 || best.x != radius) {
      state.SkipWithError("not found");
    }
  }
  both.report(state);
}
BENCHMARK(search_beside_match_template)
    ->ArgName("radius")
    ->Arg(5)
    ->Arg(8)
    ->Arg(16)
    ->Arg(32)
    ->Unit(benchmark::kMicrosecond);

// A speckled wall two metres away, seen from a swaying camera.
cv::Mat wall(const cv::Mat& picture, const Pose& world_from_camera) {
  cv::Mat from_x(240, 320, CV_32FC1);
  cv::Mat from_y(240, 320, CV_32FC1);
  for (int y = 0; y < 240; ++y) {
    for (int x = 0; x < 320; ++x) {
      const Vector3d ray = world_from_camera.rotation() * unproject(camera(), Vector2d(x, y));
      const Vector3d origin = world_from_camera.translation();
      const Vector3d point = origin + (2 - origin.z()) / ray.z() * ray;
      from_x.at<float>(y, x) = static_cast<float>(320 + 100 * point.x());
      from_y.at<float>(y, x) = static_cast<float>(240 + 100 * point.y());
    }
  }
  cv::Mat out;
  cv::remap(picture, out, from_x, from_y, cv::INTER_LINEAR, cv::BORDER_REFLECT);
  return out;
}

// Of this thread, so that others on the machine do not count; ms.
double spent() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

void whole_frame(benchmark::State& state) {
  cv::Mat picture;
  cv::resize(speckles(2), picture, cv::Size(640, 480));
  std::vector<cv::Mat> frames;
  constexpr std::size_t kFrames = 60;
  for (std::size_t i = 0; i < kFrames; ++i) {
    const double angle = 2 * 3.14159265358979 * static_cast<double>(i) / kFrames;
    const Pose pose(so3_exp({0.05 * std::sin(angle), 0.08 * std::sin(angle), 0}),
                    Vector3d(0.2 * std::sin(angle), 0.1 * std::cos(angle) - 0.1, 0));
    frames.push_back(wall(picture, pose));
  }
  MonoSlamOptions options;
  options.visible_points = static_cast<int>(state.range(0));
  options.most_points = 150;
  options.interest.spacing = 10;
  MonoSlam slam(camera(), options);
  std::int64_t count = 0;
  const auto step = [&] {
    MonoInput input;
    input.time = timestamp_from_seconds(static_cast<double>(count) / 30);
    input.grey = frames[static_cast<std::size_t>(count) % kFrames];
    if (count == 0) input.depth = cv::Mat(240, 320, CV_32FC1, cv::Scalar(2));
    ++count;
    return slam.step(input);
  };
  for (std::size_t i = 0; i < kFrames; ++i) step();
  double visible = 0;
  double measured = 0;
  std::vector<double> milliseconds;
  for (auto _ : state) {
    const double start = spent();
    const MonoResult result = step();
    milliseconds.push_back(spent() - start);
    if (result.state != TrackingState::tracking) state.SkipWithError("lost");
    visible += result.visible;
    measured += result.inliers;
  }
  const auto p95 =
      milliseconds.begin() + static_cast<std::ptrdiff_t>(milliseconds.size() * 95 / 100);
  std::nth_element(milliseconds.begin(), p95, milliseconds.end());
  const auto frames_run = static_cast<double>(state.iterations());
  state.counters["p95_ms"] = *p95;
  state.counters["visible"] = visible / frames_run;
  state.counters["measured"] = measured / frames_run;
}
BENCHMARK(whole_frame)->ArgName("points")->Arg(12)->Arg(30)->Arg(60)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace armsreach::mono_slam
