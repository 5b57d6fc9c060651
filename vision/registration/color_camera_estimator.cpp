#include "vision/registration/color_camera_estimator.hpp"

#include <utility>

namespace armsreach {
namespace {

constexpr std::size_t kContours = 200;        // of each direction, that are kept of a view
constexpr std::size_t kFewestContours = 400;  // of all views, for an attempt
// Contrast is 0.12 and more in rooms and on tables, and up to 0.05 where depth and colour are of
// different places and so agree by chance alone.
constexpr double kLeastContrast = 0.08;
constexpr double kRegisteredShare = 0.75;
constexpr double kGreatestRivalShare = 0.9;
constexpr double kGreatestUncertainty = 0.75;  // units of a hypothesis: 3 px at a width of 640

std::vector<Eigen::Vector3d> scene_points(const cv::Mat& depth, const Camera& camera) {
  constexpr int kColumns = 8;
  constexpr int kRows = 6;
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < kRows; ++i) {
    for (int j = 0; j < kColumns; ++j) {
      const int row = (2 * i + 1) * depth.rows / (2 * kRows);
      const int col = (2 * j + 1) * depth.cols / (2 * kColumns);
      const double z = static_cast<double>(depth.at<float>(row, col));
      if (z > 0) points.push_back(z * unproject(camera, Eigen::Vector2d(col, row)));
    }
  }
  return points;
}

// Coinciding cameras are likely beforehand, so rivals need not be ruled out for them.
Registration judged(const ColorSearchResult& search, const Camera& assumed) {
  const double unit = hypothesis_unit(assumed);
  if (search.contrast < kLeastContrast) return Registration::cannot_tell;
  if (search.registered_share > kRegisteredShare || search.displacement < unit) {
    return Registration::registered;
  }
  const bool reliable =
      search.rival_share < kGreatestRivalShare && search.uncertainty < kGreatestUncertainty * unit;
  return reliable ? Registration::estimated : Registration::cannot_tell;
}

}  // namespace

ColorCameraEstimator::ColorCameraEstimator(const Camera& depth, const Camera& assumed,
                                           RegistrationOptions options)
    : depth_(depth), assumed_(assumed), options_(options), next_attempt_(options.views) {}

std::optional<RegistrationVerdict> ColorCameraEstimator::add(const Frame& frame) {
  if (done_ || frames_++ % options_.stride != 0) return std::nullopt;
  keep(frame);
  if (++looked_at_ < next_attempt_) return std::nullopt;
  next_attempt_ *= 2;
  RegistrationVerdict verdict = attempt();
  done_ = verdict.registration != Registration::cannot_tell;
  if (!done_ && std::exchange(told_, true)) return std::nullopt;
  if (done_) views_.clear();
  return verdict;
}

void ColorCameraEstimator::keep(const Frame& frame) {
  if (frame.depth.size() != cv::Size(depth_.width, depth_.height) ||
      frame.color.size() != cv::Size(assumed_.width, assumed_.height)) {
    return;
  }
  ContourView view;
  view.contours = occluding_contours(frame.depth, depth_, kContours);
  if (view.contours.empty()) return;
  view.scene = scene_points(frame.depth, depth_);
  view.depth_size = frame.depth.size();
  view.edges = color_edges(frame.color);
  if (views_.size() >= static_cast<std::size_t>(options_.most_views)) views_.erase(views_.begin());
  views_.push_back(std::move(view));
}

RegistrationVerdict ColorCameraEstimator::attempt() const {
  RegistrationVerdict verdict;
  verdict.color.camera = assumed_;
  verdict.frames = frames_;
  std::size_t contours = 0;
  for (const ContourView& view : views_) contours += view.contours.size();
  if (contours < kFewestContours) return verdict;
  verdict.search = search_color_camera(views_, assumed_);
  verdict.registration = judged(verdict.search, assumed_);
  if (verdict.registration != Registration::registered) {
    verdict.color = color_camera(verdict.search.best, assumed_);
  }
  return verdict;
}

}  // namespace armsreach
