#include "devices/sim/studio.hpp"

#include <utility>

namespace armsreach::sim {

Studio::~Studio() {
  thread_.run([this] {
    renderer_.reset();
    context_.reset();
  });
}

Result<ExactImages> Studio::draw(const World& world, const Camera& camera, std::uint64_t seed,
                                 const Pose& world_from_camera,
                                 const std::vector<Pose>& world_from_thing) {
  Result<ExactImages> images = ExactImages{};
  thread_.run([&] {
    if (!renderer_) {
      if (const Status made = make(world, camera, seed); !made) {
        images = made.error();
        return;
      }
    }
    images = renderer_->draw(world_from_camera, world_from_thing);
  });
  return images;
}

Status Studio::make(const World& world, const Camera& camera, std::uint64_t seed) {
  auto context = render::make_headless_context();
  if (!context) return context.error();
  context_ = std::move(*context);
  auto renderer = WorldRenderer::make(context_->gl(), world, camera, seed);
  if (!renderer) return renderer.error();
  renderer_ = std::move(*renderer);
  return ok();
}

}  // namespace armsreach::sim
