#include "app/evaluation/time_plot.hpp"

#include <sstream>

#include <gtest/gtest.h>

namespace armsreach::app {
namespace {

std::string svg(const TimePlot& plot) {
  std::ostringstream out;
  write_svg(out, plot);
  return out.str();
}

TEST(TimePlot, DrawsEachCurveWithItsLabelAndNothingThatIsNoNumber) {
  const std::string text =
      svg({"a < b", {0, 1, 2}, {{"deg", {{"pan", {0, 5, -5}}, {"tilt", {1, 1, 1}}}}}});
  EXPECT_NE(text.find("a &lt; b"), std::string::npos);
  EXPECT_NE(text.find(">pan<"), std::string::npos);
  EXPECT_NE(text.find(">tilt<"), std::string::npos);
  EXPECT_EQ(text.find("nan"), std::string::npos);
  EXPECT_EQ(text.find("inf"), std::string::npos);
}

TEST(TimePlot, NothingAndConstantsAreDrawable) {
  for (const TimePlot& plot :
       {TimePlot{"", {}, {{"deg", {{"pan", {}}}}}}, TimePlot{"", {3}, {{"deg", {{"pan", {0}}}}}}}) {
    const std::string text = svg(plot);
    EXPECT_NE(text.find("</svg>"), std::string::npos);
    EXPECT_EQ(text.find("nan"), std::string::npos);
    EXPECT_EQ(text.find("inf"), std::string::npos);
  }
}

}  // namespace
}  // namespace armsreach::app
