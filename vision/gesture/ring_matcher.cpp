#include "vision/gesture/ring_matcher.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numbers>
#include <utility>

namespace armsreach::gesture {
namespace {

constexpr int kCoarse = 3;  // steps between the turns that are always looked at
// How far a hand turns against its forearm in the image: a wrist deviates by 20 deg to the thumb's
// side and 35 to the other, and a hand bent towards the camera foreshortens.
constexpr double kWristRange = 45 * std::numbers::pi / 180;

constexpr int kLevelSteps = 4;  // to both sides, for the angle between steps: 16 deg at K = 45

const std::uint8_t* bytes_of(const RingSignature& signature) { return signature.planes[0].data(); }

}  // namespace

RingKernels ring_kernels(Isa isa) {
#ifdef __x86_64__
  if (isa == Isa::v4) return v4::kRingKernels;
  if (isa == Isa::v3) return v3::kRingKernels;
#endif
  static_cast<void>(isa);
  return baseline::kRingKernels;
}

RingMatcher::RingMatcher(TemplateSet set, Isa isa)
    : set_(std::move(set)), kernels_(ring_kernels(isa)) {
  for (const GestureTemplate& one : set_.templates) gestures_.push_back(one.gesture);
  std::sort(gestures_.begin(), gestures_.end());
  gestures_.erase(std::unique(gestures_.begin(), gestures_.end()), gestures_.end());
  for (const GestureTemplate& one : set_.templates) {
    const auto at = std::lower_bound(gestures_.begin(), gestures_.end(), one.gesture);
    gesture_of_.push_back(static_cast<int>(at - gestures_.begin()));
  }
}

TurnedSignature RingMatcher::turned(const RingSignature& seen) const {
  TurnedSignature twice{};
  const auto samples = static_cast<std::size_t>(set_.layout.samples);
  for (std::size_t plane = 0; plane < seen.planes.size(); ++plane) {
    for (std::size_t i = 0; i < 2 * samples + 2; ++i)
      twice.planes[plane][i] = seen.planes[plane][i % samples];
    for (int half = 0; half < 2; ++half) {
      for (unsigned value = 0; value < 16; ++value) {
        unsigned weight = 0;
        for (unsigned bit = 0; bit < 4; ++bit) {
          const std::size_t ring = 8 * plane + 4 * static_cast<std::size_t>(half) + bit;
          if ((value >> bit) & 1U && ring < set_.layout.weights.size())
            weight += set_.layout.weights[ring];
        }
        twice.weights[plane][half][value] = static_cast<std::uint8_t>(weight);
      }
    }
  }
  std::memset(twice.inside, 255, samples);
  twice.samples = set_.layout.samples;
  return twice;
}

std::uint32_t RingMatcher::change_with_one_step(const TurnedSignature& seen,
                                                const RingSignature& same) const {
  std::uint32_t change = 0;
  kernels_.mismatches(seen, bytes_of(same), 1, 1, 1, &change);
  return change;
}

RingMatcher::Shifts RingMatcher::shifts_around(double angle) const {
  const int middle = static_cast<int>(std::lround(angle / set_.layout.step()));
  const int reach = static_cast<int>(kWristRange / set_.layout.step());
  const int first = (middle - reach) % set_.layout.samples;
  return {first < 0 ? first + set_.layout.samples : first, 2 * reach + 1};
}

RingMatcher::Look RingMatcher::look_at(const RingSignature& seen, bool mirrored,
                                       const std::optional<double>& straight) const {
  Look look{turned(seen), 0, straight ? shifts_around(*straight) : all_shifts(), mirrored};
  look.change = change_with_one_step(look.twice, seen);
  return look;
}

void RingMatcher::search(const Look& look, int index, std::uint32_t bound, Place* best) const {
  const int samples = set_.layout.samples;
  const GestureTemplate& one = set_.templates[static_cast<std::size_t>(index)];
  const Shifts shifts = one.upright ? look.upright : all_shifts();
  std::array<std::uint32_t, kMostSamples> distances;
  const auto take = [&](int shift, std::uint32_t distance) {
    if (distance < best->distance) *best = {distance, index, shift, look.mirrored};
  };
  // Every third shift, in the middle of its three; two runs where they pass the full turn.
  int done = 0;
  const int coarse = (shifts.count + 2) / 3;
  while (done < coarse) {
    const int first = (shifts.first + 1 + kCoarse * done) % samples;
    const int run = std::min(coarse - done, (samples - first + kCoarse - 1) / kCoarse);
    kernels_.mismatches(look.twice, bytes_of(one.signature), first, kCoarse, run,
                        distances.data() + done);
    done += run;
  }
  for (int j = 0; j < coarse; ++j)
    take((shifts.first + 1 + kCoarse * j) % samples, distances[static_cast<std::size_t>(j)]);
  for (int j = 0; j < coarse; ++j) {
    const std::uint32_t least = std::min(bound, best->distance);
    if (distances[static_cast<std::size_t>(j)] >= std::uint64_t{least} + look.change) continue;
    for (const int beside : {0, 2}) {
      const int shift = (shifts.first + kCoarse * j + beside) % samples;
      std::uint32_t distance = 0;
      kernels_.mismatches(look.twice, bytes_of(one.signature), shift, 1, 1, &distance);
      take(shift, distance);
    }
  }
}

// Distances rise from the best turn about evenly to both sides: its place between the steps is
// where those before and those after are level.
double RingMatcher::angle_of(const RingSignature& seen, const RingMatch& best) const {
  const int samples = set_.layout.samples;
  const GestureTemplate& known = set_.templates[static_cast<std::size_t>(best.index)];
  const TurnedSignature twice = turned(best.mirrored ? mirrored(seen, set_.layout) : seen);
  const auto distance = [&](int shift) {
    std::uint32_t sum = 0;
    kernels_.mismatches(twice, bytes_of(known.signature), (shift + samples) % samples, 1, 1, &sum);
    return static_cast<double>(sum);
  };
  double tilt = 0;   // sum of what is before, less what is after
  double slope = 0;  // of a step, summed over the same pairs
  double nearest = 0;
  for (int away = 1; away <= kLevelSteps; ++away) {
    const double before = distance(best.shift - away);
    const double after = distance(best.shift + away);
    if (away == 1) nearest = before + after;
    tilt += before - after;
    slope = (before + after - nearest) / std::max(1, 2 * (away - 1));
  }
  const double between = slope > 0 ? std::clamp(tilt / (2 * kLevelSteps * slope), -1.0, 1.0) : 0;
  const double angle = (best.shift + between) * set_.layout.step();
  return std::remainder(best.mirrored ? -angle : angle, 2 * std::numbers::pi);
}

RingMatch RingMatcher::match_of(const Nearest& nearest) const {
  const auto g = [&](const Place& place) {
    return 1 - 2.0 * place.distance / set_.layout.total_weight();
  };
  double sum = 0;
  int count = 0;
  for (const Place& place : nearest) {
    if (place.index < 0) break;
    sum += g(place);
    ++count;
  }
  const Place& best = nearest[0];
  const double turn = std::remainder(best.shift * set_.layout.step(), 2 * std::numbers::pi);
  return {best.index, best.shift,  best.mirrored,
          g(best),    sum / count, best.mirrored ? -turn : turn};
}

std::vector<RingMatch> RingMatcher::match(const RingSignature& seen, Hands hands,
                                          const std::optional<double>& straight) const {
  std::vector<Look> looks;
  if (hands != Hands::mirrored) looks.push_back(look_at(seen, false, straight));
  if (hands != Hands::as_learnt) {
    const auto mirrored_straight = straight ? std::optional(-*straight) : std::nullopt;
    looks.push_back(look_at(mirrored(seen, set_.layout), true, mirrored_straight));
  }
  std::vector<Nearest> nearest(gestures_.size());
  for (std::size_t i = 0; i < gesture_of_.size(); ++i) {
    Nearest& so_far = nearest[static_cast<std::size_t>(gesture_of_[i])];
    Place place;
    for (const Look& look : looks)
      search(look, static_cast<int>(i), so_far.back().distance, &place);
    if (place.distance >= so_far.back().distance) continue;
    const auto at = std::find_if(so_far.begin(), so_far.end(), [&](const Place& other) {
      return place.distance < other.distance;
    });
    std::move_backward(at, so_far.end() - 1, so_far.end());
    *at = place;
  }
  std::vector<RingMatch> matches;
  for (const Nearest& one : nearest) matches.push_back(match_of(one));
  return matches;
}

}  // namespace armsreach::gesture
