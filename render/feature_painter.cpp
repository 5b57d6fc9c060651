#include "render/feature_painter.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include <Eigen/Eigenvalues>

#include "render/scene_lines.hpp"
#include "render/theme.hpp"

namespace armsreach::render {
namespace {

using Eigen::Vector2f;

struct Instance {
  Vector2f centre;
  Vector2f a;  // semi-axes
  Vector2f b;
  theme::Color color;
};

Instance instance_of(const View& view, const Feature& feature) {
  const float scale = static_cast<float>(view.target_scale.x());
  // Below this an ellipse is a dot, and a line of a pixel would fill it anyway.
  const float smallest = 2.2F;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2f> axes(feature.covariance);
  const auto semi_axis = [&](int i) {
    const float sigma = std::sqrt(std::max(axes.eigenvalues()[i], 0.F));
    const Vector2f along = axes.eigenvectors().col(i);
    return Vector2f(std::max(3 * sigma * scale, smallest) * along);
  };
  return {view.target_scale.cast<float>().cwiseProduct(feature.pixel) +
              view.target_offset.cast<float>(),
          semi_axis(0), semi_axis(1), color_of(feature.state)};
}

}  // namespace

Result<FeaturePainter> FeaturePainter::make(const Gl& gl) {
  auto program = Program::from_assets(gl, {"shaders/target.glsl", "shaders/feature.vert.glsl"},
                                      {"shaders/feature.frag.glsl"});
  if (!program) return program.error();
  FeaturePainter painter;
  painter.program_ = *std::move(program);
  painter.quads_ = InstancedQuads(gl, sizeof(Instance),
                                  {{2, GL_FLOAT, false, offsetof(Instance, centre)},
                                   {4, GL_FLOAT, false, offsetof(Instance, a)},
                                   {4, GL_UNSIGNED_BYTE, true, offsetof(Instance, color)}});
  return painter;
}

void FeaturePainter::draw(const View& view, const std::vector<Feature>& features) const {
  if (features.empty()) return;
  std::vector<Instance> instances;
  instances.reserve(features.size());
  for (const Feature& feature : features) {
    if (feature.pixel.allFinite() && feature.covariance.allFinite())
      instances.push_back(instance_of(view, feature));
  }
  program_.use();
  program_.set("target_size", Vector2f(static_cast<float>(view.target_width),
                                       static_cast<float>(view.target_height)));
  quads_.draw(instances.data(), instances.size());
}

}  // namespace armsreach::render
