#include "app/interaction/remarks.hpp"

#include <string>

namespace armsreach::app {
namespace {

struct BodyToSentence {
  std::optional<Sentence> operator()(const TrackingEvent& e) const {
    switch (e.state) {
      case TrackingState::initialising:
      case TrackingState::untracked:
        return std::nullopt;
      case TrackingState::tracking:
        return Sentence{"tracking", "Tracking.", Urgency::notice};
      case TrackingState::lost:
        return Sentence{"tracking", "Tracking lost.", Urgency::warning};
      case TrackingState::relocalised:
        return Sentence{"tracking", "Place known.", Urgency::notice};
    }
    return std::nullopt;
  }
  std::optional<Sentence> operator()(const InsertEvent& e) const {
    return Sentence{object(e.id), e.object + " inserted."};
  }
  std::optional<Sentence> operator()(const DeleteEvent& e) const {
    return Sentence{object(e.id), e.object + " deleted."};
  }
  std::optional<Sentence> operator()(const GestureEvent& e) const {
    return Sentence{"hand " + std::to_string(e.hand), e.name.empty() ? "" : e.name + "."};
  }
  std::optional<Sentence> operator()(const HighlightEvent& e) const {
    return Sentence{"pointed at", e.name + "."};
  }
  std::optional<Sentence> operator()(const LabelEvent& e) const {
    return Sentence{"label " + e.text, e.text + "."};
  }
  // A voice that cannot speak need not say so.
  std::optional<Sentence> operator()(const FaultEvent& e) const {
    if (e.component == "voice") return std::nullopt;
    return Sentence{"fault of " + e.component, e.component + ": " + e.message, Urgency::warning};
  }
  template <class Silent>
  std::optional<Sentence> operator()(const Silent&) const {
    return std::nullopt;
  }

  static std::string object(std::int64_t id) { return "object " + std::to_string(id); }
};

}  // namespace

std::optional<Sentence> remark_on(const Event& event) {
  std::optional<Sentence> sentence = std::visit(BodyToSentence{}, event.body);
  if (sentence) sentence->time = event.time;
  return sentence;
}

}  // namespace armsreach::app
