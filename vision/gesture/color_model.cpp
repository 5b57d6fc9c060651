#include "vision/gesture/color_model.hpp"

namespace armsreach::gesture {

int class_named(const ColorModel& model, const std::string& name) {
  for (std::size_t i = 0; i < model.classes.size(); ++i) {
    if (model.classes[i].name == name) return static_cast<int>(i);
  }
  return -1;
}

}  // namespace armsreach::gesture
