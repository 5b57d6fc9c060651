#include "devices/usb.hpp"

#include <filesystem>
#include <unistd.h>

#include <gtest/gtest.h>

#include "devices/freenect.hpp"
#include "tests/support/program.hpp"

namespace armsreach {
namespace {

namespace fs = std::filesystem;

// A made-up /sys/bus/usb/devices and /dev/bus/usb.
class Usb : public testing::Test {
 protected:
  void plug_in(const std::string& name, const std::string& vendor, const std::string& product,
               const std::string& bus, const std::string& number) {
    fs::create_directories(listing() / name);
    test::write_text(listing() / name / "idVendor", vendor + "\n");
    test::write_text(listing() / name / "idProduct", product + "\n");
    test::write_text(listing() / name / "busnum", bus + "\n");
    test::write_text(listing() / name / "devnum", number + "\n");
  }
  void take(const std::string& name, const std::string& driver) {
    fs::create_directories(listing() / (name + ":1.0"));
    fs::create_symlink("../../drivers/" + driver, listing() / (name + ":1.0") / "driver");
  }
  void make_node(const std::string& place) {
    fs::create_directories((nodes() / place).parent_path());
    test::write_text(nodes() / place, "");
  }
  fs::path listing() const { return folder_ / "sys"; }
  fs::path nodes() const { return folder_ / "dev"; }

  test::TemporaryFolder folder_;
};

TEST_F(Usb, DevicesAreListedInOrder) {
  EXPECT_TRUE(usb_devices(listing(), nodes()).empty());
  plug_in("1-4", "045e", "02ae", "1", "12");
  plug_in("1-1", "1d27", "0609", "1", "3");
  take("1-4", "gspca_kinect");
  fs::create_directories(listing() / "usb1");  // without numbers: passed over
  const auto devices = usb_devices(listing(), nodes());
  ASSERT_EQ(devices.size(), 2U);
  EXPECT_EQ(devices[0].vendor, "1d27");
  EXPECT_EQ(devices[0].kernel_driver, "");
  EXPECT_EQ(devices[1].node, nodes() / "001/012");
  EXPECT_EQ(devices[1].kernel_driver, "gspca_kinect");
}

TEST_F(Usb, WhatKeepsAKinectFromUseIsSaidWithTheCommandThatMendsIt) {
  plug_in("1-4", "045e", "02ae", "1", "12");
  const auto line = [this] { return probe_freenect(usb_devices(listing(), nodes())).at(0); };
  EXPECT_FALSE(line().usable);
  EXPECT_NE(line().remedy.find("docker run"), std::string::npos);  // no node: a container

  make_node("001/012");
  EXPECT_TRUE(line().usable);
  EXPECT_EQ(line().spec, "freenect:0");

  take("1-4", "gspca_kinect");
  EXPECT_FALSE(line().usable);
  EXPECT_NE(line().remedy.find("rmmod gspca_kinect"), std::string::npos);

  if (geteuid() == 0) GTEST_SKIP() << "permissions do not bind the superuser";
  fs::permissions(nodes() / "001/012", fs::perms::none);
  EXPECT_NE(line().remedy.find("/etc/udev/rules.d/"), std::string::npos);
  EXPECT_NE(line().remedy.find("ATTR{idProduct}==\"02ae\""), std::string::npos);
  EXPECT_NE(line().remedy.find("usermod -aG plugdev"), std::string::npos);
}

TEST_F(Usb, AnAbsentKinectIsSaid) {
  plug_in("1-4", "046d", "0825", "1", "12");  // a webcam
  const auto lines = probe_freenect(usb_devices(listing(), nodes()));
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_FALSE(lines[0].usable);
  EXPECT_EQ(lines[0].detail.find("no Kinect is plugged in"), 0U);
  EXPECT_NE(lines[0].remedy.find("power supply"), std::string::npos);
}

TEST(Freenect, WrongSpecificationsAreRefused) {
  for (const char* wrong : {"freenect:any", "freenect:-1", "freenect:16", "freenect:0,depth=11"}) {
    const auto source = open_freenect_camera(*parse_source_spec(wrong), {});
    ASSERT_FALSE(source) << wrong;
    EXPECT_EQ(source.error().kind, Error::Kind::input);
    EXPECT_EQ(source.error().where, wrong);
  }
}

}  // namespace
}  // namespace armsreach
