// armsreach detect colours: things known by their colour in pictures, as JSON.
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "app/cli/color_files.hpp"
#include "app/cli/commands.hpp"
#include "app/runtime/output_file.hpp"
#include "app/runtime/progress.hpp"
#include "vision/gesture/color_blobs.hpp"

namespace armsreach::app {
namespace {

struct DetectColorsOptions {
  std::vector<std::string> pictures;
  std::string classes;
  std::string json;
};

nlohmann::json json_from_blobs(const gesture::ColorBlobs& blobs) {
  nlohmann::json list = nlohmann::json::array();
  for (const gesture::ColorBlob& blob : blobs) {
    const cv::Rect& box = blob.box;
    list.push_back(
        {{"name", blob.name}, {"box", {box.x, box.y, box.width, box.height}}, {"area", blob.area}});
  }
  return list;
}

Status detect(const DetectColorsOptions& options) {
  auto model = things_model(options.classes);
  if (!model) return model.error();
  auto files = list_pictures(options.pictures);
  if (!files) return files.error();
  gesture::ColorBlobFinder finder(std::move(*model));
  nlohmann::json all = nlohmann::json::array();
  Progress progress;
  for (const auto& file : *files) {
    auto bgr = read_picture(file);
    if (!bgr) return bgr.error();
    const auto blobs = finder.find(*bgr);
    all.push_back({{"file", file.string()}, {"blobs", json_from_blobs(blobs)}});
    if (progress.due()) {
      progress.show("searched " + std::to_string(all.size()) + " of " +
                    std::to_string(files->size()) + " pictures");
    }
  }
  return write_file(options.json, [&](std::ostream& out) { out << all.dump(2) << "\n"; });
}

}  // namespace

void add_detect_colors(CLI::App& detect_verb, Task* task) {
  CLI::App* command = detect_verb.add_subcommand("colours", "things known by their colour");
  auto o = std::make_shared<DetectColorsOptions>();
  command->add_option("pictures", o->pictures, "pictures, or folders of them")->required();
  command->add_option("--classes", o->classes, "YAML file that `learn colour` wrote")->required();
  command->add_option("--json", o->json, "write what was found here")->required();
  command->callback([task, o] { *task = [o] { return detect(*o); }; });
}

}  // namespace armsreach::app
