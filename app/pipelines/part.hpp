// A part of a pipeline: some stages, joined among themselves and to the rest.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "app/runtime/stage.hpp"
#include "app/runtime/wiring.hpp"
#include "app/session/config.hpp"

namespace armsreach::app {

// What all parts need to join their stages. Outlives them.
struct PartContext {
  const Config& config;
  Wiring wiring;
  FaultHandler fault;
};

// A node, and how many inputs the connection that drives it has dropped.
struct PartNode {
  Node* node;
  std::function<std::int64_t()> drops;
};

}  // namespace armsreach::app
