// A rig file with one thing wrong, and what is said of it.
#pragma once

#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "devices/rig_yaml.hpp"

namespace armsreach::test {

inline Result<RigSpec> read_rig(const std::string& text) {
  std::istringstream in(text);
  return read_rig_yaml(in, "rig.yaml");
}

struct BrokenRig {
  std::string from, to;  // replaced in the sound file
  std::string where, what;
};

inline void expect_complaints(const std::string& sound, const std::vector<BrokenRig>& all) {
  for (const BrokenRig& broken : all) {
    std::string text = sound;
    text.replace(text.find(broken.from), broken.from.size(), broken.to);
    const auto rig = read_rig(text);
    ASSERT_FALSE(rig) << text;
    EXPECT_EQ(rig.error().where, broken.where) << rig.error().message();
    EXPECT_NE(rig.error().what.find(broken.what), std::string::npos) << rig.error().message();
    EXPECT_FALSE(rig.error().remedy.empty());
  }
}

}  // namespace armsreach::test
