#include "devices/sim/world_yaml_parts.hpp"

namespace armsreach::sim {
namespace {

Lathe lathe_from(YamlMap& map) {
  Lathe lathe;
  for (const YAML::Node& point : map.need("lathe")) {
    const std::vector<double> values = numbers_from(point, map.path("lathe"));
    if (values.size() != 2 || values[0] < 0)
      throw map.complaint("lathe", "has a point that is not [radius, z]");
    lathe.profile.emplace_back(values[0], values[1]);
  }
  if (lathe.profile.size() < 2) throw map.complaint("lathe", "has fewer than two points");
  return lathe;
}

Mug mug_from(YamlMap& map) {
  const Eigen::Vector3d size = map.lengths<3>("mug");
  if (size[2] >= size[0] / 2) throw map.complaint("mug", "is all wall");
  return {size[0], size[1], size[2]};
}

Capsule capsule_from(YamlMap& map) {
  const Eigen::Vector2d size = map.lengths<2>("capsule");
  if (size[1] <= 2 * size[0]) throw map.complaint("capsule", "is not longer than its two ends");
  return {size[0], size[1]};
}

TaperedBox tapered_from(YamlMap& map) {
  const Eigen::Matrix<double, 5, 1> size = map.lengths<5>("tapered");
  return {size.head<2>(), size.segment<2>(2), size[4]};
}

Slab slab_from(YamlMap map) {
  Slab slab;
  slab.thickness = map.number("thickness", 1e-4, 10);
  for (const YAML::Node& station : map.need("outline")) {
    const std::vector<double> values = numbers_from(station, map.path("outline"));
    const bool good = values.size() == 3 && values[1] <= values[2] &&
                      (slab.stations.empty() || values[0] > slab.stations.back().x);
    if (!good)
      throw map.complaint("outline", "has a station that is not [x, low, high] with increasing x");
    slab.stations.push_back({values[0], values[1], values[2]});
  }
  if (slab.stations.size() < 2) throw map.complaint("outline", "has fewer than two stations");
  map.refuse_others();
  return slab;
}

}  // namespace

Shape shape_from(YamlMap& map) {
  std::vector<Shape> shapes;
  if (map.find("box")) shapes.push_back(Box{map.lengths<3>("box")});
  if (map.find("panel")) shapes.push_back(Panel{map.lengths<2>("panel")});
  if (map.find("cylinder")) {
    const Eigen::Vector2d size = map.lengths<2>("cylinder");
    shapes.push_back(Cylinder{size[0], size[1]});
  }
  if (map.find("mug")) shapes.push_back(mug_from(map));
  if (map.find("capsule")) shapes.push_back(capsule_from(map));
  if (map.find("tapered")) shapes.push_back(tapered_from(map));
  if (map.find("lathe")) shapes.push_back(lathe_from(map));
  if (map.find("slab")) shapes.push_back(slab_from(map.section("slab")));
  if (map.find("mesh"))
    shapes.push_back(Mesh{map.text("mesh"), map.number("scale", 1e-6, 1e6, 1), nullptr, {}});
  if (shapes.size() != 1)
    throw map.complaint(
        "", "needs one shape: box, cylinder, panel, mug, lathe, capsule, tapered, slab or mesh");
  return shapes.front();
}

}  // namespace armsreach::sim
