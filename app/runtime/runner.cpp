#include "app/runtime/runner.hpp"

#include <cassert>
#include <exception>
#include <thread>

namespace armsreach::app {

namespace {

// True while the node goes on. What escapes a turn is a defect; it ends the node, not the program.
bool turn(Node& node) {
  try {
    if (node.turn()) return true;
  } catch (const std::exception& e) {
    node.report(e.what());
  }
  node.end();
  return false;
}

void run(Node& node) {
  while (turn(node)) {
  }
}

}  // namespace

void run_threaded(const std::vector<Node*>& nodes) {
  assert(!nodes.empty());
  std::vector<std::jthread> threads;
  for (Node* node : nodes) {
    if (node != nodes.back()) threads.emplace_back([node] { run(*node); });
  }
  run(*nodes.back());
}

void run_in_turns(const std::vector<Node*>& nodes) {
  std::vector<Node*> running = nodes;
  while (!running.empty()) {
    std::erase_if(running, [](Node* node) { return !turn(*node); });
  }
}

}  // namespace armsreach::app
