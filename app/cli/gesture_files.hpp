// What hands and their gestures look like, in files or the program's own: templates of gestures in
// folders as DIR/VOCABULARY/GESTURE.txt, and the texture of hands.
#pragma once

#include <optional>
#include <string>

#include "vision/core/result.hpp"
#include "vision/gesture/gesture_detector.hpp"

namespace armsreach::app {

// Those of a vocabulary, in order of gestures' names; the program's own where `folder` is empty.
Result<gesture::TemplateSet> load_templates(const std::string& folder,
                                            const std::string& vocabulary);

// The program's own where `path` is empty.
Result<gesture::TextureModel> load_texture(const std::string& path);

// What a GestureDetector is made of.
struct KnownGestures {
  gesture::TemplateSet templates;
  gesture::GestureDetectorOptions options;
};
Result<KnownGestures> load_gestures(const std::string& folder, const std::string& vocabulary,
                                    const std::string& texture);

// The layout of the rings of those in a folder; nothing where there are none yet.
Result<std::optional<gesture::RingLayout>> layout_in(const std::string& folder,
                                                     const std::string& vocabulary);

// Adds templates of one gesture to those that are there already, which must all have their layout.
Status add_to_templates(const std::string& folder, const std::string& vocabulary,
                        const std::string& gesture, const gesture::TemplateSet& added);

}  // namespace armsreach::app
