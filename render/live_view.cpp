#include "render/live_view.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <opencv2/imgproc.hpp>

#include "render/scene_lines.hpp"
#include "render/theme.hpp"

namespace armsreach::render {
namespace {

constexpr TextureFormat kFloats{GL_R32F, GL_RED, GL_FLOAT};

// Makes or keeps a texture of an image's size and fills it.
void upload(const Gl& gl, Texture& texture, const cv::Mat& floats) {
  if (texture.width() != floats.cols || texture.height() != floats.rows)
    texture = Texture(gl, floats.cols, floats.rows, kFloats, GL_NEAREST);
  texture.upload(floats.data, static_cast<int>(floats.step1()));
}

// The video at the size it is shown, as OpenGL takes it. Scaled here because a software rasteriser
// needs ten times as long.
cv::Mat shown_video(const cv::Mat& background, const cv::Size& size) {
  cv::Mat scaled = background;
  if (background.size() != size) {
    const bool smaller = size.area() < background.size().area();
    cv::resize(background, scaled, size, 0, 0, smaller ? cv::INTER_AREA : cv::INTER_LINEAR);
  }
  cv::Mat rgba;
  cv::cvtColor(scaled, rgba, scaled.channels() == 1 ? cv::COLOR_GRAY2RGBA : cv::COLOR_BGR2RGBA);
  return rgba;
}

}  // namespace

View live_view_of(const Scene& scene, int width, int height) {
  Camera camera = scene.camera;
  if (!scene.background.empty()) {
    // Where the two disagree the picture on the screen is right.
    camera.width = scene.background.cols;
    camera.height = scene.background.rows;
  }
  if (camera.width <= 0 || camera.height <= 0) {
    camera.width = width;
    camera.height = height;
  }
  View view = view_of(camera, scene.world_from_camera);
  letterbox(view, width, height);
  return view;
}

Result<LiveView> LiveView::make(const Gl& gl, const Options& options) {
  auto picture = Program::from_assets(gl, {"shaders/target.glsl", "shaders/picture.vert.glsl"},
                                      {"shaders/picture.frag.glsl"});
  if (!picture) return picture.error();
  auto inliers = Program::from_assets(gl, {"shaders/target.glsl", "shaders/picture.vert.glsl"},
                                      {"shaders/inliers.frag.glsl"});
  if (!inliers) return inliers.error();
  auto features = FeaturePainter::make(gl);
  if (!features) return features.error();
  LiveView view;
  view.gl_ = &gl;
  view.options_ = options;
  view.picture_ = *std::move(picture);
  view.inliers_program_ = *std::move(inliers);
  view.features_ = *std::move(features);
  view.no_attributes_ = VertexArray(gl);
  return view;
}

Status LiveView::draw(const Scene& scene, ObjectPainter& objects, const LinePainter& lines,
                      const Framebuffer& target) {
  const View view = live_view_of(scene, target.width(), target.height());
  draw_video(scene, view, target);
  std::optional<Rectangle> objects_part;
  if (scene.pose_known && !scene.objects.empty()) {
    auto part = draw_object_layer(scene, view, objects);
    if (!part) return part.error();
    objects_part = *part;
  }
  target.bind();
  // Nothing of the world is drawn beside the video.
  const Rectangle shown = image_rectangle(view);
  gl_->Enable(GL_SCISSOR_TEST);
  gl_->Scissor(shown.x, shown.y, shown.width, shown.height);
  if (options_.show_inliers && !scene.inliers.empty()) draw_inliers(scene, view);
  if (scene.pose_known) {
    if (!scene.objects.empty()) {
      objects.draw_shadows(view, scene.objects, scene_depth(scene, view));
    }
    if (objects_part) compose_object_layer(*objects_part, view);
    Lines trails;
    add_trails(trails, scene);
    lines.draw(view, trails, 2);
  }
  features_.draw(view, scene.features);
  gl_->Disable(GL_SCISSOR_TEST);
  return ok();
}

void LiveView::draw_video(const Scene& scene, const View& view, const Framebuffer& target) {
  const Rectangle shown = image_rectangle(view);
  const bool covers = shown.width >= view.target_width && shown.height >= view.target_height;
  if (!covers || scene.background.empty()) {
    target.bind();
    const Eigen::Vector4f bars = theme::rgba(theme::kDesk);
    gl_->ClearColor(bars.x(), bars.y(), bars.z(), 1);
    gl_->Clear(GL_COLOR_BUFFER_BIT);
  }
  if (scene.background.empty()) return;
  target.color().upload_part(shown.x, shown.y,
                             shown_video(scene.background, {shown.width, shown.height}));
}

void LiveView::compose(const Program& program, const Texture& texture,
                       const Eigen::Vector4f& rectangle, const Eigen::Vector4f& part,
                       const View& view) const {
  program.set("target_size", Eigen::Vector2f(static_cast<float>(view.target_width),
                                             static_cast<float>(view.target_height)));
  program.set("rectangle", rectangle);
  program.set("part", part);
  program.set("picture", 0);
  texture.bind(0);
  no_attributes_.bind();
  gl_->Enable(GL_BLEND);
  gl_->BlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  gl_->DrawArrays(GL_TRIANGLE_STRIP, 0, 4);
  gl_->Disable(GL_BLEND);
}

void LiveView::draw_inliers(const Scene& scene, const View& view) {
  upload(*gl_, inliers_, scene.inliers);
  inliers_program_.use();
  inliers_program_.set("tint", theme::rgb(theme::kBad));
  const Rectangle shown = image_rectangle(view);
  compose(inliers_program_, inliers_,
          Eigen::Vector4i(shown.x, shown.y, shown.width, shown.height).cast<float>(), {0, 0, 1, 1},
          view);
}

std::optional<SceneDepth> LiveView::scene_depth(const Scene& scene, const View& view) const {
  if (scene.depth.empty()) return std::nullopt;
  // texel = (pixel + 1/2) ratio - 1/2, pixel = (target - offset) / scale.
  const Eigen::Vector2d ratio(static_cast<double>(scene.depth.cols) / view.camera.width,
                              static_cast<double>(scene.depth.rows) / view.camera.height);
  const Eigen::Vector2d scale = ratio.cwiseQuotient(view.target_scale);
  const Eigen::Vector2d offset =
      0.5 * ratio.array() - 0.5 - scale.array() * view.target_offset.array();
  Eigen::Vector4d texel_from_target;
  texel_from_target << scale, offset;
  return SceneDepth{&depth_, texel_from_target.cast<float>()};
}

Status LiveView::fit_layer(int width, int height) {
  // A whole small buffer is cleared and resolved faster than a part of a large one.
  const auto fits = [](int have, int need) { return have >= need && have < 2 * need + 128; };
  if (fits(layer_.width(), width) && fits(layer_.height(), height)) return ok();
  const auto rounded = [](int size) { return (size + 63) / 64 * 64; };
  auto layer = Framebuffer::make(*gl_, {.width = rounded(width),
                                        .height = rounded(height),
                                        .samples = options_.samples,
                                        .depth = true});
  if (!layer) return layer.error();
  layer_ = *std::move(layer);
  return ok();
}

// Objects go into a small multisampled layer first; nothing to compose when none is in view.
Result<std::optional<Rectangle>> LiveView::draw_object_layer(const Scene& scene, const View& view,
                                                             ObjectPainter& objects) {
  if (!scene.depth.empty()) upload(*gl_, depth_, scene.depth);
  const Rectangle part = objects.bounds(view, scene.objects);
  if (part.width == 0 || part.height == 0) return std::optional<Rectangle>();
  if (const Status fitted = fit_layer(part.width, part.height); !fitted) return fitted.error();
  View part_view = view;
  part_view.target_offset -= Eigen::Vector2d(part.x, part.y);
  part_view.target_width = layer_.width();
  part_view.target_height = layer_.height();
  layer_.bind();
  gl_->ClearColor(0, 0, 0, 0);
  gl_->Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
  objects.draw_objects(part_view, scene.objects, scene_depth(scene, part_view));
  layer_.resolve();
  return std::optional<Rectangle>(part);
}

void LiveView::compose_object_layer(const Rectangle& part, const View& view) {
  picture_.use();
  const Eigen::Vector2f shown(
      static_cast<float>(part.width) / static_cast<float>(layer_.width()),
      static_cast<float>(part.height) / static_cast<float>(layer_.height()));
  compose(picture_, layer_.color(),
          Eigen::Array4d(part.x, part.y, part.width, part.height).cast<float>(),
          {0, 0, shown.x(), shown.y()}, view);
}

}  // namespace armsreach::render
