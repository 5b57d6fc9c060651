// armsreach calibrate skin: a skin model for a user, a light and a camera, or for everybody.
#include <cstdio>
#include <fstream>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <opencv2/imgproc.hpp>

#include "app/cli/color_files.hpp"
#include "app/cli/commands.hpp"
#include "app/cli/gesture_files.hpp"
#include "app/cli/rig_options.hpp"
#include "app/cli/source_kinds.hpp"
#include "app/runtime/interrupt.hpp"
#include "app/runtime/progress.hpp"
#include "devices/files.hpp"
#include "vision/gesture/color_training.hpp"
#include "vision/gesture/gesture_detector.hpp"
#include "vision/gesture/hand_shape.hpp"
#include "vision/gesture/skin_segmenter.hpp"

namespace armsreach::app {
namespace {

using gesture::ColorExamples;
using gesture::ColorModel;

constexpr int kEvery = 5;  // frames of a live view: neighbours look alike

struct CalibrateSkinOptions {
  std::vector<std::string> pictures;
  std::string masks;
  std::optional<int> mask_value;
  std::string pixels;
  std::string source;
  std::int64_t frames = 150;
  std::string model;
  bool balance = false;
  std::string out;
};

struct View {
  cv::Mat bgr;
  cv::Mat skin;  // CV_8UC1, not 0 on skin
};

// What was learnt from so far; views without masks are judged first.
class Lessons {
 public:
  explicit Lessons(ColorModel general)
      : general_(std::move(general)),
        segmenter_(general_, {.adaptation = gesture::SkinOptions::Adaptation::image}) {}

  void add_masked(View view) { views_.push_back(std::move(view)); }

  void add_unmasked(const cv::Mat& bgr) {
    const cv::Mat skin = segmenter_.segment(bgr);
    auto hand = hand_in(skin);
    if (hand) {
      views_.push_back({bgr.clone(), *std::move(hand)});
    } else {
      ++refused_;
    }
  }

  const ColorModel& general() const { return general_; }
  const std::vector<View>& views() const { return views_; }
  int refused() const { return refused_; }

  Status check() const {
    if (!views_.empty()) return ok();
    return Error{"no view shows a hand that can be learnt from: " + refusal_.value_or("no view"),
                 "calibrate skin",
                 "hold a bare hand into the picture in front of something of another colour, or "
                 "give --masks DIR"};
  }

 private:
  // What is taken for the hand, where it is one by its colours and its shape.
  std::optional<cv::Mat> hand_in(const cv::Mat& skin) {
    refusal_ = segmenter_.adapted() ? std::nullopt : gesture::refusal(segmenter_.evidence());
    if (!segmenter_.adapted()) return std::nullopt;
    cv::Mat blob = gesture::largest_blob(skin);
    const auto hands = gesture::HandFinder().find(blob);
    if (!hands.empty() && hands[0].plausible) return blob;
    refusal_ = "what has the colour of skin has not the size of a hand that reaches into the view";
    return std::nullopt;
  }

  ColorModel general_;
  gesture::SkinSegmenter segmenter_;
  std::vector<View> views_;
  int refused_ = 0;
  std::optional<std::string> refusal_;
};

Result<ColorExamples> examples_of(const std::vector<View>& views, std::size_t left_out) {
  ColorExamples examples;
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (i == left_out && views.size() > 1) continue;
    const auto status = gesture::add_examples(views[i].bgr, views[i].skin, "a view", &examples);
    if (!status) return status.error();
  }
  return examples;
}

Result<ColorModel> fitted(const Lessons& lessons, const ColorExamples& examples, bool balance) {
  if (balance) return gesture::balanced(lessons.general(), gesture::level_of(examples));
  return gesture::fitted_skin_model(lessons.general(), examples, "calibrate skin");
}

// Mean F1 over the views, each by a model that has not seen it (unless it is the only one).
Result<double> quality(const Lessons& lessons, bool balance) {
  constexpr std::size_t kMost = 20;  // views judged: more say the same
  const auto& views = lessons.views();
  const std::size_t step = (views.size() + kMost - 1) / kMost;
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < views.size(); i += step) {
    auto examples = examples_of(views, i);
    if (!examples) return examples.error();
    auto model = fitted(lessons, *examples, balance);
    if (!model) return model.error();
    gesture::SkinSegmenter segmenter(*model);
    const cv::Mat& found = segmenter.segment(views[i].bgr);
    const int both = cv::countNonZero(found & views[i].skin);
    const int either = cv::countNonZero(found) + cv::countNonZero(views[i].skin);
    sum += either > 0 ? 2.0 * both / either : 1;
    ++count;
  }
  return sum / count;
}

Status add_pictures(const CalibrateSkinOptions& options, Lessons* lessons) {
  auto files = list_pictures(options.pictures);
  if (!files) return files.error();
  Progress progress;
  for (const auto& file : *files) {
    auto bgr = read_picture(file);
    if (!bgr) return bgr.error();
    if (progress.due()) progress.show(file.string());
    if (options.masks.empty()) {
      lessons->add_unmasked(*bgr);
      continue;
    }
    auto mask = read_mask_of(file, options.masks, bgr->size(), options.mask_value);
    if (!mask) return mask.error();
    lessons->add_masked({*bgr, *mask});
  }
  return ok();
}

// Cupboards have a hand's colour and size, too, but hardly ever make a gesture (2 of 40 views of a
// kitchen, where about half of those of hands do).
Status check_gestures(const Lessons& lessons) {
  constexpr int kOneIn = 5;
  constexpr int kFewest = 3;  // views that say something
  const auto views = static_cast<int>(lessons.views().size());
  if (views < kFewest) return ok();
  auto known = load_gestures("", "wearable", "");
  if (!known) return known.error();
  const gesture::GestureDetector detector(std::move(known->templates), known->options);
  int told = 0;
  for (const View& view : lessons.views()) {
    const auto hands = detector.detect(view.skin, view.bgr);
    told += !hands.empty() && hands[0].gesture ? 1 : 0;
  }
  if (kOneIn * told >= views) return ok();
  return Error{"what has the colour of skin is hardly ever a hand: it makes a gesture in " +
                   std::to_string(told) + " of " + std::to_string(views) + " views",
               "calibrate skin",
               "hold an open hand into the view, in front of something of another colour"};
}

Status add_live_view(const CalibrateSkinOptions& options, Lessons* lessons) {
  auto spec = parse_source_spec(options.source);
  if (!spec) return spec.error();
  auto source = open_source(*spec, {}, all_source_kinds());
  if (!source) return source.error();
  const InterruptGuard guard([&] { (*source)->stop(); });
  Progress progress;
  for (std::int64_t i = 0; i < options.frames; ++i) {
    auto frame = (*source)->next();
    if (!frame) return frame.error();
    if (!*frame) break;
    const cv::Mat& bgr = (*frame)->color;
    if (bgr.type() != CV_8UC3) {
      return Error{"gives no colour pictures", options.source, "give a colour camera"};
    }
    if (i % kEvery == 0) lessons->add_unmasked(bgr);
    if (progress.due()) {
      progress.show("frame " + std::to_string(i + 1) + ": hold a bare hand into the view; " +
                    std::to_string(lessons->views().size()) + " views learnt from");
    }
  }
  return ok();
}

// For everybody: a list of pixels, and pictures with masks, where there are any, counting as much.
Status make_general(const CalibrateSkinOptions& options) {
  std::ifstream in(options.pixels);
  if (!in || folder_exists(options.pixels))
    return Error{"cannot be opened", options.pixels, "give a CSV file b,g,r,label"};
  std::vector<ColorExamples> sets(1);
  if (auto status = gesture::add_pixel_list(in, options.pixels, &sets[0]); !status) return status;
  if (sets[0].inside.empty() && sets[0].outside.empty()) {
    return Error{"has no lines of pixels", options.pixels,
                 "lines are b,g,r,label: levels 0-255, then 1 for skin or 2 for other things"};
  }
  if (!options.pictures.empty()) {
    ColorModel nothing;
    nothing.classes.push_back({gesture::kSkin, {}});
    Lessons lessons(nothing);
    if (auto status = add_pictures(options, &lessons); !status) return status;
    auto seen = examples_of(lessons.views(), lessons.views().size());
    if (!seen) return seen.error();
    sets.push_back(std::move(*seen));
  }
  auto model = gesture::general_skin_model(sets, options.pixels);
  if (!model) return model.error();
  return write_model_file(options.out, *model);
}

Status calibrate(const CalibrateSkinOptions& options) {
  if (!options.pixels.empty()) return make_general(options);
  auto general = skin_model(options.model);
  if (!general) return general.error();
  Lessons lessons(std::move(*general));
  const Status status =
      options.source.empty() ? add_pictures(options, &lessons) : add_live_view(options, &lessons);
  if (!status) return status;
  if (auto enough = lessons.check(); !enough) return enough;
  if (options.masks.empty()) {
    if (auto hands = check_gestures(lessons); !hands) return hands;
  }
  auto examples = examples_of(lessons.views(), lessons.views().size());
  if (!examples) return examples.error();
  auto model = fitted(lessons, *examples, options.balance);
  if (!model) return model.error();
  auto f1 = quality(lessons, options.balance);
  if (!f1) return f1.error();
  if (auto written = write_model_file(options.out, *model); !written) return written;
  const std::size_t views = lessons.views().size();
  std::printf("%s: from %zu view%s", options.out.c_str(), views, views > 1 ? "s" : "");
  if (lessons.refused() > 0) std::printf(" (%d not usable)", lessons.refused());
  std::printf(", F1 %.3f %s%s\n", *f1,
              options.masks.empty() ? "with what was itself taken for the hand, which is no truth"
                                    : "against the masks",
              views > 1 ? ", each view left out in turn" : "");
  if (*f1 < 0.8) std::printf("skin and background are alike here: try another light or place\n");
  return ok();
}

}  // namespace

void add_calibrate_skin(CLI::App& calibrate_verb, Task* task) {
  CLI::App* command = calibrate_verb.add_subcommand("skin", "a skin model for user, light, camera");
  auto o = std::make_shared<CalibrateSkinOptions>();
  auto* pictures = command->add_option("pictures", o->pictures, "pictures of the user's bare hand");
  auto* masks =
      command->add_option("--masks", o->masks, "folder of masks, PNGs of the pictures' stems");
  masks->needs(pictures);
  command->add_option("--mask-value", o->mask_value, "skin's value in them [all but 0]")
      ->needs(masks);
  auto* source = command->add_option("--source", o->source, "a live view: SPEC, see `sources`");
  source->excludes(pictures);
  command->add_option("--frames", o->frames, "of the live view")
      ->capture_default_str()
      ->check(at_least_one, "COUNT");
  auto* model = command->add_option(
      "--model", o->model, "start from this model [built in]; simulated: of simulated hands");
  auto* balance = command->add_flag(
      "--balance", o->balance, "only balance the user's own --model for another light or camera");
  balance->needs(model);
  auto* pixels = command->add_option(
      "--pixels", o->pixels, "a model for everybody, from lines b,g,r,label (1 skin, 2 not)");
  pixels->excludes(source)->excludes(model);
  command->add_option("--out", o->out, "YAML file to write")->required();
  command->callback([task, o, command] {
    if (o->pictures.empty() && o->source.empty() && o->pixels.empty()) {
      throw CLI::RequiredError(command->get_name() + ": pictures, --source or --pixels");
    }
    *task = [o] { return calibrate(*o); };
  });
}

}  // namespace armsreach::app
