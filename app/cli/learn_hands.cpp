// armsreach learn hands: what hands look like within their outline, from pictures with and without.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include <opencv2/imgproc.hpp>

#include "app/cli/color_files.hpp"
#include "app/cli/commands.hpp"
#include "app/cli/gesture_files.hpp"
#include "app/cli/hand_pictures.hpp"
#include "app/runtime/output_file.hpp"
#include "vision/gesture/skin_segmenter.hpp"
#include "vision/gesture/texture_training.hpp"

namespace armsreach::app {
namespace {

struct LearnHandsOptions {
  std::vector<std::string> with, without;
  std::string skin;
  std::string out;
};

// What has no hand is looked at in five hues, so that more of it has the colour of skin.
constexpr int kHues = 5;

cv::Mat in_hue(const cv::Mat& bgr, int hue) {
  if (hue == 0) return bgr;
  const double angle = 2 * std::numbers::pi * hue / kHues;
  const double c = std::cos(angle), s = std::sin(angle);
  const cv::Matx34d turn(1, 0, 0, 0,  //
                         0, c, -s, 128 * (1 - c + s), 0, s, c, 128 * (1 - s - c));
  cv::Mat turned;
  cv::cvtColor(bgr, turned, cv::COLOR_BGR2YCrCb);
  cv::transform(turned, turned, turn);
  cv::cvtColor(turned, turned, cv::COLOR_YCrCb2BGR);
  return turned;
}

// Finds what has a hand's outline, whatever it looks like within.
gesture::GestureDetector outlines_only(const gesture::TemplateSet& templates) {
  gesture::GestureDetectorOptions options = gesture::options_for(templates);
  options.least_score = 2;  // nothing is told, so that every segmentation is looked at
  return gesture::GestureDetector(templates, options);
}

class Examples {
 public:
  explicit Examples(const gesture::TemplateSet& templates) : finder_(outlines_only(templates)) {}

  // The likeliest hand of a picture.
  void add_hand(const HandPicture& picture) {
    const auto hands = look(picture.skins, picture.bgr);
    const auto likeliest = std::max_element(
        hands.begin(), hands.end(),
        [](const auto& one, const auto& other) { return one.evidence < other.evidence; });
    if (likeliest != hands.end()) add(picture.bgr, *likeliest, true);
  }
  void add_others(const cv::Mat& bgr, gesture::SkinSegmenter* skin) {
    for (int hue = 0; hue < kHues; ++hue) {
      const cv::Mat turned = in_hue(bgr, hue);
      for (const auto& hand : look(skin->segmentations(turned), turned)) add(turned, hand, false);
    }
  }
  // All since the last call weigh as much as any other place's.
  void end_place() {
    for (std::size_t i = weighed_; i < all_.size(); ++i)
      all_[i].weight = 1.0 / static_cast<double>(all_.size() - weighed_);
    weighed_ = all_.size();
  }
  const std::vector<gesture::TextureExample>& all() const { return all_; }

 private:
  gesture::HandObservations look(const std::vector<cv::Mat>& skins, const cv::Mat& bgr) const {
    gesture::HandObservations hands;
    for (const cv::Mat& skin : skins)
      hands = gesture::likelier(std::move(hands), finder_.detect(skin, bgr));
    return hands;
  }
  void add(const cv::Mat& bgr, const gesture::HandObservation& hand, bool is_hand) {
    if (hand.evidence == gesture::kNoEvidence) return;
    all_.push_back({gesture::texture_features(bgr, hand), is_hand, 1});
  }

  gesture::GestureDetector finder_;
  std::vector<gesture::TextureExample> all_;
  std::size_t weighed_ = 0;
};

// What each place shows; one that cannot be read is left out with a warning.
void look_at(const std::vector<std::string>& places, const std::string& skin,
             const std::function<void(const HandPicture&)>& look, Examples* examples) {
  for (const std::string& place : places) {
    const std::size_t before = examples->all().size();
    int pictures = 0;
    const auto status = for_readable_hand_pictures({place}, {skin, ""}, [&](const HandPicture& p) {
      ++pictures;
      look(p);
    });
    if (!status)
      std::fprintf(stderr, "armsreach: left out: %s\n", status.error().message().c_str());
    std::printf("%s: %zu in %d pictures\n", place.c_str(), examples->all().size() - before,
                pictures);
    examples->end_place();
  }
}

// Of each kind: fewer say nothing of what hands have in common.
Status check_enough(std::size_t hands, std::size_t others) {
  constexpr std::size_t kFewest = 20;
  if (hands >= kFewest && others >= kFewest) return ok();
  return Error{"only " + std::to_string(hands) + " hands and " + std::to_string(others) +
                   " other things of a hand's size and colour are found",
               "learn hands",
               "give pictures of at least " + std::to_string(kFewest) +
                   " hands, one in each, and of wood, walls and boxes of skin's colour without"};
}

double told_right(const gesture::TextureModel& model,
                  const std::vector<gesture::TextureExample>& examples) {
  double right = 0, all = 0;
  for (const gesture::TextureExample& one : examples) {
    all += one.weight;
    if ((model.log_odds(one.features) > 0) == one.hand) right += one.weight;
  }
  return right / all;
}

Status learn(const LearnHandsOptions& options) {
  auto templates = load_templates("", "wearable");
  if (!templates) return templates.error();
  auto model = skin_model(options.skin);
  if (!model) return model.error();
  gesture::SkinSegmenter skin(*std::move(model),
                              {.adaptation = gesture::SkinOptions::Adaptation::image});
  Examples examples(*templates);
  look_at(
      options.with, options.skin, [&](const HandPicture& p) { examples.add_hand(p); }, &examples);
  const std::size_t hands = examples.all().size();
  look_at(
      options.without, options.skin,
      [&](const HandPicture& p) { examples.add_others(p.bgr, &skin); }, &examples);
  const std::size_t others = examples.all().size() - hands;
  if (auto status = check_enough(hands, others); !status) return status;
  auto texture = gesture::fitted_texture_model(examples.all(), "learn hands");
  if (!texture) return texture.error();
  if (auto status = write_file(
          options.out, [&](std::ostream& out) { gesture::write_texture_model(out, *texture); });
      !status)
    return status;
  std::printf("%s: learnt from %zu hands and %zu other things, of which it tells %.0f %%\n",
              options.out.c_str(), hands, others, 100 * told_right(*texture, examples.all()));
  return ok();
}

}  // namespace

void add_learn_hands(CLI::App& learn_verb, Task* task) {
  CLI::App* command =
      learn_verb.add_subcommand("hands", "what hands look like, whatever gesture they make");
  auto o = std::make_shared<LearnHandsOptions>();
  command
      ->add_option("with", o->with,
                   "pictures of one hand each, or folders of them; every one given counts alike")
      ->required();
  command->add_option("--without", o->without, "the same without hands, as like skin as there is")
      ->required();
  command->add_option("--skin", o->skin, "skin model, from `calibrate skin`");
  command->add_option("--out", o->out, "file to write, for --hands")->required();
  command->callback([task, o] { *task = [o] { return learn(*o); }; });
}

}  // namespace armsreach::app
