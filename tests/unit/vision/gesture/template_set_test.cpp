#include "vision/gesture/template_set.hpp"

#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace armsreach::gesture {
namespace {

using ::testing::HasSubstr;

TemplateSet two_templates(const RingLayout& layout) {
  TemplateSet set{layout, {{"L", {}, true}, {"L", {}, false}}};
  set.templates[0].signature.set(0, 0);
  set.templates[1].signature.set(layout.rings() - 1, layout.samples - 1);
  return set;
}

std::string text_of(const TemplateSet& set) {
  std::ostringstream out;
  write_templates(out, "L", set);
  return out.str();
}

Status read(const std::string& text, TemplateSet* set) {
  std::istringstream in(text);
  return read_templates(in, "L", "file", set);
}

TEST(TemplateSet, WhatIsWrittenIsReadAgain) {
  for (const RingLayout& layout : {doubling_rings(), linear_rings()}) {
    const TemplateSet set = two_templates(layout);
    TemplateSet copy;
    ASSERT_TRUE(read(text_of(set), &copy));
    EXPECT_EQ(copy.layout, layout);
    ASSERT_EQ(copy.templates.size(), 2U);
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_EQ(copy.templates[i].signature, set.templates[i].signature);
      EXPECT_EQ(copy.templates[i].upright, set.templates[i].upright);
    }
  }
}

TEST(TemplateSet, AnotherLayoutIsRefused) {
  TemplateSet set = two_templates(linear_rings());
  const Status status = read(text_of(two_templates(doubling_rings())), &set);
  ASSERT_FALSE(status);
  EXPECT_THAT(status.error().what, HasSubstr("another layout: 5 rings of 180 samples"));
}

TEST(TemplateSet, DamageIsRefusedWhereverItIs) {
  const std::string text = text_of(two_templates(linear_rings()));
  // Cut anywhere but at a line's end, where fewer templates remain.
  for (std::size_t length = 0; length < text.size(); length += 13) {
    if (length > 0 && (text[length - 1] == '\n' || text[length] == '\n')) continue;
    TemplateSet set;
    const bool accepted = read(text.substr(0, length), &set).ok();
    // Cutting within the last number of the last line may leave a number.
    EXPECT_TRUE(!accepted || set.templates.size() == 2) << length;
  }
  for (const char* wrong : {"samples 91", "samples -90", "samples 900000", "samples x"}) {
    TemplateSet set;
    EXPECT_FALSE(read(std::string("armsreach-rings 1\n") + wrong + "\nradii 1\nweights 1\n", &set))
        << wrong;
  }
}

}  // namespace
}  // namespace armsreach::gesture
