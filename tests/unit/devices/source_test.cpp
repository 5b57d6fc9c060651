#include "devices/source.hpp"

#include <gtest/gtest.h>

#include "devices/open.hpp"

namespace armsreach {
namespace {

TEST(SourceSpec, IsTakenApart) {
  const auto spec = parse_source_spec("images:a folder/with:colon,rate=15,loop=pingpong");
  ASSERT_TRUE(spec) << spec.error().message();
  EXPECT_EQ(spec->kind, "images");
  EXPECT_EQ(spec->place, "a folder/with:colon");
  EXPECT_EQ(option(*spec, "rate"), "15");
  EXPECT_EQ(option(*spec, "loop"), "pingpong");
  EXPECT_EQ(option(*spec, "seed"), std::nullopt);
  EXPECT_EQ(text_of(*spec), "images:a folder/with:colon,rate=15,loop=pingpong");
}

TEST(SourceSpec, RefusesWhatIsNotOne) {
  for (const char* text : {"", "bench", ":bench", "tum:", "tum:,loop=once", "tum:dir,loop",
                           "tum:dir,=once", "tum:dir,loop=once,loop=pingpong"}) {
    const auto spec = parse_source_spec(text);
    ASSERT_FALSE(spec) << text;
    EXPECT_EQ(spec.error().where, text);
    EXPECT_FALSE(spec.error().remedy.empty());
  }
}

TEST(SourceSpec, NumbersAreReadWithinBounds) {
  const auto rate = [](const std::string& text) {
    return number_option(*parse_source_spec("images:dir" + text), "rate", 30, 0.1, 1000);
  };
  EXPECT_EQ(*rate(""), 30);
  EXPECT_EQ(*rate(",rate=12.5"), 12.5);
  for (const char* wrong : {",rate=", ",rate=fast", ",rate=0", ",rate=-1", ",rate=nan", ",rate=inf",
                            ",rate=12x", ",rate=1001"}) {
    ASSERT_FALSE(rate(wrong)) << wrong;
    EXPECT_NE(rate(wrong).error().message().find("'rate'"), std::string::npos);
  }
}

std::string refusal(const std::string& spec) {
  const auto source = open_source(*parse_source_spec(spec), {});
  return source ? "" : source.error().message();
}

TEST(OpenSource, RefusesUnknownKindsAndOptionsByName) {
  EXPECT_NE(refusal("tun:dir").find("'tun'"), std::string::npos);
  EXPECT_NE(refusal("tun:dir").find("tum"), std::string::npos);
  EXPECT_NE(refusal("tum:dir,lop=once").find("'lop'"), std::string::npos);
  EXPECT_NE(refusal("tum:dir,lop=once").find("knows the options loop"), std::string::npos);
}

TEST(OpenSource, TakesKindsFromElsewhere) {
  SourceKind made_up;
  made_up.name = "made-up";
  made_up.option_keys = {"seed"};
  made_up.open = [](const SourceSpec& spec, const OpenOptions&) -> Result<std::unique_ptr<Source>> {
    return Error{"opened", spec.place, *option(spec, "seed")};
  };
  const auto source = open_source(*parse_source_spec("made-up:place,seed=3"), {}, {made_up});
  EXPECT_EQ(source.error().message(), "place: opened (3)");
}

}  // namespace
}  // namespace armsreach
