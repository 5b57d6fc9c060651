#include "devices/usb.hpp"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <fstream>
#include <system_error>
#include <unistd.h>

#include "devices/files.hpp"

namespace armsreach {
namespace {

namespace fs = std::filesystem;

std::string first_line(const fs::path& file) {
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  return line;
}

std::optional<int> number_in(const fs::path& file) {
  const std::string text = first_line(file);
  int number = 0;
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (failure != std::errc() || number < 0) return std::nullopt;
  return number;
}

// "1-2" has its first interface in "1-2:1.0", whose `driver` links to the module's folder.
std::string driver_of(const fs::path& listing, const std::string& device) {
  std::error_code failure;
  const fs::path link = listing / (device + ":1.0") / "driver";
  const fs::path target = fs::read_symlink(link, failure);
  return failure ? "" : target.filename().string();
}

std::optional<UsbDevice> device_at(const fs::path& listing, const fs::path& entry,
                                   const fs::path& nodes) {
  UsbDevice device;
  device.vendor = first_line(entry / "idVendor");
  device.product = first_line(entry / "idProduct");
  const auto bus = number_in(entry / "busnum");
  const auto number = number_in(entry / "devnum");
  if (device.vendor.empty() || device.product.empty() || !bus || !number) return std::nullopt;
  device.name = first_line(entry / "product");
  char place[32];
  std::snprintf(place, sizeof place, "%03d/%03d", *bus, *number);
  device.node = nodes / place;
  device.kernel_driver = driver_of(listing, entry.filename().string());
  return device;
}

std::string udev_command(const UsbDevice& device, const std::string& group) {
  return "echo 'SUBSYSTEM==\"usb\", ATTR{idVendor}==\"" + device.vendor +
         "\", ATTR{idProduct}==\"" + device.product + "\", MODE=\"0660\", GROUP=\"" + group +
         "\"' | sudo tee /etc/udev/rules.d/60-armsreach-" + device.vendor + "-" + device.product +
         ".rules && sudo udevadm control --reload && sudo udevadm trigger && sudo usermod -aG " +
         group + " $USER, then log in again";
}

}  // namespace

std::vector<UsbDevice> usb_devices(const fs::path& listing, const fs::path& nodes) {
  std::vector<UsbDevice> devices;
  std::error_code failure;
  for (fs::directory_iterator entry(listing, failure), end; !failure && entry != end;
       entry.increment(failure)) {
    if (auto device = device_at(listing, entry->path(), nodes)) devices.push_back(*device);
  }
  std::sort(devices.begin(), devices.end(),
            [](const UsbDevice& a, const UsbDevice& b) { return a.node < b.node; });
  return devices;
}

std::optional<UsbObstacle> usb_obstacle(const UsbDevice& device, const std::string& group) {
  if (!file_exists(device.node)) {
    return UsbObstacle{"it is plugged in, but " + device.node.string() + " is absent",
                       "a container needs it passed in: docker run -v /dev/bus/usb:/dev/bus/usb "
                       "--device-cgroup-rule 'c 189:* rmw'"};
  }
  if (access(device.node.c_str(), R_OK | W_OK) != 0) {
    return UsbObstacle{"no permission to use " + device.node.string(), udev_command(device, group)};
  }
  if (device.kernel_driver == "gspca_kinect") {
    return UsbObstacle{"the kernel module gspca_kinect has taken it",
                       "sudo rmmod gspca_kinect; for good: echo blacklist gspca_kinect | sudo tee "
                       "/etc/modprobe.d/gspca_kinect.conf"};
  }
  return std::nullopt;
}

UsbObstacle usb_absence(const std::string& what, const std::string& remedy, const fs::path& nodes) {
  if (folder_exists(nodes)) return {what, remedy};
  return {what + ", and no USB here: " + nodes.string() + " is absent",
          remedy +
              "; a container needs it passed in: docker run -v /dev/bus/usb:/dev/bus/usb "
              "--device-cgroup-rule 'c 189:* rmw'"};
}

}  // namespace armsreach
