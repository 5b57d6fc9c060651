#include "devices/sim/shadow_camera.hpp"

#include <utility>

#include <Eigen/Geometry>

namespace armsreach::sim {

using Eigen::Vector3d;

bool casts_shadow(const Part& part) { return !std::holds_alternative<Panel>(part.shape); }

Ball ball_around(const World& world, const WorldMesh& mesh, const std::vector<Pose>& poses,
                 const WantedPart& wanted) {
  Eigen::AlignedBox3d box;
  for (std::size_t i = 0; i < world.parts.size(); ++i) {
    if (!wanted(world.parts[i])) continue;
    const Pose& pose = poses[static_cast<std::size_t>(world.parts[i].thing)];
    const MeshRange& range = mesh.parts[i];
    for (std::uint32_t k = range.first; k < range.first + range.count; ++k)
      box.extend(pose * Vector3d(mesh.vertices[mesh.indices[k]].position.cast<double>()));
  }
  if (box.isEmpty()) return {};
  return {box.center(), 0.5 * box.diagonal().norm()};
}

render::View view_from(const Vector3d& towards_light, const Ball& ball, int side) {
  const Eigen::Quaterniond rotation =
      Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), -towards_light);
  const double radius = 1.05 * ball.radius + 0.01;  // the map's rim stays empty
  const double pixels_per_metre = side / (2 * radius);
  const Camera camera =
      pinhole(side, side, pixels_per_metre, pixels_per_metre, 0.5 * side - 0.5, 0.5 * side - 0.5);
  render::View view = render::view_of(camera, {rotation, ball.centre + radius * towards_light});
  view.orthographic = true;
  view.near = 0;
  view.far = 2 * radius;
  return view;
}

Result<ShadowCamera> ShadowCamera::make(const render::Gl& gl, int side) {
  auto program = render::Program::from_assets(
      gl, {"shaders/target.glsl", "shaders/view.glsl", "shaders/sim_surface.vert.glsl"},
      {"shaders/sim_depth.frag.glsl"});
  if (!program) return program.error();
  constexpr render::TextureFormat kFloats{GL_R32F, GL_RED, GL_FLOAT};
  auto target = render::Framebuffer::make(gl, {side, side, 0, {kFloats}, true});
  if (!target) return target.error();
  ShadowCamera made;
  made.gl_ = &gl;
  made.program_ = std::move(*program);
  made.target_ = std::move(*target);
  made.depths_.create(side, side, CV_32F);
  return made;
}

void ShadowCamera::draw(const render::View& view, const World& world, const GpuWorld& gpu_world,
                        const std::vector<Pose>& poses, const WantedPart& wanted) const {
  target_.bind();
  gl_->ClearColor(1e6F, 0, 0, 0);
  gl_->Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  gl_->Enable(GL_DEPTH_TEST);
  gl_->Disable(GL_BLEND);
  gl_->Disable(GL_CULL_FACE);
  program_.use();
  render::set_view(program_, view);
  gpu_world.bind();
  for (std::size_t i = 0; i < world.parts.size(); ++i) {
    if (!wanted(world.parts[i])) continue;
    const Pose& pose = poses[static_cast<std::size_t>(world.parts[i].thing)];
    program_.set("world_from_thing", Eigen::Matrix4f(pose.matrix().cast<float>()));
    gpu_world.draw(i);
  }
}

const cv::Mat& ShadowCamera::read() {
  target_.read(GL_RED, GL_FLOAT, depths_.data);
  return depths_;
}

}  // namespace armsreach::sim
