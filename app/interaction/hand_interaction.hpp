// What a wearer's bare hand does to inserted objects: it selects one where it has pointed, or
// inserts one there, and then accepts or rejects it. A state machine that knows neither images nor
// threads.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "app/interaction/placement.hpp"
#include "vision/core/event.hpp"
#include "vision/core/world_view.hpp"
#include "vision/gesture/gesture_table.hpp"

namespace armsreach::app {

struct HandCommand {
  gesture::Action action = gesture::Action::select;
  std::optional<Ray> ray_in_world;  // through the cursor; nothing while the pose is unknown
};

class HandInteraction {
 public:
  // `mesh` is what a hand inserts where it selects nothing; empty: nothing.
  explicit HandInteraction(std::string mesh) : mesh_(std::move(mesh)) {}

  Events act(const HandCommand& command, Placement* placement, const WorldView* world,
             const Viewer& viewer, Timestamp time) const;

 private:
  std::string mesh_;
};

}  // namespace armsreach::app
