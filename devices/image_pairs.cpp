#include "devices/image_pairs.hpp"

#include <cstddef>
#include <cstdlib>
#include <utility>

namespace armsreach {
namespace {

// Two free-running cameras are at most half a period apart; a tenth more is for their jitter.
constexpr double kTolerance = 0.6;  // periods

// One stream may be delivered a few images behind the other.
constexpr std::size_t kMostWaiting = 4;

void keep(std::deque<TimedImage>* waiting, TimedImage image) {
  waiting->push_back(std::move(image));
  if (waiting->size() > kMostWaiting) waiting->pop_front();
}

// The image at `index`, which leaves with all before it.
TimedImage taken(std::deque<TimedImage>* waiting, std::size_t index) {
  TimedImage image = std::move((*waiting)[index]);
  waiting->erase(waiting->begin(), waiting->begin() + static_cast<std::ptrdiff_t>(index) + 1);
  return image;
}

}  // namespace

ImagePairs::ImagePairs(double rate) : tolerance_(timestamp_from_seconds(kTolerance / rate)) {}

std::optional<ImagePair> ImagePairs::add_color(TimedImage color) {
  if (const auto partner = nearest(depth_, color.time)) {
    color_.clear();
    return ImagePair{std::move(color), taken(&depth_, *partner)};
  }
  keep(&color_, std::move(color));
  return std::nullopt;
}

std::optional<ImagePair> ImagePairs::add_depth(TimedImage depth) {
  if (const auto partner = nearest(color_, depth.time)) {
    depth_.clear();
    return ImagePair{taken(&color_, *partner), std::move(depth)};
  }
  keep(&depth_, std::move(depth));
  return std::nullopt;
}

std::optional<std::size_t> ImagePairs::nearest(const std::deque<TimedImage>& waiting,
                                               Timestamp time) const {
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < waiting.size(); ++i) {
    const Timestamp apart = std::abs(waiting[i].time - time);
    if (apart > tolerance_) continue;
    if (!best || apart < std::abs(waiting[*best].time - time)) best = i;
  }
  return best;
}

}  // namespace armsreach
