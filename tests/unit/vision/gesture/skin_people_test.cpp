// The default skin model on photographs of people it has never seen.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include "painted_skin.hpp"
#include "tests/support/recordings.hpp"
#include "vision/gesture/color_model_yaml.hpp"
#include "vision/gesture/skin_segmenter.hpp"

namespace armsreach::gesture::test {
namespace {

namespace fs = std::filesystem;

struct Photo {
  std::string name;
  cv::Mat bgr, mask;
};

// By person: "hgr1_id01" of "2_P_hgr1_id01_3.jpg". A photo in two folders counts once.
std::map<std::string, std::vector<Photo>> photos_of_people(const std::vector<fs::path>& folders) {
  std::map<std::string, fs::path> files;
  for (const fs::path& folder : folders) {
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
      if (entry.path().extension() == ".jpg") files.emplace(entry.path().stem(), entry.path());
    }
  }
  std::map<std::string, std::vector<Photo>> people;
  for (const auto& [name, file] : files) {
    const fs::path mask = fs::path(file).replace_extension(".mask.png");
    if (!fs::exists(mask)) continue;
    const auto begin = name.find("hgr");
    people[name.substr(begin, name.rfind('_') - begin)].push_back(
        {name, cv::imread(file.string()), cv::imread(mask.string(), cv::IMREAD_GRAYSCALE) != 0});
  }
  return people;
}

ColorModel default_model() {
  const std::string path = ARMSREACH_SOURCE_DIR "/assets/skin/default.yaml";
  std::ifstream in(path);
  auto model = read_color_model(in, path);
  EXPECT_TRUE(model.ok()) << model.error().message();
  return *model;
}

TEST(SkinOfPeople, WithoutCalibration) {
  ARMSREACH_RECORDING_OR_SKIP(gestures, "hands/gestures");
  ARMSREACH_RECORDING_OR_SKIP(masks, "hands/skin_masks");
  SkinSegmenter plain(default_model());
  SkinSegmenter adapting(default_model(), {.adaptation = SkinOptions::Adaptation::image});
  double sum = 0, plain_sum = 0;
  int count = 0;
  for (const auto& [person, photos] : photos_of_people({gestures, masks})) {
    double own = 0;
    for (const Photo& photo : photos) {
      const double before = f1(plain.segment(photo.bgr), photo.mask);
      const double after = f1(adapting.segment(photo.bgr), photo.mask);
      EXPECT_GT(after, before - 0.1) << photo.name << ": re-estimation must never ruin";
      plain_sum += before;
      own += after;
    }
    std::printf("%s: F1 %.3f over %zu photos\n", person.c_str(),
                own / static_cast<double>(photos.size()), photos.size());
    sum += own;
    count += static_cast<int>(photos.size());
  }
  std::printf("mean F1 %.3f, without re-estimation %.3f\n", sum / count, plain_sum / count);
  EXPECT_GT(sum / count, 0.88);
  EXPECT_GT(sum, plain_sum);
}

TEST(SkinOfPeople, WithOneViewOfThePerson) {
  ARMSREACH_RECORDING_OR_SKIP(gestures, "hands/gestures");
  ARMSREACH_RECORDING_OR_SKIP(masks, "hands/skin_masks");
  const ColorModel general = default_model();
  double sum = 0;
  int count = 0;
  for (const auto& [person, photos] : photos_of_people({gestures, masks})) {
    ColorExamples examples;
    ASSERT_TRUE(add_examples(photos[0].bgr, photos[0].mask, photos[0].name, &examples).ok());
    SkinSegmenter segmenter(*fitted_skin_model(general, examples, photos[0].name));
    for (std::size_t i = 1; i < photos.size(); ++i, ++count) {
      sum += f1(segmenter.segment(photos[i].bgr), photos[i].mask);
    }
  }
  std::printf("mean F1 %.3f over %d photos\n", sum / count, count);
  EXPECT_GT(sum / count, 0.90);
}

}  // namespace
}  // namespace armsreach::gesture::test
