// Which gesture a signature is most like, over all turns and both hands: exact, though most turns
// of most templates are never looked at.
//
// A template's distance (the weight of the samples that differ) to what is seen changes, from one
// turn to the next, by no more than the distance between what is seen and itself turned so: the
// triangle inequality. So every third turn is enough for all but the nearest templates.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "vision/gesture/ring_kernels.hpp"
#include "vision/gesture/template_set.hpp"

namespace armsreach::gesture {

enum class Hands { as_learnt, mirrored, both };  // mirrored: the other hand of the learnt ones

struct RingMatch {
  int index = -1;         // of the template in its set; -1: no templates
  int shift = 0;          // what is seen at angle i + shift is the template's at angle i
  bool mirrored = false;  // in the mirror image of what is seen
  double g = -1;
  // Mean g of the gesture's five nearest templates, or of all where it has fewer: steadier than the
  // nearest alone where a bank holds many people.
  double likeness = -1;
  double angle = 0;  // rad, clockwise, to whole steps; of the hand, not of its mirror image
};

class RingMatcher {
 public:
  explicit RingMatcher(TemplateSet set, Isa isa = best_isa());

  const TemplateSet& set() const { return set_; }
  const std::vector<std::string>& gestures() const { return gestures_; }  // in order of names
  // The best template of each gesture. `straight`: how far, in rad, a hand that is straight on the
  // forearm that was seen is turned from upright; nothing where no forearm was seen.
  std::vector<RingMatch> match(const RingSignature& seen, Hands hands,
                               const std::optional<double>& straight = std::nullopt) const;

  // The angle between what is seen and the match's template, rad clockwise, below the step between
  // samples. What is seen may be sampled anew, up to half a step turned.
  double angle_of(const RingSignature& seen, const RingMatch& match) const;

 private:
  static constexpr std::size_t kNeighbours = 5;
  struct Place {  // a template at its best turn
    std::uint32_t distance = UINT32_MAX;
    int index = -1;
    int shift = 0;
    bool mirrored = false;
  };
  using Nearest = std::array<Place, kNeighbours>;  // by distance
  // Shifts first, first + 1, ... first + count - 1.
  struct Shifts {
    int first = 0;
    int count = 0;
  };
  // What is seen or its mirror image, and how far it may be turned against upright templates.
  struct Look {
    TurnedSignature twice;
    std::uint32_t change;  // with one step
    Shifts upright;
    bool mirrored;
  };
  TurnedSignature turned(const RingSignature& seen) const;
  std::uint32_t change_with_one_step(const TurnedSignature& seen, const RingSignature& same) const;
  Shifts all_shifts() const { return {0, set_.layout.samples}; }
  Shifts shifts_around(double angle) const;
  Look look_at(const RingSignature& seen, bool mirrored,
               const std::optional<double>& straight) const;
  // Improves `best` by the template's turns in this look; exact where it is below `bound`.
  void search(const Look& look, int index, std::uint32_t bound, Place* best) const;
  RingMatch match_of(const Nearest& nearest) const;

  TemplateSet set_;
  RingKernels kernels_;
  std::vector<std::string> gestures_;
  std::vector<int> gesture_of_;  // of each template
};

}  // namespace armsreach::gesture
