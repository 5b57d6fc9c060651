#include "devices/openni.hpp"

#include <string_view>
#include <utility>

namespace armsreach {
namespace {

Result<bool> registration_option(const SourceSpec& spec) {
  const std::string text = option(spec, "registration").value_or("on");
  if (text == "on" || text == "off") return text == "on";
  return Error{"option 'registration' is '" + text + "'", text_of(spec),
               "give registration=on or registration=off"};
}

}  // namespace

bool is_oni_file(const std::string& place) { return std::string_view(place).ends_with(".oni"); }

Result<std::unique_ptr<Source>> open_openni(const SourceSpec& spec, const OpenOptions& options) {
  const auto registration = registration_option(spec);
  if (!registration) return registration.error();
  if (is_oni_file(spec.place)) {
    auto loop = loop_option(spec);
    if (!loop) return std::move(loop).error();
    auto recording = open_oni_recording(
        spec.place, options,
        option(spec, "registration") ? registration.value() : std::optional<bool>());
    if (!recording) return std::move(recording).error();
    return play(std::move(*recording), *loop);
  }
  if (option(spec, "loop")) {
    return Error{"option 'loop' is for recordings", text_of(spec),
                 "leave it out, or give openni:FILE.oni"};
  }
  return open_openni_camera(spec, options, *registration);
}

}  // namespace armsreach
