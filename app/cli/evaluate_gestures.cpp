// armsreach evaluate gestures: how often gestures are told right, wrong or not at all.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "app/cli/commands.hpp"
#include "app/cli/gesture_files.hpp"
#include "app/cli/gesture_options.hpp"
#include "app/cli/gesture_plots.hpp"
#include "app/runtime/output_file.hpp"
#include "devices/files.hpp"
#include "vision/gesture/gesture_detector.hpp"

namespace armsreach::app {
namespace {

namespace fs = std::filesystem;

struct EvaluateGesturesOptions {
  std::vector<std::string> folders;
  GestureOptions gestures;
  std::string json;
  std::string plots;
};

// Samples on half a ring, the paper's K.
int k_of(const gesture::RingLayout& layout) { return layout.samples / 2; }

// Every n-th sample of all templates.
gesture::TemplateSet thinned(const gesture::TemplateSet& set, int n) {
  gesture::TemplateSet thin{set.layout, {}};
  thin.layout.samples /= n;
  for (const gesture::GestureTemplate& one : set.templates) {
    gesture::GestureTemplate kept{one.gesture, {}, one.upright};
    for (std::size_t plane = 0; plane < kept.signature.planes.size(); ++plane) {
      for (int angle = 0; angle < thin.layout.samples; ++angle) {
        kept.signature.planes[plane][static_cast<std::size_t>(angle)] =
            one.signature.planes[plane][static_cast<std::size_t>(n * angle)];
      }
    }
    thin.templates.push_back(std::move(kept));
  }
  return thin;
}

// One detector for each K that the templates' own can be thinned to, the templates' own first.
std::vector<gesture::GestureDetector> detectors_over_k(const KnownGestures& known) {
  const gesture::TemplateSet& set = known.templates;
  std::vector<gesture::GestureDetector> detectors;
  for (const int n : {1, 3, 5, 9, 15}) {
    if (set.layout.samples % (2 * n) == 0 && set.layout.samples / n >= 4)
      detectors.emplace_back(thinned(set, n), known.options);
  }
  return detectors;
}

struct Scores {
  std::vector<double> there, not_there;
};

struct Evaluation {
  int pictures = 0, right = 0, wrong = 0, silent = 0;
  int first_right = 0;  // the likeliest gesture, announced or not
  Confusion confusion;
  std::vector<Scores> over_k;
};

// What is said of a picture's hands: the announced one's, else the largest's.
const gesture::HandObservation* spoken_for(const gesture::HandObservations& hands) {
  for (const auto& hand : hands)
    if (hand.gesture) return &hand;
  return hands.empty() ? nullptr : &hands[0];
}

void judge(const gesture::HandObservation* hand, const std::string& truth, Evaluation* sum) {
  const std::string said = hand != nullptr ? hand->gesture.value_or("") : "";
  ++sum->pictures;
  ++sum->confusion[truth][said];
  ++(said.empty() ? sum->silent : said == truth ? sum->right : sum->wrong);
  sum->first_right += hand != nullptr && hand->likeliest == truth ? 1 : 0;
}

// Where no hand was found, no gesture was: the least g there is.
void score(const gesture::HandObservation* hand, const std::string& truth,
           const std::vector<std::string>& gestures, Scores* scores) {
  constexpr double kLeast = -1;
  for (const std::string& name : gestures) {
    (name == truth ? scores->there : scores->not_there)
        .push_back(hand != nullptr ? hand->scores.at(name) : kLeast);
  }
}

// A class that no template stands for would be judged wrong whatever is said.
Status check_known(const std::vector<fs::path>& classes, const std::vector<std::string>& gestures) {
  std::string known;
  for (const std::string& name : gestures) known += ' ' + name;
  for (const fs::path& folder : classes) {
    const std::string name = folder.filename().string();
    if (std::find(gestures.begin(), gestures.end(), name) != gestures.end()) continue;
    return Error{"'" + name + "' is no gesture of the templates", folder.string(),
                 "they know" + known + "; give another --vocabulary or take the folder away"};
  }
  return ok();
}

// The folders of classes below those given.
Result<std::vector<fs::path>> class_folders(const std::vector<std::string>& folders) {
  std::vector<fs::path> classes;
  for (const std::string& folder : folders) {
    std::error_code failure;
    std::vector<fs::path> below;
    for (const auto& entry : fs::directory_iterator(folder, failure))
      if (folder_exists(entry.path())) below.push_back(entry.path());
    if (failure) return Error{"cannot be listed", folder, "give a folder of classes' folders"};
    std::sort(below.begin(), below.end());
    classes.insert(classes.end(), below.begin(), below.end());
  }
  if (classes.empty()) {
    return Error{"has no folders of classes", folders[0],
                 "put the pictures of each gesture in a folder of its name"};
  }
  return classes;
}

nlohmann::json json_of(const Evaluation& e,
                       const std::vector<gesture::GestureDetector>& detectors) {
  const auto rate = [&](int count) { return static_cast<double>(count) / std::max(1, e.pictures); };
  nlohmann::json json = {{"pictures", e.pictures},
                         {"right", rate(e.right)},
                         {"wrong", rate(e.wrong)},
                         {"silent", rate(e.silent)},
                         {"best_right", rate(e.first_right)},
                         {"confusion", e.confusion}};
  for (std::size_t i = 0; i < e.over_k.size(); ++i) {
    const auto curve = gesture::detection_curve(e.over_k[i].there, e.over_k[i].not_there);
    json["curves"].push_back({{"k", k_of(detectors[i].matcher().set().layout)},
                              {"area", gesture::area_under(curve)},
                              {"equal_error", gesture::equal_error(curve)}});
  }
  return json;
}

void print(const nlohmann::json& json) {
  const auto percent = [&](const char* key) { return 100 * json.at(key).get<double>(); };
  std::printf("pictures             %d\n", json.at("pictures").get<int>());
  std::printf("announced right      %.1f %%\n", percent("right"));
  std::printf("announced wrong      %.1f %%\n", percent("wrong"));
  std::printf("silent               %.1f %%\n", percent("silent"));
  std::printf("best gesture right   %.1f %% (announced or not)\n", percent("best_right"));
  for (const auto& curve : json.value("curves", nlohmann::json::array())) {
    std::printf("K = %-3d              area under the curve %.4f, equal error %.1f %%\n",
                curve.at("k").get<int>(), curve.at("area").get<double>(),
                100 * curve.at("equal_error").get<double>());
  }
}

Status write_plots(const std::string& folder, const Evaluation& evaluation,
                   const std::vector<gesture::GestureDetector>& detectors) {
  if (folder.empty()) return ok();
  std::error_code failure;
  fs::create_directories(folder, failure);
  std::vector<NamedCurve> curves;
  for (std::size_t i = 0; i < detectors.size(); ++i) {
    const Scores& scores = evaluation.over_k[i];
    curves.push_back({"K = " + std::to_string(k_of(detectors[i].matcher().set().layout)),
                      gesture::detection_curve(scores.there, scores.not_there)});
  }
  if (auto status = write_file((fs::path(folder) / "roc.svg").string(),
                               [&](std::ostream& out) { write_curves_svg(out, curves); });
      !status)
    return status;
  return write_file((fs::path(folder) / "confusion.svg").string(),
                    [&](std::ostream& out) { write_confusion_svg(out, evaluation.confusion); });
}

Status evaluate(const EvaluateGesturesOptions& options) {
  auto gestures = load_gestures(options.gestures.templates, options.gestures.vocabulary,
                                options.gestures.hands);
  if (!gestures) return gestures.error();
  auto classes = class_folders(options.folders);
  if (!classes) return classes.error();
  const auto detectors = detectors_over_k(*gestures);
  if (auto known = check_known(*classes, detectors[0].matcher().gestures()); !known) return known;
  Evaluation evaluation;
  evaluation.over_k.resize(detectors.size());
  for (const fs::path& folder : *classes) {
    const std::string truth = folder.filename().string();
    const auto status = for_hand_pictures(
        {folder.string()}, options.gestures.skin, [&](const HandPicture& picture) -> Status {
          for (std::size_t i = 0; i < detectors.size(); ++i) {
            const auto hands = detectors[i].detect(picture.skins, picture.bgr);
            const auto* hand = spoken_for(hands);
            if (i == 0) judge(hand, truth, &evaluation);
            score(hand, truth, detectors[i].matcher().gestures(), &evaluation.over_k[i]);
          }
          return ok();
        });
    if (!status) return status;
  }
  const nlohmann::json json = json_of(evaluation, detectors);
  print(json);
  if (auto status = write_plots(options.plots, evaluation, detectors); !status) return status;
  return write_file(options.json, [&](std::ostream& out) { out << json.dump(1) << "\n"; });
}

}  // namespace

void add_evaluate_gestures(CLI::App& evaluate_verb, Task* task) {
  CLI::App* command = evaluate_verb.add_subcommand("gestures", "how often gestures are told right");
  auto o = std::make_shared<EvaluateGesturesOptions>();
  command->add_option("folders", o->folders, "folders that have a folder for each gesture")
      ->required();
  add_gesture_options(*command, &o->gestures);
  command->add_option("--json", o->json, "write the figures here");
  command->add_option("--plots", o->plots, "folder for roc.svg (over K) and confusion.svg");
  command->callback([task, o] { *task = [o] { return evaluate(*o); }; });
}

}  // namespace armsreach::app
