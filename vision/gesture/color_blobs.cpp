#include "vision/gesture/color_blobs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <opencv2/imgproc.hpp>

namespace armsreach::gesture {
namespace {

cv::Rect scaled(const cv::Rect& box, const cv::Size2d& scale) {
  const auto x = static_cast<int>(std::lround(box.x * scale.width));
  const auto y = static_cast<int>(std::lround(box.y * scale.height));
  const auto right = static_cast<int>(std::lround((box.x + box.width) * scale.width));
  const auto bottom = static_cast<int>(std::lround((box.y + box.height) * scale.height));
  return {x, y, right - x, bottom - y};
}

double distance(const cv::Point& point, const cv::Rect& box) {
  const int dx = std::max({box.x - point.x, 0, point.x - (box.x + box.width - 1)});
  const int dy = std::max({box.y - point.y, 0, point.y - (box.y + box.height - 1)});
  return std::hypot(dx, dy);
}

}  // namespace

ColorBlobFinder::ColorBlobFinder(ColorModel model, const ColorBlobOptions& options)
    : model_(std::move(model)), options_(options), table_(ColorTable::winners(model_)) {}

ColorBlobs ColorBlobFinder::find(const cv::Mat& bgr, const cv::Mat& hidden) {
  CV_Assert(bgr.type() == CV_8UC3 && (hidden.empty() || hidden.size() == bgr.size()));
  const int factor = std::min(std::max(1, bgr.cols / options_.width), std::max(1, bgr.rows));
  cv::Mat small = bgr, cover = hidden;
  if (factor > 1) {
    const cv::Size size(bgr.cols / factor, bgr.rows / factor);
    cv::resize(bgr, small, size, 0, 0, cv::INTER_AREA);
    if (!hidden.empty()) cv::resize(hidden, cover, size, 0, 0, cv::INTER_NEAREST);
  }
  table_.apply(small, &classes_);
  if (!cover.empty()) classes_.setTo(0, cover);
  ColorBlobs blobs;
  const cv::Size2d scale(static_cast<double>(bgr.cols) / small.cols,
                         static_cast<double>(bgr.rows) / small.rows);
  for (int i = 0; i < static_cast<int>(model_.classes.size()); ++i) add_blobs(i, scale, &blobs);
  std::stable_sort(blobs.begin(), blobs.end(),
                   [](const ColorBlob& a, const ColorBlob& b) { return a.area > b.area; });
  return blobs;
}

void ColorBlobFinder::add_blobs(int class_index, const cv::Size2d& scale, ColorBlobs* blobs) {
  const double least = options_.least_area * static_cast<double>(classes_.total());
  cv::Mat own = classes_ == class_index + 1;
  if (cv::countNonZero(own) < least) return;
  cv::blur(own, filtered_, {options_.filter, options_.filter});
  own = filtered_ > 127;
  cv::Mat labels, stats, centers;
  const int count = cv::connectedComponentsWithStats(own, labels, stats, centers, 8, CV_32S);
  for (int label = 1; label < count; ++label) {
    const auto stat = [&](int column) { return stats.at<int>(label, column); };
    if (stat(cv::CC_STAT_AREA) < least) continue;
    const cv::Rect box(stat(cv::CC_STAT_LEFT), stat(cv::CC_STAT_TOP), stat(cv::CC_STAT_WIDTH),
                       stat(cv::CC_STAT_HEIGHT));
    const Eigen::Vector2d center(scale.width * (centers.at<double>(label, 0) + 0.5) - 0.5,
                                 scale.height * (centers.at<double>(label, 1) + 0.5) - 0.5);
    blobs->push_back({model_.classes[class_index].name, scaled(box, scale),
                      stat(cv::CC_STAT_AREA) * scale.area(), center});
  }
}

double gap(const ColorBlob& blob, const HandObservation& hand) {
  if (hand.outline.empty() || hand.area <= 0) return std::numeric_limits<double>::infinity();
  const cv::Point2f center(static_cast<float>(blob.center.x()),
                           static_cast<float>(blob.center.y()));
  if (cv::pointPolygonTest(hand.outline, center, false) >= 0) return 0;
  double least = std::numeric_limits<double>::infinity();
  for (const cv::Point& point : hand.outline) least = std::min(least, distance(point, blob.box));
  return least / std::sqrt(hand.area);
}

// What this frame alone says. The thing in the hand has the wider limit.
std::optional<ColorBlob> HeldThing::seen(const ColorBlobs& blobs,
                                         const HandObservations& hands) const {
  const ColorBlob* best = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (const ColorBlob& blob : blobs) {
    const bool in_hand = held_ && held_->name == blob.name;
    double distance = std::numeric_limits<double>::infinity();
    for (const HandObservation& hand : hands) distance = std::min(distance, gap(blob, hand));
    if (distance > (in_hand ? options_.release : options_.take)) continue;
    // Among things that are near, the one already in the hand stays there.
    const double rank = in_hand ? distance - options_.release : distance;
    if (rank >= least) continue;
    least = rank;
    best = &blob;
  }
  return best ? std::optional(*best) : std::nullopt;
}

const std::optional<ColorBlob>& HeldThing::update(const ColorBlobs& blobs,
                                                  const HandObservations& hands) {
  const auto now = seen(blobs, hands);
  const auto name = now ? std::optional(now->name) : std::nullopt;
  const auto held_name = held_ ? std::optional(held_->name) : std::nullopt;
  if (name == held_name) {
    agreeing_ = 0;
    if (now) held_ = now;
    return held_;
  }
  agreeing_ = name == candidate_ && agreeing_ > 0 ? agreeing_ + 1 : 1;
  candidate_ = name;
  if (agreeing_ >= options_.frames) {
    held_ = now;
    agreeing_ = 0;
  }
  return held_;
}

}  // namespace armsreach::gesture
