// What the program brings along to find hands, read from its assets.
#pragma once

#include <string>

#include "vision/gesture/gesture_detector.hpp"
#include "vision/gesture/skin_segmenter.hpp"

namespace armsreach::test {

gesture::TemplateSet own_templates(const std::string& vocabulary);
gesture::TextureModel own_texture();
// Each picture a scene of its own.
gesture::SkinSegmenter own_segmenter();

}  // namespace armsreach::test
