#include "app/interaction/hand_interaction.hpp"

#include <utility>

namespace armsreach::app {
namespace {

// The newest of the selected objects.
const PlacedObject* selected(const Placement& placement) {
  const PlacedObject* found = nullptr;
  for (const PlacedObject& object : placement.objects()) {
    if (object.selected) found = &object;
  }
  return found;
}

}  // namespace

Events HandInteraction::act(const HandCommand& command, Placement* placement,
                            const WorldView* world, const Viewer& viewer, Timestamp time) const {
  if (command.action == gesture::Action::select) {
    if (!command.ray_in_world) {
      if (!world || mesh_.empty()) return {};  // nobody asks where the camera is
      return {{time, FaultEvent{"interaction", "where the hand points in the map is not known",
                                "select again once the camera is tracked"}}};
    }
    Events events = placement->click({*command.ray_in_world, ""}, world, viewer, time);
    if (selected(*placement) || mesh_.empty()) return events;
    events = placement->click({*command.ray_in_world, mesh_}, world, viewer, time);
    for (const Event& event : events) {
      if (const auto* inserted = std::get_if<InsertEvent>(&event.body))
        placement->select(inserted->id);
    }
    return events;
  }
  const PlacedObject* meant = selected(*placement);
  if (!meant) return {};
  const Eigen::Vector3d place = Placement::world_from_object(*meant, world).translation();
  if (command.action == gesture::Action::accept) {
    const Event accepted{time, AcceptEvent{meant->id, place}};
    placement->select(0);
    return {accepted};
  }
  Events events{{time, RejectEvent{meant->id, place}}};
  for (Event& event : placement->remove_selected(world, time)) events.push_back(std::move(event));
  return events;
}

}  // namespace armsreach::app
