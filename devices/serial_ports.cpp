#include "devices/serial_ports.hpp"

#include <libserialport.h>
#include <string>
#include <unistd.h>

namespace armsreach {
namespace {

Availability availability_of(const sp_port* port) {
  const std::string path = sp_get_port_name(port);
  const char* description = sp_get_port_description(port);
  Availability one{path, true, description ? description : "serial port", ""};
  one.detail += "; for `port` of an actuator in a rig file";
  if (access(path.c_str(), R_OK | W_OK) == 0) return one;
  one.usable = false;
  one.detail += ": no permission";
  one.remedy = "sudo usermod -aG dialout $USER, then log in again";
  return one;
}

}  // namespace

std::vector<Availability> probe_serial_ports() {
  std::vector<Availability> found;
  sp_port** ports = nullptr;
  if (sp_list_ports(&ports) == SP_OK) {
    for (sp_port** port = ports; *port; ++port) {
      // What is soldered to the mainboard carries no board of ours.
      if (sp_get_port_transport(*port) == SP_TRANSPORT_NATIVE) continue;
      found.push_back(availability_of(*port));
    }
    sp_free_port_list(ports);
  }
  if (found.empty()) {
    found.push_back({"/dev/ttyACM0", false, "no board with servos on a serial port",
                     "plug in an Arduino with StandardFirmata; assets/rigs/wearable-servos.yaml "
                     "shows its rig file"});
  }
  return found;
}

}  // namespace armsreach
