#include "devices/tum_lists.hpp"

#include <sstream>

#include <gtest/gtest.h>

namespace armsreach {
namespace {

Result<std::vector<ListedFile>> list(const std::string& text) {
  std::istringstream in(text);
  return read_tum_list(in, "rgb.txt");
}

TEST(TumList, ReadsTimesAndFiles) {
  const auto files = list("# comment\r\n\r\n0.5 rgb/a.png\r\n  1341841278.8427 rgb/b.png");
  ASSERT_TRUE(files) << files.error().message();
  ASSERT_EQ(files->size(), 2U);
  EXPECT_EQ(files->front().time, 500'000'000);
  EXPECT_EQ(files->front().file, "rgb/a.png");
  EXPECT_EQ(files->back().line, "rgb.txt:4");
  // A double holds a time of day in 1970's seconds to a quarter of a microsecond.
  EXPECT_NEAR(static_cast<double>(files->back().time - 1341841278'842700000), 0, 250);
}

TEST(TumList, NamesTheLineThatIsWrong) {
  for (const char* line : {"1", "x rgb/b.png", "nan rgb/b.png", "inf rgb/b.png", "1e300 rgb/b.png",
                           "0.4 rgb/b.png", "0.5 rgb/b.png", "1 rgb/b.png more"}) {
    const auto files = list("#\n0.5 rgb/a.png\n" + std::string(line) + "\n2 rgb/c.png\n");
    ASSERT_FALSE(files) << line;
    EXPECT_EQ(files.error().where, "rgb.txt:3");
    EXPECT_FALSE(files.error().remedy.empty());
  }
  EXPECT_EQ(list("# only a comment\n").error().message().find("rgb.txt: the list is empty"), 0U);
  EXPECT_FALSE(list(""));
}

TEST(TumAssociations, NamesTheLineThatIsWrong) {
  const std::string first = "0.1 rgb/a.png 0.2 depth/a.png\n";
  std::istringstream good(first + "0.1 rgb/a.png 0.3 depth/b.png\n");
  const auto frames = read_tum_associations(good, "associations.txt");
  ASSERT_TRUE(frames) << frames.error().message();
  EXPECT_EQ(frames->back().time(), 300'000'000);
  for (const char* line : {"0.2 rgb/b.png", "0.2 rgb/b.png 0.3", "0.2 rgb/b.png nan depth/b.png",
                           "0.2 rgb/b.png 0.2 depth/b.png", "0.0 rgb/b.png 0.3 depth/b.png"}) {
    std::istringstream in(first + line);
    const auto wrong = read_tum_associations(in, "associations.txt");
    ASSERT_FALSE(wrong) << line;
    EXPECT_EQ(wrong.error().where, "associations.txt:2");
  }
}

TEST(TumAssociate, PairsMutualNearestWithinTwentyMilliseconds) {
  const auto color = list("0.000 c0\n0.034 c1\n0.100 c2\n0.300 c3\n");
  const auto depth = list("0.001 d0\n0.022 d1\n0.033 d2\n0.120 d3\n0.321 d4\n");
  const auto frames = associate(*color, *depth);
  // d1's nearest is c1, whose nearest is d2; d3 is exactly 20 ms from c2, d4 21 ms from c3.
  std::string pairs;
  for (const ListedFrame& frame : frames) pairs += frame.color.file + frame.depth.file + " ";
  EXPECT_EQ(pairs, "c0d0 c1d2 c2d3 ");
}

}  // namespace
}  // namespace armsreach
