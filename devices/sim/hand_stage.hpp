// The hands of a simulated world: drawn into its exact images, with what they hold and what is true
// of them.
#pragma once

#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "devices/sim/hand/hand_painter.hpp"
#include "devices/sim/hand_contacts.hpp"
#include "devices/sim/holding.hpp"
#include "devices/sim/infrared/infrared_hand.hpp"
#include "devices/sim/world.hpp"
#include "devices/sim/world_renderer.hpp"
#include "devices/truth.hpp"
#include "vision/core/camera.hpp"

namespace armsreach::sim {

class HandStage {
 public:
  // `world_from_carrier`: where the camera would be at any time if no gimbal turned it; what hands
  // before the camera are before. `shoulders`: of who wears the camera, or none.
  HandStage(const World& world, const Camera& camera,
            std::function<Pose(double)> world_from_carrier, const Shoulders& shoulders);

  std::vector<PlacedThing> held(double time) const { return holding_.at(time); }
  std::vector<HandTruth> truth(double time) const;
  // What each hand touches as it was last drawn.
  std::vector<std::vector<std::pair<int, HandPart>>> touched(
      const std::vector<Pose>& world_from_thing);
  // What the first hand wears for an infra-red camera; visible: whether this depth, which it was
  // drawn into, has the middle of it.
  std::vector<TrueMarker> markers(double time, const Pose& world_from_camera,
                                  const cv::Mat& depth) const;
  // Over what the camera sees at that time; returns what of the hands is seen.
  Raster::Images draw(double time, const Pose& world_from_camera, ExactImages& images);

 private:
  std::size_t things_;
  Light light_;
  Camera camera_;
  std::function<Pose(double)> world_from_carrier_;
  HandPainter painter_;
  Raster raster_;
  Holding holding_;
  HandContactFinder contacts_;
  std::optional<InfraredHand> worn_;
};

}  // namespace armsreach::sim
