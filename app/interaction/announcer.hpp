// Says changes once: told what holds, again and again, it gives a sentence only when something has
// changed, and no more than one on the same subject within a few seconds. Pure: time is handed in.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "devices/speech/sentence.hpp"

namespace armsreach::app {

class Announcer {
 public:
  static constexpr Timestamp kPause = 2'000'000'000;   // ns between two sentences on one subject
  static constexpr Timestamp kRepeat = 5'000'000'000;  // ns before the same remark is made again

  // What holds now of a subject. An empty text: nothing worth saying, so that the next is a change.
  void note(const Sentence& sentence);

  // What is to be said now, the most urgent first, with the time `now`. What changed back before
  // its turn came is not said at all, nor is a remark that was made lately: somebody who points,
  // opens the hand and points again need not hear it each time.
  std::vector<Sentence> due(Timestamp now);

 private:
  struct Subject {
    Sentence newest;
    std::string said;
    Timestamp earliest;                          // for the next sentence
    std::map<std::string, Timestamp> made = {};  // remarks, and when last
  };
  std::map<std::string, Subject> subjects_;
};

}  // namespace armsreach::app
