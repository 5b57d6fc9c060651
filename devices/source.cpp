#include "devices/source.hpp"

#include <charconv>
#include <cmath>
#include <sstream>

namespace armsreach {
namespace {

constexpr const char* kSpecRemedy =
    "write kind:place[,key=value...], e.g. tum:recordings/kitchen; `armsreach sources` lists the "
    "kinds";

std::string shown(double number) {
  std::ostringstream text;
  text << number;
  return text.str();
}

}  // namespace

Result<SourceSpec> parse_source_spec(const std::string& text) {
  const auto colon = text.find(':');
  if (colon == std::string::npos || colon == 0) {
    return Error{"not a source: it has no kind", text, kSpecRemedy};
  }
  SourceSpec spec;
  spec.kind = text.substr(0, colon);
  std::istringstream parts(text.substr(colon + 1));
  std::getline(parts, spec.place, ',');
  if (spec.place.empty()) return Error{"not a source: it has no place", text, kSpecRemedy};
  for (std::string part; std::getline(parts, part, ',');) {
    const auto equals = part.find('=');
    if (equals == std::string::npos || equals == 0) {
      return Error{"'" + part + "' is not key=value", text, kSpecRemedy};
    }
    const std::string key = part.substr(0, equals);
    if (option(spec, key)) return Error{"option '" + key + "' is given twice", text, kSpecRemedy};
    spec.options.emplace_back(key, part.substr(equals + 1));
  }
  return spec;
}

std::string text_of(const SourceSpec& spec) {
  std::string text = spec.kind + ":" + spec.place;
  for (const auto& [key, value] : spec.options) text += "," + key + "=" + value;
  return text;
}

std::optional<std::string> option(const SourceSpec& spec, const std::string& key) {
  for (const auto& [known, value] : spec.options) {
    if (known == key) return value;
  }
  return std::nullopt;
}

Result<double> number_option(const SourceSpec& spec, const std::string& key, double fallback,
                             double low, double high) {
  const auto text = option(spec, key);
  if (!text) return fallback;
  double value = 0;
  const char* end = text->data() + text->size();
  const auto [parsed, failure] = std::from_chars(text->data(), end, value);
  if (failure != std::errc() || parsed != end || !(value >= low && value <= high)) {
    return Error{"option '" + key + "' is '" + *text + "'", text_of(spec),
                 "give a number from " + shown(low) + " to " + shown(high)};
  }
  return value;
}

}  // namespace armsreach
