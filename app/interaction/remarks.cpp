#include "app/interaction/remarks.hpp"

#include <sstream>
#include <string>

namespace armsreach::app {
namespace {

constexpr Timestamp kGestureLasts = 600'000'000;  // ns: shorter ones are passed on the way

// What can be said of a message that was written to be read: its first part, without paths.
std::string spoken(const std::string& text) {
  std::istringstream words(text);
  std::string out;
  for (std::string word; words >> word;) {
    if (word.find('/') != std::string::npos) continue;
    const bool last = word.back() == ':' || word.back() == ';' || word.back() == ',';
    if (last) word.pop_back();
    out += (out.empty() ? "" : " ") + word;
    if (last) break;
  }
  return out;
}

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
  std::optional<Sentence> operator()(const AcceptEvent& e) const {
    return Sentence{object(e.anchor), "Accepted."};
  }
  std::optional<Sentence> operator()(const RejectEvent& e) const {
    return Sentence{object(e.anchor), "Rejected."};
  }
  std::optional<Sentence> operator()(const GestureEvent& e) const {
    Sentence sentence{"hand " + std::to_string(e.hand), e.name.empty() ? "" : e.name + "."};
    sentence.lasting = kGestureLasts;
    return sentence;
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
    const std::string component = spoken(e.component);
    const std::string message = spoken(e.message);
    if (message.empty()) return std::nullopt;
    return Sentence{"fault of " + e.component,
                    component.empty() ? message : component + ": " + message, Urgency::warning};
  }
  template <class Silent>
  std::optional<Sentence> operator()(const Silent&) const {
    return std::nullopt;
  }

  static std::string object(std::int64_t id) { return "object " + std::to_string(id); }
};

}  // namespace

std::optional<Sentence> remark_on(const Event& event) {
  // What was assumed before the first frame is shown; whoever looks on has not lost anything yet.
  if (event.time == 0 && std::holds_alternative<FaultEvent>(event.body)) return std::nullopt;
  std::optional<Sentence> sentence = std::visit(BodyToSentence{}, event.body);
  if (sentence) sentence->time = event.time;
  return sentence;
}

}  // namespace armsreach::app
