#include "devices/open.hpp"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "devices/freenect.hpp"
#include "devices/image_recording.hpp"
#include "devices/openni.hpp"
#include "devices/recording.hpp"
#include "devices/tum_recording.hpp"
#include "devices/v4l2.hpp"
#include "devices/video_recording.hpp"

namespace armsreach {
namespace {

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

Result<std::unique_ptr<Source>> played(Result<std::unique_ptr<Recording>> recording,
                                       const SourceSpec& spec) {
  if (!recording) return std::move(recording).error();
  auto loop = loop_option(spec);
  if (!loop) return std::move(loop).error();
  return play(std::move(*recording), *loop);
}

// A kind of recording that is a folder or file of its own; its options besides `loop` are left to
// add.
SourceKind recording_kind(const std::string& name, const std::string& usage) {
  SourceKind kind;
  kind.name = name;
  kind.usage = usage;
  kind.option_keys = {"loop"};
  kind.place_is_path = [](const std::string&) { return true; };
  return kind;
}

SourceKind tum_kind() {
  SourceKind kind = recording_kind("tum", "tum:DIR[,loop=pingpong]");
  kind.open = [](const SourceSpec& spec, const OpenOptions& options) {
    return played(open_tum_recording(spec.place, options), spec);
  };
  kind.probe = [] {
    return std::vector<Availability>{{"tum:DIR", true, "a recording in TUM RGB-D layout", ""}};
  };
  return kind;
}

SourceKind images_kind() {
  SourceKind kind = recording_kind("images", "images:DIR[,rate=30][,loop=pingpong]");
  kind.option_keys.emplace_back("rate");
  kind.open = [](const SourceSpec& spec,
                 const OpenOptions& options) -> Result<std::unique_ptr<Source>> {
    const auto rate = number_option(spec, "rate", 30, 0.001, 1000);  // Hz
    if (!rate) return rate.error();
    return played(open_image_recording(spec.place, *rate, options), spec);
  };
  kind.probe = [] {
    return std::vector<Availability>{{"images:DIR", true, "a folder of images in name order", ""}};
  };
  return kind;
}

SourceKind video_kind() {
  SourceKind kind = recording_kind("video", "video:FILE[,loop=pingpong]");
  kind.open = [](const SourceSpec& spec, const OpenOptions& options) {
    return played(open_video_recording(spec.place, options), spec);
  };
  kind.probe = [] { return std::vector<Availability>{probe_video()}; };
  return kind;
}

SourceKind camera_kind() {
  SourceKind kind;
  kind.name = "camera";
  kind.usage = "camera:N";
  kind.open = open_v4l2_camera;
  kind.probe = [] { return probe_v4l2(); };
  return kind;
}

SourceKind openni_kind() {
  SourceKind kind;
  kind.name = "openni";
  kind.usage = "openni:any|FILE.oni[,registration=off][,loop=pingpong]";
  kind.option_keys = {"registration", "loop"};
  kind.place_is_path = is_oni_file;
  kind.open = open_openni;
  kind.probe = [] { return probe_openni(); };
  return kind;
}

SourceKind freenect_kind() {
  SourceKind kind;
  kind.name = "freenect";
  kind.usage = "freenect:N[,depth=registered|unregistered|raw]";
  kind.option_keys = {"depth"};
  kind.open = open_freenect_camera;
  kind.probe = [] { return probe_freenect(); };
  return kind;
}

Status check_option_keys(const SourceSpec& spec, const SourceKind& kind) {
  for (const auto& [key, value] : spec.options) {
    const auto& known = kind.option_keys;
    if (std::find(known.begin(), known.end(), key) != known.end()) continue;
    return Error{"unknown option '" + key + "'", text_of(spec),
                 known.empty() ? kind.name + ": takes no options"
                               : kind.name + ": knows the options " + joined(known)};
  }
  return ok();
}

}  // namespace

std::vector<SourceKind> real_source_kinds() {
  return {tum_kind(), images_kind(), video_kind(), camera_kind(), openni_kind(), freenect_kind()};
}

Result<std::unique_ptr<Source>> open_source(const SourceSpec& spec, const OpenOptions& options,
                                            const std::vector<SourceKind>& kinds) {
  std::vector<std::string> names;
  for (const SourceKind& kind : kinds) {
    names.push_back(kind.name);
    if (kind.name != spec.kind) continue;
    if (auto known = check_option_keys(spec, kind); !known) return known.error();
    return kind.open(spec, options);
  }
  return Error{"unknown kind of source '" + spec.kind + "'", text_of(spec),
               "the kinds are " + joined(names)};
}

}  // namespace armsreach
