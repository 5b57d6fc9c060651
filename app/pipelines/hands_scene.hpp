// How hands and what they point at appear in the scene.
#pragma once

#include "app/pipelines/hands_stage.hpp"
#include "render/scene.hpp"

namespace armsreach::app {

void add_hands(const HandsState& hands, render::Scene* scene);

}  // namespace armsreach::app
