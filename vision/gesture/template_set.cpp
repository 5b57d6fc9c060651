#include "vision/gesture/template_set.hpp"

#include <array>
#include <charconv>
#include <iomanip>
#include <sstream>

namespace armsreach::gesture {
namespace {

constexpr const char* kFormat = "armsreach-rings 1";
constexpr const char* kUpright = "upright";
constexpr const char* kFree = "free";
constexpr std::size_t kMostTemplates = 100000;

// One line "key value value ..."; false where it is another one.
template <class T>
bool read_values(std::istream& in, const std::string& key, std::vector<T>* values) {
  std::string line;
  if (!std::getline(in, line)) return false;
  std::istringstream words(line);
  std::string first;
  if (!(words >> first) || first != key) return false;
  T value;
  while (words >> value) values->push_back(value);
  return words.eof();
}

bool read_layout(std::istream& in, RingLayout* layout) {
  std::vector<int> samples, weights;
  *layout = {};
  if (!read_values(in, "samples", &samples) || samples.size() != 1) return false;
  if (!read_values(in, "radii", &layout->radii)) return false;
  if (!read_values(in, "weights", &weights)) return false;
  for (const int weight : weights) {
    if (weight < 1 || weight > kMostWeight) return false;
    layout->weights.push_back(static_cast<std::uint8_t>(weight));
  }
  layout->samples = samples[0];
  return layout->valid();
}

bool read_template(const std::string& line, const RingLayout& layout, GestureTemplate* one) {
  std::istringstream words(line);
  std::string kind;
  if (!(words >> kind) || (kind != kUpright && kind != kFree)) return false;
  one->upright = kind == kUpright;
  words >> std::hex;
  for (int angle = 0; angle < layout.samples; ++angle) {
    unsigned bits = 0;
    if (!(words >> bits) || bits >> layout.rings() != 0) return false;
    for (int ring = 0; ring < layout.rings(); ++ring) {
      if ((bits >> ring) & 1U) one->signature.set(ring, angle);
    }
  }
  return (words >> std::ws).eof();
}

// The shortest text that is read as the same number.
std::string shortest(float value) {
  std::array<char, 32> text;
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  return {text.data(), end};
}

std::string radii_of(const RingLayout& layout) {
  std::string text;
  for (const float radius : layout.radii) text += ' ' + shortest(radius);
  return text;
}

std::string weights_of(const RingLayout& layout) {
  std::string text;
  for (const int weight : layout.weights) text += ' ' + std::to_string(weight);
  return text;
}

Error broken(const std::string& what, const std::string& where) {
  return {what, where, "remove it and learn it again with `armsreach learn gesture`"};
}

}  // namespace

std::string text_of(const RingLayout& layout) {
  return std::to_string(layout.rings()) + " rings of " + std::to_string(layout.samples) +
         " samples, radii" + radii_of(layout) + ", weights" + weights_of(layout);
}

Status read_templates(std::istream& in, const std::string& gesture, const std::string& where,
                      TemplateSet* set) {
  std::string line;
  if (!std::getline(in, line) || line != kFormat)
    return broken("is not a file of gesture templates", where);
  RingLayout layout;
  if (!read_layout(in, &layout)) return broken("has no valid layout of rings", where);
  if (set->templates.empty()) set->layout = layout;
  if (!(layout == set->layout)) {
    return broken("holds templates of another layout: " + text_of(layout) + ", the others have " +
                      text_of(set->layout),
                  where);
  }
  while (std::getline(in, line)) {
    GestureTemplate one{gesture, {}};
    if (set->templates.size() == kMostTemplates || !read_template(line, layout, &one)) {
      return broken("has a broken template, number " + std::to_string(set->templates.size() + 1),
                    where);
    }
    set->templates.push_back(std::move(one));
  }
  return ok();
}

void write_templates(std::ostream& out, const std::string& gesture, const TemplateSet& set) {
  const RingLayout& layout = set.layout;
  out << kFormat << "\nsamples " << layout.samples << "\nradii" << radii_of(layout) << "\nweights"
      << weights_of(layout) << '\n'
      << std::hex << std::setfill('0');
  for (const GestureTemplate& one : set.templates) {
    if (one.gesture != gesture) continue;
    out << (one.upright ? kUpright : kFree);
    for (int angle = 0; angle < layout.samples; ++angle) {
      unsigned bits = 0;
      for (int ring = 0; ring < layout.rings(); ++ring)
        bits |= static_cast<unsigned>(one.signature.at(ring, angle)) << ring;
      out << ' ' << std::setw((layout.rings() + 3) / 4) << bits;
    }
    out << '\n';
  }
  out << std::dec << std::setfill(' ');
}

}  // namespace armsreach::gesture
