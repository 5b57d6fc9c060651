#include "app/pipelines/hand_watch.hpp"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

namespace armsreach::app {
namespace {

using Eigen::Vector2d;

constexpr double kSeen = 0.2;      // s: what comes and goes is noise
constexpr double kFade = 0.4;      // s, in which 63 % of a way are forgotten
constexpr double kFar = 0.35;      // sizes: ragged blobs move by less
constexpr double kKept = 0.5;      // s out of sight, as long as its number
constexpr double kRemembered = 5;  // s for which what has moved is a hand
// Log odds by which what rests must exceed what moves, that the latter is the view of the wall
// behind it.
constexpr double kMuchLikelier = 2;

double seconds_between(Timestamp from, Timestamp to) { return seconds_from_timestamp(to - from); }

}  // namespace

std::optional<Vector2d> HandWatch::update(const HandsState& hands, const Frame& frame) {
  if (frame.color.size() != cv::Size(camera_.width, camera_.height)) return std::nullopt;
  cv::Mat grey = frame.color;
  if (grey.channels() == 3) cv::cvtColor(frame.color, grey, cv::COLOR_BGR2GRAY);
  turn_meter_.take(grey);
  if (!hands.hands.empty()) tracks_.clear();
  std::erase_if(tracks_, [&](const auto& entry) {
    return seconds_between(entry.second.time, frame.time) > kKept;
  });
  if (!hands.hands.empty() || hands.unproven.empty()) return std::nullopt;
  const auto turn = turn_meter_.measure(Eigen::Quaterniond::Identity());
  double most_evidence = kLeastEvidence;
  const Track* likeliest = nullptr;  // of those that have moved
  for (const gesture::Hand& hand : hands.unproven) {
    const auto [entry, is_new] = tracks_.try_emplace(hand.id, Track{.since = frame.time});
    Track& track = entry->second;
    // While nobody can tell how the picture has moved, neither can it be told of a hand.
    if (turn && !is_new) follow(track, hand, frame.time, turn->before_from_after);
    track.time = frame.time;
    track.center = hand.seen.center;
    track.evidence = std::max(track.evidence, hand.seen.evidence);
    most_evidence = std::max(most_evidence, track.evidence);
    if (!track.moved || seconds_between(*track.moved, frame.time) > kRemembered) continue;
    if (likeliest == nullptr || track.evidence > likeliest->evidence) likeliest = &track;
  }
  if (likeliest == nullptr || likeliest->evidence < most_evidence - kMuchLikelier)
    return std::nullopt;
  return likeliest->center;
}

// A step counts where the hand has made more of it than the picture.
void HandWatch::follow(Track& track, const gesture::Hand& hand, Timestamp time,
                       const Eigen::Quaterniond& before_from_now) const {
  const auto carried =
      project(camera_, before_from_now.conjugate() * unproject(camera_, track.center));
  if (!carried) return;
  const Vector2d own = hand.seen.center - *carried;
  track.way *= std::exp(-seconds_between(track.time, time) / kFade);
  if (own.norm() > (*carried - track.center).norm())
    track.way += own / std::sqrt(std::max(hand.seen.area, 1.0));
  if (track.way.norm() > kFar && seconds_between(track.since, time) > kSeen) track.moved = time;
}

}  // namespace armsreach::app
