#include "devices/sim/hand_stage.hpp"

#include <utility>

#include "devices/sim/hand_layer.hpp"

namespace armsreach::sim {

HandStage::HandStage(const World& world, const Camera& camera,
                     std::function<Pose(double)> world_from_camera)
    : light_(world.light),
      world_from_camera_(std::move(world_from_camera)),
      painter_(world.hands),
      raster_(camera),
      holding_(world, painter_.actors(), world_from_camera_) {}

std::vector<HandTruth> HandStage::truth(double time) const {
  return painter_.truth(time, world_from_camera_(time));
}

Raster::Images HandStage::draw(double time, ExactImages& images) {
  const Pose world_from_camera = world_from_camera_(time);
  painter_.set_time(time, world_from_camera);
  Lighting lighting;
  lighting.light = light_;
  lighting.eye = world_from_camera.translation().cast<float>();
  Raster::Images hands = painter_.draw(raster_, world_from_camera, lighting);
  hide_behind(images.depth, hands);
  lay_color(hands, images.color);
  lay_depth(hands, images.depth);
  lay_value(hands, kSkinReturns, images.returned);
  return hands;
}

}  // namespace armsreach::sim
