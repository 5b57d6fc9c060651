// Draws inserted objects: lit, standing on their soft shadow, outlined when selected, hidden by the
// real scene where its depth is known. Premultiplied alpha.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "render/contact_shadow.hpp"
#include "render/gl_objects.hpp"
#include "render/mesh.hpp"
#include "render/scene.hpp"
#include "render/view.hpp"

namespace armsreach::render {

// The scene's depth as a texture, and where a target pixel lies in it.
struct SceneDepth {
  const Texture* depth = nullptr;  // R32F, m along z of the view's camera, NaN unknown
  Eigen::Vector4f texel_from_target{1, 1, 0, 0};  // scale xy, offset xy
};

class ObjectPainter {
 public:
  static Result<ObjectPainter> make(const Gl& gl);

  // Into the bound framebuffer. Without `depth` nothing hides.
  void draw_shadows(const View& view, const std::vector<VirtualObject>& objects,
                    const std::optional<SceneDepth>& depth);
  // Into the bound framebuffer, which has depth and stencil.
  void draw_objects(const View& view, const std::vector<VirtualObject>& objects,
                    const std::optional<SceneDepth>& depth);

  // The part of the target that `draw_objects` touches, within its borders; empty when nothing
  // shows.
  Rectangle bounds(const View& view, const std::vector<VirtualObject>& objects);

 private:
  struct Model {
    GpuMesh mesh;
    GpuMesh hull;  // vertices of equal place share their normal, so that it grows without gaps
    Texture shadow;
    Eigen::Vector4f footprint{0, 0, 0, 0};
    Eigen::Vector3f low;
    Eigen::Vector3f high;
  };

  const Model& model(const std::string& mesh);
  void prepare(const Program& program, const View& view,
               const std::optional<SceneDepth>& depth) const;
  void draw_meshes(const View& view, const std::vector<VirtualObject>& objects,
                   const std::optional<SceneDepth>& depth);
  void draw_outlines(const View& view, const std::vector<VirtualObject>& objects,
                     const std::optional<SceneDepth>& depth);

  const Gl* gl_ = nullptr;
  Program lit_;
  Program outline_;
  Program shadow_;
  VertexArray no_attributes_;
  std::map<std::string, Model> models_;
};

}  // namespace armsreach::render
