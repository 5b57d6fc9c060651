// Draws simulated hands as a camera sees them.
#pragma once

#include <memory>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "devices/sim/hand/hand_actor.hpp"
#include "devices/sim/hand/raster.hpp"
#include "devices/sim/hand/skin_look.hpp"
#include "vision/core/camera.hpp"

namespace armsreach::sim {

class HandPainter {
 public:
  explicit HandPainter(const std::vector<HandDescription>& hands,
                       const HandSurroundings& surroundings = {});
  ~HandPainter();
  HandPainter(HandPainter&&) noexcept;
  HandPainter& operator=(HandPainter&&) noexcept;

  const std::vector<HandActor>& actors() const { return actors_; }
  std::vector<HandTruth> truth(double time, const Pose& world_from_camera) const;

  // Takes up the hands' postures and places at this time, in the world.
  void set_time(double time, const Pose& world_from_camera);
  const HandSurface& surface(std::size_t hand) const;
  // Of the hand with its forearm, and of the upper arm (empty if it has none), in the world as they
  // are then.
  const PosedSurface& skin(std::size_t hand) const;
  const PosedSurface& upper_arm(std::size_t hand) const;
  // As they are then. `lighting` is in the world's frame, but for its eye, which is the camera's.
  // Surface ids are 1 for the first hand, 2 for the second.
  Raster::Images draw(Raster& raster, const Pose& world_from_camera, const Lighting& lighting);

 private:
  struct Cover;
  struct Body;
  std::vector<HandActor> actors_;
  std::vector<Body> bodies_;
};

}  // namespace armsreach::sim
