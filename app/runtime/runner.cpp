#include "app/runtime/runner.hpp"

#include <cassert>
#include <thread>

namespace armsreach::app {

void run_threaded(const std::vector<Node*>& nodes) {
  assert(!nodes.empty());
  std::vector<std::jthread> threads;
  for (Node* node : nodes) {
    if (node == nodes.back()) continue;
    threads.emplace_back([node] {
      while (node->turn()) {
      }
    });
  }
  while (nodes.back()->turn()) {
  }
}

void run_in_turns(const std::vector<Node*>& nodes) {
  std::vector<Node*> running = nodes;
  while (!running.empty()) {
    std::erase_if(running, [](Node* node) { return !node->turn(); });
  }
}

}  // namespace armsreach::app
