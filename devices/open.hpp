// Opening sources by their specification, and saying which can be opened here.
//
// Kinds are values in a list: the program joins those of real devices with the simulated ones, so
// that this library does not know its twins.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "devices/source.hpp"
#include "vision/core/camera_yaml.hpp"
#include "vision/core/result.hpp"

namespace armsreach {

struct OpenOptions {
  std::string sensor = "main";       // name of the sensor in its rig
  std::optional<CameraFile> camera;  // takes the place of the recording's own or of a guess
};

// One line of `armsreach sources`.
struct Availability {
  std::string spec;    // what to give to --source: "camera:0", "tum:DIR"
  bool usable = true;  // here and now
  std::string detail;  // what it is; why not, when it is not usable
  std::string remedy;  // the command that mends that
};

struct SourceKind {
  std::string name;                      // "tum"
  std::string usage;                     // "tum:DIR[,loop=pingpong]"
  std::vector<std::string> option_keys;  // others are refused by name before `open` is called
  // Whether a place is a file's or folder's, relative to a rig file's folder; unset: never.
  std::function<bool(const std::string& place)> place_is_path;
  std::function<Result<std::unique_ptr<Source>>(const SourceSpec&, const OpenOptions&)> open;
  std::function<std::vector<Availability>()> probe;  // at least one line
};

// tum, images, video, camera, openni, freenect.
std::vector<SourceKind> real_source_kinds();

Result<std::unique_ptr<Source>> open_source(
    const SourceSpec& spec, const OpenOptions& options,
    const std::vector<SourceKind>& kinds = real_source_kinds());

}  // namespace armsreach
