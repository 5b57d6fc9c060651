// Gives every node a thread, or a turn in a loop, until all have ended.
#pragma once

#include <memory>
#include <vector>

#include "app/runtime/stage.hpp"

namespace armsreach::app {

// `nodes` in the order of the data. The last one always runs on the calling thread (it may own a
// graphics context). Returns when every node has ended: sources close, queues drain, threads join.
void run_threaded(const std::vector<Node*>& nodes);
void run_in_turns(const std::vector<Node*>& nodes);

}  // namespace armsreach::app
