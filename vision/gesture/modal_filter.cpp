#include "vision/gesture/modal_filter.hpp"

#include <map>

namespace armsreach::gesture {

const ModalFilter::Mode& ModalFilter::update(const std::string& name, double score,
                                             Timestamp time) {
  seen_.push_back({time, name, score});
  while (seconds_from_timestamp(time - seen_.front().time) > window_) seen_.pop_front();

  struct Votes {
    int count = 0;
    double score = 0;
  };
  std::map<std::string, Votes> votes;
  for (const Seen& seen : seen_) {
    Votes& of = votes[seen.name];
    ++of.count;
    of.score += seen.score;
  }
  std::string winner = votes.count(mode_.name) ? mode_.name : name;
  for (auto seen = seen_.rbegin(); seen != seen_.rend(); ++seen) {
    if (votes[seen->name].count > votes[winner].count) winner = seen->name;
  }
  const Votes& won = votes[winner];
  mode_ = {winner, won.score / won.count, won.count / static_cast<double>(seen_.size())};
  return mode_;
}

}  // namespace armsreach::gesture
