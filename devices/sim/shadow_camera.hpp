// The world's depths as a far light sees them.
#pragma once

#include <functional>
#include <vector>

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

#include "devices/sim/gpu_world.hpp"
#include "devices/sim/world.hpp"
#include "devices/sim/world_mesh.hpp"
#include "render/gl_objects.hpp"
#include "render/view.hpp"
#include "vision/core/result.hpp"

namespace armsreach::sim {

struct Ball {
  Eigen::Vector3d centre{0, 0, 0};
  double radius = 0;
};

// Floors and walls, which are seen from one side only, cast no shadow.
bool casts_shadow(const Part& part);

using WantedPart = std::function<bool(const Part&)>;

// Around those parts that are wanted, with things at their `poses`.
Ball ball_around(const World& world, const WorldMesh& mesh, const std::vector<Pose>& poses,
                 const WantedPart& wanted);

// Orthographic, from a light in that direction onto all of the ball.
render::View view_from(const Eigen::Vector3d& towards_light, const Ball& ball, int side);

class ShadowCamera {
 public:
  ShadowCamera() = default;
  // A square picture, `side` px.
  static Result<ShadowCamera> make(const render::Gl& gl, int side);

  // Depths in m along the light's way, far where nothing is.
  void draw(const render::View& view, const World& world, const GpuWorld& gpu_world,
            const std::vector<Pose>& poses, const WantedPart& wanted) const;
  const cv::Mat& read();  // CV_32F
  const render::Texture& texture() const { return target_.color(); }
  int side() const { return target_.width(); }

 private:
  const render::Gl* gl_ = nullptr;
  render::Program program_;
  render::Framebuffer target_;
  cv::Mat depths_;
};

}  // namespace armsreach::sim
