// armsreach record: writes what a source delivers as a recording that plays back as the same rig.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "app/cli/commands.hpp"
#include "app/cli/rig_options.hpp"
#include "app/runtime/interrupt.hpp"
#include "app/runtime/output_file.hpp"
#include "app/runtime/progress.hpp"
#include "devices/rig_yaml.hpp"
#include "devices/tum_writer.hpp"

namespace armsreach::app {
namespace {

namespace fs = std::filesystem;

// A source with a few broken frames is recorded around them.
constexpr int kMostBrokenInARow = 30;

struct RecordOptions {
  RigOptions rig;
  std::string out;
  std::optional<std::int64_t> frames;
};

// Never into a folder that holds anything: it may be another recording.
Status check_folder(const fs::path& folder) {
  if (folder.empty()) return Error{"no folder was given", "--out", "give a new folder"};
  std::error_code failure;
  if (!fs::exists(folder, failure)) return ok();
  if (!fs::is_directory(folder, failure) || !fs::is_empty(folder, failure) || failure) {
    return Error{"is there already and is not an empty folder", folder.string(),
                 "give a new folder with --out"};
  }
  return ok();
}

Status check_name(const std::string& name) {
  const auto taken = {"rgb", "depth", "masks", "true_depth"};
  const bool plain = !name.empty() && name.find_first_of("/\\,= ") == std::string::npos &&
                     name[0] != '.' && std::find(taken.begin(), taken.end(), name) == taken.end();
  if (plain) return ok();
  return Error{"a sensor named '" + name + "' cannot have a folder of that name", "--source",
               "give it another name: --source NAME=SPEC"};
}

// The rig as it will be played: the main sensor lies in the folder itself, others in folders of
// their names beside its images.
Result<RigSpec> recorded_rig(const Rig& rig) {
  RigSpec spec;
  const std::size_t first = main_sensor(rig);
  for (std::size_t i = 0; i < rig.sensors().size(); ++i) {
    const RigSensor& sensor = rig.sensors()[i];
    RigSensorSpec one;
    one.name = sensor.name();
    one.source.kind = "tum";
    one.source.place = i == first ? "." : one.name;
    if (i != first) {
      if (auto status = check_name(one.name); !status) return status.error();
    }
    one.rig_from_sensor = sensor.rig_from_sensor;
    if (const auto gimbal = rig.gimbal_of(one.name)) {
      one.gimbal = gimbal->model();
      one.gimbal_states = i == first ? "gimbal.txt" : one.name + "/gimbal.txt";
    }
    spec.sensors.push_back(std::move(one));
  }
  return spec;
}

class RigWriter {
 public:
  explicit RigWriter(fs::path folder) : folder_(std::move(folder)) {}

  Status begin(const Rig& rig) {
    auto spec = recorded_rig(rig);
    if (!spec) return spec.error();
    for (std::size_t i = 0; i < spec->sensors.size(); ++i) {
      const RigSensorSpec& sensor = spec->sensors[i];
      writers_.push_back(
          {sensor.name, TumWriter(folder_ / sensor.source.place), rig.gimbal_of(sensor.name)});
      const auto status = writers_.back().frames.begin(*rig.sensors()[i].source->sensor());
      if (!status) return status;
    }
    return write_file((folder_ / "rig.yaml").string(),
                      [&](std::ostream& out) { write_rig_yaml(out, *spec); });
  }

  Status write(const Frame& frame) {
    const auto writer = std::find_if(writers_.begin(), writers_.end(), [&](const Writer& one) {
      return one.sensor == frame.sensor->name;
    });
    if (auto status = writer->frames.write(frame); !status || !writer->gimbal) return status;
    return writer->frames.write_gimbal(*writer->gimbal, frame.time);
  }

 private:
  struct Writer {
    std::string sensor;
    TumWriter frames;
    std::shared_ptr<Gimbal> gimbal;
  };
  fs::path folder_;
  std::vector<Writer> writers_;
};

std::string progress_line(std::int64_t frames, const std::optional<std::int64_t>& of) {
  std::string line = "recorded " + std::to_string(frames);
  if (of) line += " of " + std::to_string(*of);
  return line + " frames";
}

void print_events(Rig& rig) {
  for (const Event& event : rig.take_events()) {
    if (const auto* fault = std::get_if<FaultEvent>(&event.body)) {
      std::fprintf(stderr, "%s: %s (%s)\n", fault->component.c_str(), fault->message.c_str(),
                   fault->remedy.c_str());
    }
  }
}

// The number of frames written; an error of the source or of the disk.
Result<std::int64_t> write_frames(Rig& rig, RigWriter& writer,
                                  const std::optional<std::int64_t>& most) {
  Progress progress;
  const auto promised = most ? most : rig.sensors().front().source->frame_count();
  std::int64_t written = 0;
  int broken_in_a_row = 0;
  while (!most || written < *most) {
    auto frame = rig.next();
    print_events(rig);
    if (!frame) {
      if (frame.error().kind == Error::Kind::device || ++broken_in_a_row >= kMostBrokenInARow)
        return frame.error();
      std::fprintf(stderr, "left out: %s\n", frame.error().message().c_str());
      continue;
    }
    if (!*frame) break;
    broken_in_a_row = 0;
    if (auto status = writer.write(**frame); !status) return status.error();
    ++written;
    if (progress.due()) progress.show(progress_line(written, promised));
  }
  return written;
}

Status record(const RecordOptions& options) {
  if (auto status = check_folder(options.out); !status) return status;
  auto rig = open_rig(options.rig);
  if (!rig) return rig.error();
  const InterruptGuard guard([&] { (*rig)->stop(); });
  RigWriter writer(options.out);
  if (auto status = writer.begin(**rig); !status) return status;
  auto written = write_frames(**rig, writer, options.frames);
  if (!written) return written.error();
  if (*written == 0) {
    return Error{"no frame came", options.out, "check the source with `armsreach run`",
                 Error::Kind::device};
  }
  std::printf("%lld frames in %s; play them with --rig %s\n", static_cast<long long>(*written),
              options.out.c_str(), (fs::path(options.out) / "rig.yaml").c_str());
  return ok();
}

}  // namespace

void add_record_command(CLI::App& app, Task* task) {
  CLI::App* command = app.add_subcommand("record", "write what a source delivers to a folder");
  auto o = std::make_shared<RecordOptions>();
  auto* source = command->add_option("--source", o->rig.sources,
                                     "what to record: SPEC or NAME=SPEC, see `armsreach sources`");
  command->add_option("--rig", o->rig.rig, "YAML file of named sensors")->excludes(source);
  command->add_option("--camera", o->rig.camera, "camera YAML in place of the source's own");
  command->add_option("--out", o->out, "new folder for the recording")->required();
  command->add_option("--frames", o->frames, "stop after so many")->check(at_least_one, "COUNT");
  command->add_option("--seed", o->rig.seed, "of everything random")->capture_default_str();
  command->callback([task, o] { *task = [o] { return record(*o); }; });
}

}  // namespace armsreach::app
