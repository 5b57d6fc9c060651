// The serial ports that boards with servos or motors may hang on, for the list of sources.
#pragma once

#include <vector>

#include "devices/open.hpp"

namespace armsreach {

// One line a port, named as it stands in a rig file, or one that says that there is none.
std::vector<Availability> probe_serial_ports();

}  // namespace armsreach
