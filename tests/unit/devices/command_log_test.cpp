#include "devices/command_log.hpp"

#include <gtest/gtest.h>

namespace armsreach {
namespace {

TEST(CommandLog, GivesEachCommandOnceInOrder) {
  CommandLog log;
  log.add({1, {0.1, 0, 0}});
  log.add({2, {0.2, 0, 0}});
  const std::vector<GimbalCommand> taken = log.take();
  ASSERT_EQ(taken.size(), 2U);
  EXPECT_EQ(taken[0].time, 1);
  EXPECT_EQ(taken[1].angles.x(), 0.2);
  EXPECT_TRUE(log.take().empty());
}

TEST(CommandLog, ForgetsTheOldestWhereNobodyRecords) {
  CommandLog log;
  const auto told = static_cast<Timestamp>(3 * CommandLog::kMost);
  for (Timestamp time = 1; time <= told; ++time) log.add({time, {0, 0, 0}});
  const std::vector<GimbalCommand> taken = log.take();
  ASSERT_EQ(taken.size(), CommandLog::kMost);
  EXPECT_EQ(taken.back().time, told);
}

}  // namespace
}  // namespace armsreach
