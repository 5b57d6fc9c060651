// armsreach calibrate target: a start target to print, and the file that tells its size.
#include <cstdio>
#include <filesystem>
#include <memory>
#include <ostream>
#include <string>

#include "app/cli/commands.hpp"
#include "app/cli/target_sheet.hpp"
#include "app/runtime/output_file.hpp"

namespace armsreach::app {
namespace {

struct TargetOptions {
  std::string size = "210x148.5";  // mm; half an A4 page
  std::string out = "target.pdf";
};

Status make_target(const TargetOptions& options) {
  if (std::filesystem::path(options.out).extension() != ".pdf") {
    return Error{"is not the name of a PDF", options.out, "for example --out target.pdf"};
  }
  double width = 0;
  double height = 0;
  char end = 0;
  if (std::sscanf(options.size.c_str(), "%lfx%lf%c", &width, &height, &end) != 2) {
    return Error{"'" + options.size + "' is not WIDTHxHEIGHT in millimetres", "--size",
                 "for example --size 210x148.5"};
  }
  if (auto status = write_target_sheet(options.out, width / 1e3, height / 1e3); !status)
    return status;
  const std::string description =
      std::filesystem::path(options.out).replace_extension(".yaml").string();
  auto status = write_file(description, [&](std::ostream& out) {
    out << "# A black rectangle on white around the world's origin, z = 0; metres.\n"
        << "rectangle: {width: " << width / 1e3 << ", height: " << height / 1e3 << "}\n";
  });
  if (!status) return status;
  std::printf("%s to print at full size, %s to give to the program\n", options.out.c_str(),
              description.c_str());
  return ok();
}

}  // namespace

void add_calibrate_target(CLI::App& calibrate, Task* task) {
  CLI::App* command =
      calibrate.add_subcommand("target", "a start target for a single camera, to print");
  auto options = std::make_shared<TargetOptions>();
  command->add_option("--size", options->size, "of the black rectangle, WIDTHxHEIGHT in mm")
      ->capture_default_str();
  command->add_option("--out", options->out, "PDF to write; a YAML file is written beside it")
      ->capture_default_str();
  command->callback([task, options] { *task = [options] { return make_target(*options); }; });
}

}  // namespace armsreach::app
