#include "devices/sim/hand_stage.hpp"

#include <cmath>
#include <utility>

#include "devices/sim/hand_layer.hpp"
#include "devices/sim/motion.hpp"

namespace armsreach::sim {

HandStage::HandStage(const World& world, const Camera& camera,
                     std::function<Pose(double)> world_from_carrier, const Shoulders& shoulders)
    : things_(world.things.size()),
      light_(world.light),
      camera_(camera),
      world_from_carrier_(std::move(world_from_carrier)),
      painter_(world.hands, {poses_of(world.things), shoulders}),
      raster_(camera),
      holding_(world, painter_.actors(), world_from_carrier_),
      contacts_(world) {
  if (world.infrared) worn_.emplace(world.hands.front(), *world.infrared, poses_of(world.things));
}

std::vector<HandTruth> HandStage::truth(double time) const {
  return painter_.truth(time, world_from_carrier_(time));
}

std::vector<std::vector<std::pair<int, HandPart>>> HandStage::touched(
    const std::vector<Pose>& world_from_thing) {
  std::vector<std::vector<std::pair<int, HandPart>>> touched;
  for (std::size_t i = 0; i < painter_.actors().size(); ++i) {
    const FeltSkin skin = painter_.skin(i);
    touched.push_back(contacts_.at(skin.surface, skin.points, world_from_thing));
  }
  return touched;
}

std::vector<TrueMarker> HandStage::markers(double time, const Pose& world_from_camera,
                                           const cv::Mat& depth) const {
  constexpr double kThick = 0.004;  // m, of a glove and the net that its skin is drawn with
  std::vector<TrueMarker> markers;
  if (!worn_) return markers;
  const InfraredHand::Moment moment = worn_->at(time);
  const Pose camera_from_hand = world_from_camera.inverse() * moment.world_from_hand;
  for (const TapePiece& piece : moment.worn.tape) {
    const Eigen::Vector3d point = camera_from_hand * piece.centre;
    TrueMarker marker{piece.name, moment.world_from_hand * piece.centre, 0};
    const auto pixel = project(camera_, point);
    if (pixel && camera_.contains(*pixel)) {
      const cv::Point at(static_cast<int>(std::lround(pixel->x())),
                         static_cast<int>(std::lround(pixel->y())));
      marker.visible = static_cast<double>(depth.at<float>(at)) > point.z() - kThick ? 1 : 0;
    }
    markers.push_back(std::move(marker));
  }
  return markers;
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
