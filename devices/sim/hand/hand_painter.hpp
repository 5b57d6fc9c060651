// Draws simulated hands as a camera sees them.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "devices/sim/hand/hand_actor.hpp"
#include "devices/sim/hand/raster.hpp"
#include "devices/sim/hand/skin_look.hpp"
#include "vision/core/camera.hpp"

namespace armsreach::sim {

// Of one hand, as what it touches feels it.
struct FeltSkin {
  const HandSurface& surface;
  std::span<const Eigen::Vector3f> points;  // of the surface's vertices, in their order
};

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
  // The hand's skin with the forearm, in the world as it is then, on a mesh that no camera chooses.
  // Valid until the next call.
  FeltSkin skin(std::size_t hand);
  // Points of the upper arm's surface then; none if it has none.
  std::span<const Eigen::Vector3f> upper_arm(std::size_t hand) const;
  // As they are then, with skin as fine as that camera can see. `lighting` is in the world's frame,
  // but for its eye, which is the camera's. Surface ids are 1 for the first hand, 2 for the second.
  Raster::Images draw(Raster& raster, const Pose& world_from_camera, const Lighting& lighting);

 private:
  struct Body;
  std::vector<HandActor> actors_;
  std::vector<Body> bodies_;
};

}  // namespace armsreach::sim
