#include "devices/sim/hand_stage.hpp"

#include <utility>

#include "devices/sim/hand_layer.hpp"

namespace armsreach::sim {

HandStage::HandStage(const World& world, const Camera& camera,
                     std::function<Pose(double)> world_from_carrier)
    : things_(world.things.size()),
      light_(world.light),
      world_from_carrier_(std::move(world_from_carrier)),
      painter_(world.hands),
      raster_(camera),
      holding_(world, painter_.actors(), world_from_carrier_) {}

std::vector<HandTruth> HandStage::truth(double time) const {
  return painter_.truth(time, world_from_carrier_(time));
}

Raster::Images HandStage::draw(double time, const Pose& world_from_camera, ExactImages& images) {
  painter_.set_time(time, world_from_carrier_(time));
  Lighting lighting;
  lighting.light = light_;
  lighting.eye = world_from_camera.translation().cast<float>();
  Raster::Images hands = painter_.draw(raster_, world_from_camera, lighting);
  hide_behind(images.depth, hands);
  lay_color(hands, images.color);
  lay_depth(hands, images.depth);
  lay_value(hands, kSkinReturns, images.returned);
  lay_masks(hands, static_cast<int>(things_), images.masks);
  return hands;
}

}  // namespace armsreach::sim
