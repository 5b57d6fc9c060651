#include <algorithm>
#include <array>

#include "devices/sim/world_yaml_parts.hpp"

namespace armsreach::sim {
namespace {

struct PatternName {
  const char* name;
  Pattern pattern;
  std::size_t colors;  // fewest that it needs
};
constexpr std::array kPatterns{
    PatternName{"plain", Pattern::plain, 1},         PatternName{"wood", Pattern::wood, 2},
    PatternName{"fabric", Pattern::fabric, 3},       PatternName{"tiles", Pattern::tiles, 3},
    PatternName{"plaster", Pattern::plaster, 1},     PatternName{"glaze", Pattern::glaze, 3},
    PatternName{"cardboard", Pattern::cardboard, 1}, PatternName{"label", Pattern::label, 4},
    PatternName{"landscape", Pattern::landscape, 6}, PatternName{"book", Pattern::book, 3},
    PatternName{"shapes", Pattern::shapes, 5},       PatternName{"leaves", Pattern::leaves, 5}};

void add_pattern(YamlMap& map, Material& material) {
  const std::string pattern = map.text("pattern");
  const auto known = std::find_if(kPatterns.begin(), kPatterns.end(),
                                  [&](const PatternName& p) { return pattern == p.name; });
  if (known == kPatterns.end())
    throw map.complaint("pattern", "cannot be: there is no pattern '" + pattern + "'");
  material.pattern = known->pattern;
  for (const YAML::Node& color : map.need("colors"))
    material.colors.push_back(color_from(color, map.path("colors")));
  if (material.colors.size() < known->colors)
    throw map.complaint("colors", "has fewer than the " + std::to_string(known->colors) +
                                      " that '" + pattern + "' needs");
}

}  // namespace

Material material_from(const std::string& name, YamlMap map) {
  Material material;
  material.name = name;
  if (map.find("texture")) {
    material.pattern = Pattern::texture;
    material.texture = map.text("texture");
  } else {
    add_pattern(map, material);
  }
  material.fit = map.flag("fit");
  material.size = material.fit ? 1 : map.number("size", 0.001, 100);
  material.shine = map.number("shine", 0, 1, 0);
  material.infrared = map.number("infrared", 0, 1, 1);
  map.refuse_others();
  return material;
}

}  // namespace armsreach::sim
