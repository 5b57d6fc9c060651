#include "app/cli/gesture_files.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string_view>
#include <system_error>
#include <vector>

#include "app/runtime/output_file.hpp"
#include "devices/files.hpp"
#include "render/assets.hpp"

namespace armsreach::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* kExtension = ".txt";

struct Vocabulary {
  std::string_view name;
  std::vector<std::string> gestures;
};
const std::array<Vocabulary, 2>& own_vocabularies() {
  static const std::array<Vocabulary, 2> all{
      Vocabulary{"wearable", {"L", "fist", "grasp", "open", "point"}},
      Vocabulary{"asl-digits", {"0", "1", "2", "3", "4", "5", "6", "7", "8", "9"}}};
  return all;
}

Result<gesture::TemplateSet> own_templates(const std::string& vocabulary) {
  for (const Vocabulary& one : own_vocabularies()) {
    if (one.name != vocabulary) continue;
    gesture::TemplateSet set;
    for (const std::string& gesture : one.gestures) {
      const std::string asset = "gestures/" + vocabulary + "/" + gesture + kExtension;
      std::istringstream in{std::string(render::asset(asset))};
      if (auto status = gesture::read_templates(in, gesture, asset, &set); !status)
        return status.error();
    }
    return set;
  }
  return Error{"no such vocabulary", vocabulary,
               "take wearable or asl-digits, or give your own templates with --templates"};
}

Status read_file(const fs::path& file, gesture::TemplateSet* set) {
  std::ifstream in(file);
  if (!in) return Error{"cannot be opened", file.string(), "check its permissions"};
  return gesture::read_templates(in, file.stem().string(), file.string(), set);
}

bool is_plain_name(const std::string& name) {
  return !name.empty() && name[0] != '.' && name.find_first_of("/\\") == std::string::npos;
}

// All of a folder, in order of gestures' names; none where there is no folder.
Result<gesture::TemplateSet> templates_in(const fs::path& place) {
  std::vector<fs::path> files;
  std::error_code failure;
  for (fs::directory_iterator entry(place, failure), end; !failure && entry != end;
       entry.increment(failure)) {
    if (entry->path().extension() == kExtension) files.push_back(entry->path());
  }
  std::sort(files.begin(), files.end());
  gesture::TemplateSet set;
  for (const fs::path& file : files) {
    if (auto status = read_file(file, &set); !status) return status.error();
  }
  return set;
}

}  // namespace

Result<gesture::TemplateSet> load_templates(const std::string& folder,
                                            const std::string& vocabulary) {
  if (folder.empty()) return own_templates(vocabulary);
  const fs::path place = fs::path(folder) / vocabulary;
  auto set = templates_in(place);
  if (set && set->templates.empty()) {
    return Error{"holds no templates of gestures", place.string(),
                 "learn some with `armsreach learn gesture NAME IMAGE --templates " + folder + "`"};
  }
  return set;
}

Result<gesture::TextureModel> load_texture(const std::string& path) {
  if (path.empty()) {
    constexpr const char* kOwn = "gestures/hands.txt";
    std::istringstream in{std::string(render::asset(kOwn))};
    return gesture::read_texture_model(in, kOwn);
  }
  std::ifstream in(path);
  if (!in || fs::is_directory(path))
    return Error{"cannot be opened", path, "write it with `armsreach learn hands`"};
  return gesture::read_texture_model(in, path);
}

Result<KnownGestures> load_gestures(const std::string& folder, const std::string& vocabulary,
                                    const std::string& texture) {
  auto templates = load_templates(folder, vocabulary);
  if (!templates) return templates.error();
  auto model = load_texture(texture);
  if (!model) return model.error();
  auto options = gesture::options_for(*templates, *model);
  return KnownGestures{*std::move(templates), std::move(options)};
}

Result<std::optional<gesture::RingLayout>> layout_in(const std::string& folder,
                                                     const std::string& vocabulary) {
  auto set = templates_in(fs::path(folder) / vocabulary);
  if (!set) return set.error();
  return set->templates.empty() ? std::nullopt : std::optional(set->layout);
}

Status add_to_templates(const std::string& folder, const std::string& vocabulary,
                        const std::string& gesture, const gesture::TemplateSet& added) {
  for (const std::string& name : {vocabulary, gesture}) {
    if (!is_plain_name(name))
      return Error{"cannot be the name of a file", name, "give a name without slashes"};
  }
  const fs::path place = fs::path(folder) / vocabulary;
  auto known = templates_in(place);
  if (!known) return known.error();
  gesture::TemplateSet& all = *known;
  if (all.templates.empty()) all.layout = added.layout;
  if (!(all.layout == added.layout)) {
    return Error{"holds templates of another layout: " + gesture::text_of(all.layout) +
                     "; these have " + gesture::text_of(added.layout),
                 place.string(), "give another --templates folder, or its --rings"};
  }
  std::error_code failure;
  fs::create_directories(place, failure);
  const fs::path file = place / (gesture + kExtension);
  all.templates.insert(all.templates.end(), added.templates.begin(), added.templates.end());
  return write_file(file.string(),
                    [&](std::ostream& out) { gesture::write_templates(out, gesture, all); });
}

}  // namespace armsreach::app
