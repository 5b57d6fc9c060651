// Templates of gestures in folders: DIR/VOCABULARY/GESTURE.txt, or the program's own.
#pragma once

#include <optional>
#include <string>

#include "vision/core/result.hpp"
#include "vision/gesture/template_set.hpp"

namespace armsreach::app {

// Those of a vocabulary, in order of gestures' names; the program's own where `folder` is empty.
Result<gesture::TemplateSet> load_templates(const std::string& folder,
                                            const std::string& vocabulary);

// The layout of the rings of those in a folder; nothing where there are none yet.
Result<std::optional<gesture::RingLayout>> layout_in(const std::string& folder,
                                                     const std::string& vocabulary);

// Adds templates of one gesture to those that are there already, which must all have their layout.
Status add_to_templates(const std::string& folder, const std::string& vocabulary,
                        const std::string& gesture, const gesture::TemplateSet& added);

}  // namespace armsreach::app
