// USB devices as the kernel lists them, and what keeps a program from using one.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace armsreach {

struct UsbDevice {
  std::string vendor;          // four hexadecimal digits: "045e"
  std::string product;         // "02ae"
  std::string name;            // what it calls itself; may be empty
  std::filesystem::path node;  // /dev/bus/usb/001/007
  std::string kernel_driver;   // that has taken its first interface; empty: none
};

// In order of bus and number. Nothing where there is no USB.
std::vector<UsbDevice> usb_devices(const std::filesystem::path& listing = "/sys/bus/usb/devices",
                                   const std::filesystem::path& nodes = "/dev/bus/usb");

struct UsbObstacle {
  std::string what;
  std::string remedy;  // the command that mends it
};

// Nothing when the device can be opened. `group` is given access by the suggested udev rule.
std::optional<UsbObstacle> usb_obstacle(const UsbDevice& device, const std::string& group);

// What to say where no such device is listed: a container may have no USB at all.
UsbObstacle usb_absence(const std::string& what, const std::string& remedy,
                        const std::filesystem::path& nodes = "/dev/bus/usb");

}  // namespace armsreach
