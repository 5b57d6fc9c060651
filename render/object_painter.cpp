#include "render/object_painter.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "render/theme.hpp"

namespace armsreach::render {
namespace {

using Eigen::Matrix4f;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr int kShadowCells = 8;   // bends the decal with the lens
constexpr float kOutline = 2.5F;  // px

Matrix4f camera_from_object(const View& view, const VirtualObject& object) {
  Eigen::Matrix4d matrix = (view.world_from_camera.inverse() * object.world_from_object).matrix();
  matrix.block<3, 3>(0, 0) *= object.scale;
  return matrix.cast<float>();
}

// The mesh with one averaged normal at each place.
Mesh hull_of(const Mesh& mesh) {
  std::map<std::array<float, 3>, Vector3f> normals;
  const auto place = [](const Vertex& v) {
    return std::array{v.position.x(), v.position.y(), v.position.z()};
  };
  for (const Vertex& vertex : mesh.vertices) {
    const auto [found, fresh] = normals.try_emplace(place(vertex), Vector3f::Zero());
    found->second += vertex.normal;
  }
  Mesh hull = mesh;
  for (Vertex& vertex : hull.vertices) {
    const Vector3f& sum = normals.at(place(vertex));
    if (sum.norm() > 1e-3F) vertex.normal = sum.normalized();
  }
  return hull;
}

}  // namespace

Result<ObjectPainter> ObjectPainter::make(const Gl& gl) {
  auto lit = Program::from_assets(
      gl, {"shaders/target.glsl", "shaders/view.glsl", "shaders/mesh.vert.glsl"},
      {"shaders/occlusion.glsl", "shaders/mesh.frag.glsl"});
  if (!lit) return lit.error();
  auto outline = Program::from_assets(
      gl, {"shaders/target.glsl", "shaders/view.glsl", "shaders/outline.vert.glsl"},
      {"shaders/occlusion.glsl", "shaders/outline.frag.glsl"});
  if (!outline) return outline.error();
  auto shadow = Program::from_assets(
      gl, {"shaders/target.glsl", "shaders/view.glsl", "shaders/shadow.vert.glsl"},
      {"shaders/occlusion.glsl", "shaders/shadow.frag.glsl"});
  if (!shadow) return shadow.error();
  ObjectPainter painter;
  painter.gl_ = &gl;
  painter.lit_ = *std::move(lit);
  painter.outline_ = *std::move(outline);
  painter.shadow_ = *std::move(shadow);
  painter.no_attributes_ = VertexArray(gl);
  return painter;
}

const ObjectPainter::Model& ObjectPainter::model(const std::string& name) {
  const auto found = models_.find(name);
  if (found != models_.end()) return found->second;
  const Mesh mesh = named_mesh(name);
  const ContactShadow shadow = bake_contact_shadow(mesh);
  Model model;
  model.mesh = GpuMesh(*gl_, mesh);
  model.hull = GpuMesh(*gl_, hull_of(mesh));
  model.shadow =
      Texture(*gl_, shadow.darkness.cols, shadow.darkness.rows, {GL_R8, GL_RED, GL_UNSIGNED_BYTE});
  model.shadow.upload(shadow.darkness.data);
  model.footprint = shadow.footprint;
  model.low = model.high = mesh.vertices.front().position;
  for (const Vertex& vertex : mesh.vertices) {
    model.low = model.low.cwiseMin(vertex.position);
    model.high = model.high.cwiseMax(vertex.position);
  }
  return models_.emplace(name, std::move(model)).first->second;
}

void ObjectPainter::prepare(const Program& program, const View& view,
                            const std::optional<SceneDepth>& depth) const {
  program.use();
  set_view(program, view);
  program.set("has_scene_depth", depth ? 1 : 0);
  program.set("scene_depth", 1);
  if (!depth) return;
  depth->depth->bind(1);
  program.set("scene_depth_from_target", depth->texel_from_target);
}

void ObjectPainter::draw_objects(const View& view, const std::vector<VirtualObject>& objects,
                                 const std::optional<SceneDepth>& depth) {
  gl_->FrontFace(GL_CW);  // pictures are stored top row first, which mirrors triangles
  gl_->Enable(GL_DEPTH_TEST);
  gl_->Enable(GL_STENCIL_TEST);
  gl_->Enable(GL_CULL_FACE);
  draw_meshes(view, objects, depth);
  draw_outlines(view, objects, depth);
  gl_->Disable(GL_CULL_FACE);
  gl_->Disable(GL_STENCIL_TEST);
  gl_->Disable(GL_DEPTH_TEST);
}

void ObjectPainter::draw_shadows(const View& view, const std::vector<VirtualObject>& objects,
                                 const std::optional<SceneDepth>& depth) {
  for (const VirtualObject& object : objects) model(object.mesh);  // binds textures when new
  prepare(shadow_, view, depth);
  no_attributes_.bind();
  gl_->Enable(GL_BLEND);
  gl_->BlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  gl_->DepthMask(GL_FALSE);
  for (const VirtualObject& object : objects) {
    const Model& model = this->model(object.mesh);
    model.shadow.bind(0);
    shadow_.set("darkness", 0);
    shadow_.set("camera_from_object", camera_from_object(view, object));
    shadow_.set("footprint", model.footprint);
    shadow_.set("cells", kShadowCells);
    gl_->DrawArrays(GL_TRIANGLES, 0, 6 * kShadowCells * kShadowCells);
  }
  gl_->DepthMask(GL_TRUE);
  gl_->Disable(GL_BLEND);
}

void ObjectPainter::draw_meshes(const View& view, const std::vector<VirtualObject>& objects,
                                const std::optional<SceneDepth>& depth) {
  prepare(lit_, view, depth);
  gl_->StencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
  for (const VirtualObject& object : objects) {
    const Matrix4f matrix = camera_from_object(view, object);
    const Eigen::Matrix3f turn = matrix.block<3, 3>(0, 0) / static_cast<float>(object.scale);
    lit_.set("camera_from_object", matrix);
    lit_.set("up_in_camera", (turn * Vector3f::UnitZ()).eval());
    lit_.set("key_in_camera", (turn * Vector3f(0.62F, -0.52F, 0.59F).normalized()).eval());
    lit_.set("fill_in_camera", (turn * Vector3f(-0.75F, 0.35F, 0.45F).normalized()).eval());
    // Only what is selected leaves a mark for its outline to stay out of.
    gl_->StencilFunc(GL_ALWAYS, object.selected ? 1 : 0, 0xFF);
    model(object.mesh).mesh.draw();
  }
}

void ObjectPainter::draw_outlines(const View& view, const std::vector<VirtualObject>& objects,
                                  const std::optional<SceneDepth>& depth) {
  if (std::none_of(objects.begin(), objects.end(), [](const auto& o) { return o.selected; }))
    return;
  prepare(outline_, view, depth);
  outline_.set("grow", kOutline);
  outline_.set("tint", theme::rgb(theme::kAccent));
  gl_->StencilFunc(GL_NOTEQUAL, 1, 0xFF);
  gl_->StencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
  for (const VirtualObject& object : objects) {
    if (!object.selected) continue;
    outline_.set("camera_from_object", camera_from_object(view, object));
    model(object.mesh).hull.draw();
  }
}

Rectangle ObjectPainter::bounds(const View& view, const std::vector<VirtualObject>& objects) {
  const Rectangle everything{0, 0, view.target_width, view.target_height};
  Vector2d low(1e9, 1e9);
  Vector2d high(-1e9, -1e9);
  for (const VirtualObject& object : objects) {
    const Model& model = this->model(object.mesh);
    int in_front = 0;
    for (int corner = 0; corner < 8; ++corner) {
      const Vector3f p((corner & 1) ? model.high.x() : model.low.x(),
                       (corner & 2) ? model.high.y() : model.low.y(),
                       (corner & 4) ? model.high.z() : model.low.z());
      const Vector3d world = object.world_from_object * (object.scale * p.cast<double>());
      in_front += (view.world_from_camera.inverse() * world).z() > view.near;
      const auto pixel = project_to_target(view, world);
      if (!pixel) continue;
      low = low.cwiseMin(*pixel);
      high = high.cwiseMax(*pixel);
    }
    if (!view.orthographic && in_front > 0 && in_front < 8) return everything;
  }
  // The lens bends edges outwards between corners, by little next to this margin.
  const double margin = 4 + static_cast<double>(kOutline) + 0.05 * (high - low).maxCoeff();
  const auto clamped = [](double x, int last) {
    return static_cast<int>(std::clamp(x, 0.0, static_cast<double>(last)));
  };
  const int x0 = clamped(std::floor(low.x() - margin), view.target_width);
  const int y0 = clamped(std::floor(low.y() - margin), view.target_height);
  const int x1 = clamped(std::ceil(high.x() + margin) + 1, view.target_width);
  const int y1 = clamped(std::ceil(high.y() + margin) + 1, view.target_height);
  return {x0, y0, std::max(0, x1 - x0), std::max(0, y1 - y0)};
}

}  // namespace armsreach::render
