// OpenNI2: `openni:any` (or openni:URI) is a live sensor, `openni:FILE.oni` a recording.
//
// Live, the driver registers depth to colour where it can; registration=off leaves both as they
// are. A recording does not say whether it was registered: it counts as such, and is watched,
// unless registration=on or off says so.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "devices/open.hpp"
#include "devices/recording.hpp"
#include "devices/source.hpp"
#include "devices/usb.hpp"
#include "vision/core/result.hpp"

namespace armsreach {

bool is_oni_file(const std::string& place);

Result<std::unique_ptr<Source>> open_openni(const SourceSpec& spec, const OpenOptions& options);

// One line a sensor that OpenNI2 sees or that is among `devices` and cannot be used, or one that
// says why there is none; and one for recordings.
std::vector<Availability> probe_openni(const std::vector<UsbDevice>& devices = usb_devices());

// The two kinds of place.
Result<std::unique_ptr<Source>> open_openni_camera(const SourceSpec& spec,
                                                   const OpenOptions& options, bool registration);
Result<std::unique_ptr<Recording>> open_oni_recording(const std::string& file,
                                                      const OpenOptions& options,
                                                      std::optional<bool> registration);

}  // namespace armsreach
