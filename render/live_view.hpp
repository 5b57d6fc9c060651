// The augmented camera view: the video as it came, and everything virtual bent through the same
// lens so that it fits.
#pragma once

#include <memory>
#include <optional>

#include "render/feature_painter.hpp"
#include "render/gl_objects.hpp"
#include "render/line_painter.hpp"
#include "render/object_painter.hpp"
#include "render/scene.hpp"
#include "render/view.hpp"

namespace armsreach::render {

// The background's camera onto a target of this size.
View live_view_of(const Scene& scene, int width, int height);

class LiveView {
 public:
  struct Options {
    int samples = 4;  // MSAA of virtual objects; all else is smoothed by its shaders
    bool show_inliers = false;
  };

  static Result<LiveView> make(const Gl& gl, const Options& options);

  // Draws over all of `target`, which is single-sampled. `objects` is shared by all views.
  Status draw(const Scene& scene, ObjectPainter& objects, const LinePainter& lines,
              const Framebuffer& target);
  void show_inliers(bool shown) { options_.show_inliers = shown; }

 private:
  void draw_video(const Scene& scene, const View& view, const Framebuffer& target);
  void draw_inliers(const Scene& scene, const View& view);
  Result<std::optional<Rectangle>> draw_object_layer(const Scene& scene, const View& view,
                                                     ObjectPainter& objects);
  void compose_object_layer(const Rectangle& part, const View& view);
  Status fit_layer(int width, int height);
  std::optional<SceneDepth> scene_depth(const Scene& scene, const View& view) const;
  void compose(const Program& program, const Texture& texture, const Eigen::Vector4f& rectangle,
               const Eigen::Vector4f& part, const View& view) const;

  const Gl* gl_ = nullptr;
  Options options_;
  Program picture_;
  Program inliers_program_;
  VertexArray no_attributes_;
  FeaturePainter features_;
  Framebuffer layer_;  // the part with objects, multisampled, transparent around them
  Texture depth_;
  Texture inliers_;
};

}  // namespace armsreach::render
