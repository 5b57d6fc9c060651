// Makes assets/skin/simulated.yaml:
//   armsreach_simulated_skin GENERAL_SKIN_MODEL OUT_FILE
// Hands of every tone over two wooden tables, each pixel counted as what it is drawn from.
#include <cstdio>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "devices/open.hpp"
#include "devices/sim/hand_source.hpp"
#include "devices/sim/hand_yaml.hpp"
#include "devices/sim/sim_source.hpp"
#include "devices/truth.hpp"
#include "render/assets.hpp"
#include "vision/gesture/color_model_yaml.hpp"
#include "vision/gesture/color_training.hpp"

namespace armsreach::tools {
namespace {

// Ten views of the script's first seven seconds, in which the kitchen's own hand is not yet there.
constexpr const char* kScenes[] = {"sim:bench,width=320,rate=1.5,frames=10,seed=",
                                   "sim:kitchen-table,width=320,rate=1.5,frames=10,seed="};

Status add_views(const std::string& scene, std::vector<sim::HandDescription> hands, int tone,
                 gesture::ColorExamples* examples) {
  hands[0].skin = static_cast<sim::SkinTone>(tone);
  hands[0].sleeve = false;
  auto world =
      open_source(*parse_source_spec(scene + std::to_string(1 + tone)), {}, sim_source_kinds());
  if (!world) return world.error();
  const auto source = sim::make_hand_source(*std::move(world), hands, 1 + tone);
  for (;;) {
    const auto frame = source->next();
    if (!frame) return frame.error();
    if (!*frame) return ok();
    const Truth& truth = *(*frame)->truth;
    const cv::Mat skin = truth.masks == truth.hands.back().mask;
    if (auto status = gesture::add_examples((*frame)->color, skin, scene, examples); !status)
      return status;
  }
}

Result<gesture::ColorModel> make(const std::string& general_file) {
  std::ifstream in(general_file);
  auto general = gesture::read_color_model(in, general_file);
  if (!general) return general.error();
  const std::string script = "hands/gestures.yaml";
  std::istringstream text{std::string(render::asset(script))};
  const auto hands = sim::read_hand_script(text, script);
  if (!hands) return hands.error();
  gesture::ColorExamples examples;
  for (const char* scene : kScenes) {
    for (int tone = 0; tone < sim::kSkinToneCount; ++tone) {
      if (auto status = add_views(scene, *hands, tone, &examples); !status) return status.error();
    }
  }
  return gesture::fitted_skin_model(*general, examples, "simulated views");
}

int write(const std::string& general_file, const std::string& out_file) {
  const auto model = make(general_file);
  if (!model) {
    std::fprintf(stderr, "%s\n", model.error().message().c_str());
    return 2;
  }
  std::ofstream out(out_file);
  gesture::write_color_model(out, *model);
  return out.flush() ? 0 : 3;
}

}  // namespace
}  // namespace armsreach::tools

int main(int argc, char** argv) {
  if (argc == 3) return armsreach::tools::write(argv[1], argv[2]);
  std::fprintf(stderr, "armsreach_simulated_skin GENERAL_SKIN_MODEL OUT_FILE\n");
  return 2;
}
