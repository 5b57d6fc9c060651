#include "devices/sim/carrier.hpp"

#include "devices/sim/path.hpp"
#include "devices/sim/wearer.hpp"

namespace armsreach::sim {

Carrier carrier_of(const World& world, const SensorDescription& sensor, std::uint64_t seed) {
  if (sensor.mount == Mount::path) {
    const CameraPath path(sensor.path ? *sensor.path : world.path, seed);
    return [path](double time) { return path.world_from_camera(time); };
  }
  const Wearer wearer(*world.wearer, world.path, seed);
  if (sensor.mount == Mount::head)
    return [wearer](double time) { return wearer.world_from_head(time); };
  return [wearer](double time) { return wearer.world_from_shoulder(time); };
}

Shoulders shoulders_of(const World& world, const SensorDescription& sensor, std::uint64_t seed) {
  if (sensor.mount == Mount::path) return {};
  const Wearer wearer(*world.wearer, world.path, seed);
  return [wearer](bool left, double time) { return wearer.shoulder(left, time); };
}

}  // namespace armsreach::sim
