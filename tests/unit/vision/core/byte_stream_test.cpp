#include "vision/core/byte_stream.hpp"

#include <cstdint>
#include <sstream>
#include <string>

#include <Eigen/Core>
#include <gtest/gtest.h>

namespace armsreach {
namespace {

// The bytes of a file, written out by hand: files of earlier programs are read for ever.
const std::string kBytes("\x02\x01\xff\x00\x00\xc0\x3f\x07\x08", 9);

TEST(ByteStream, WritesTheLowestByteFirst) {
  std::ostringstream out;
  write_value(out, std::uint16_t{0x0102});
  write_value(out, std::int8_t{-1});
  write_value(out, 1.5F);
  write_values(out, std::array<std::uint8_t, 2>{7, 8});
  EXPECT_EQ(out.str(), kBytes);
}

TEST(ByteStream, ReadsWhatIsWritten) {
  std::istringstream in(kBytes);
  ValueReader reader(in);
  EXPECT_EQ(reader.get<std::uint16_t>(), 0x0102);
  EXPECT_EQ(reader.get<std::int8_t>(), -1);
  EXPECT_EQ(reader.get<float>(), 1.5F);
  using Pair = std::array<std::uint8_t, 2>;
  EXPECT_EQ(reader.get<Pair>(), (Pair{7, 8}));
  EXPECT_TRUE(reader.ok());
}

TEST(ByteStream, GivesZerosFromWhereTheStreamEnds) {
  std::istringstream in(kBytes.substr(0, 5));
  ValueReader reader(in);
  EXPECT_EQ(reader.get<std::uint32_t>(), 0x00ff0102U);
  EXPECT_TRUE(reader.ok());
  EXPECT_EQ(reader.get_values<Eigen::Vector3d>(), Eigen::Vector3d::Zero());
  EXPECT_FALSE(reader.ok());
  EXPECT_EQ(reader.get<std::uint8_t>(), 0) << "the byte that was left is part of no number";
}

}  // namespace
}  // namespace armsreach
