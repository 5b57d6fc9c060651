// `freenect:N`: the N-th Kinect v1 on this machine's USB, through libfreenect.
//
// depth=registered (the default) takes the driver's depth in the colour camera's pixels;
// depth=unregistered its depth in the infra-red camera's own, with that Kinect's factory geometry;
// depth=raw the 11-bit numbers, with the usual geometry: what recorded sessions of fakenect hold.
#pragma once

#include <memory>
#include <vector>

#include "devices/open.hpp"
#include "devices/source.hpp"
#include "devices/usb.hpp"
#include "vision/core/result.hpp"

namespace armsreach {

Result<std::unique_ptr<Source>> open_freenect_camera(const SourceSpec& spec,
                                                     const OpenOptions& options);

// One line a Kinect among `devices`, or one that says why there is none.
std::vector<Availability> probe_freenect(const std::vector<UsbDevice>& devices = usb_devices());

}  // namespace armsreach
