#include "render/map_view.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "render/annotations.hpp"
#include "render/scene_lines.hpp"
#include "render/theme.hpp"

namespace armsreach::render {
namespace {

using Eigen::Vector3d;

constexpr double kAxes = 0.1;               // m
constexpr double kPointsPerSecond = 300e3;  // of video, in each view

const Rectangle& place_of(ViewKind kind, const Desk& desk) {
  switch (kind) {
    case ViewKind::top:
      return desk.sides[0];
    case ViewKind::front:
      return desk.sides[1];
    case ViewKind::side:
      return desk.sides[2];
    case ViewKind::live:
    case ViewKind::map:
      break;
  }
  return desk.map;
}

bool inside(const Rectangle& r, const Eigen::Vector2f& p) {
  const float x = p.x() - static_cast<float>(r.x);
  const float y = p.y() - static_cast<float>(r.y);
  return x >= 0 && y >= 0 && x < static_cast<float>(r.width) && y < static_cast<float>(r.height);
}

bool same(const std::vector<VirtualObject>& a, const std::vector<VirtualObject>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& x, const auto& y) {
    return x.id == y.id && x.mesh == y.mesh && x.scale == y.scale && x.selected == y.selected &&
           x.world_from_object.translation() == y.world_from_object.translation() &&
           x.world_from_object.rotation().coeffs() == y.world_from_object.rotation().coeffs();
  });
}

// A length in round figures, on glass so that it reads on bright surface too.
void draw_scale_bar(ImDrawList& list, const Fonts& fonts, const View& view,
                    const Rectangle& place) {
  const double px_per_metre = view.camera.fx;
  const double metres = round_length(0.4 * place.width / px_per_metre);
  const float length = static_cast<float>(metres * px_per_metre);
  const std::string text = metres >= 1 ? std::to_string(std::lround(metres)) + " m"
                                       : std::to_string(std::lround(100 * metres)) + " cm";
  const float right = static_cast<float>(place.x + place.width) - 16;
  const float y = static_cast<float>(place.y + place.height) - 15;
  list.AddRectFilled({right - length - 8, y - 23}, {right + 8, y + 7}, imgui_color(theme::kGlass),
                     theme::kSmallRounding);
  const ImU32 color = imgui_color(theme::kInk);
  list.AddLine({right - length, y}, {right, y}, color, 1.5F);
  for (const float x : {right - length, right}) list.AddLine({x, y - 4}, {x, y + 1}, color, 1.5F);
  const ImVec2 size = fonts.small->CalcTextSizeA(fonts.small->FontSize, 1e6F, 0, text.c_str());
  list.AddText(fonts.small, fonts.small->FontSize, {right - 0.5F * (length + size.x), y - 20},
               color, text.c_str());
}

}  // namespace

void round_corners(ImDrawList& list, const Rectangle& place) {
  const float r = theme::kRounding;
  const float pi = std::numbers::pi_v<float>;
  for (int corner = 0; corner < 4; ++corner) {
    const bool right = corner == 1 || corner == 2;
    const bool lower = corner >= 2;
    const ImVec2 tip{static_cast<float>(place.x + (right ? place.width : 0)),
                     static_cast<float>(place.y + (lower ? place.height : 0))};
    const ImVec2 centre{tip.x + (right ? -r : r), tip.y + (lower ? -r : r)};
    const float from = pi + 0.5F * pi * static_cast<float>(corner);
    list.PathLineTo(tip);
    list.PathArcTo(centre, r, from + 0.5F * pi, from, 8);
    list.PathFillConvex(imgui_color(theme::kDesk));
  }
}

Result<MapView> MapView::make(const Gl& gl) {
  auto cloud = SurfaceCloud::make(gl);
  if (!cloud) return cloud.error();
  MapView map;
  map.gl_ = &gl;
  map.cloud_ = *std::move(cloud);
  const std::array kinds{ViewKind::map, ViewKind::top, ViewKind::front, ViewKind::side};
  for (std::size_t i = 0; i < kinds.size(); ++i) map.pictures_[i].kind = kinds[i];
  return map;
}

void MapView::follow(const Scene& scene) {
  const bool mapped = (scene.surface && scene.surface->blocks.size() > 20) ||
                      (!scene.points.empty() && !scene.up_in_world.isZero());
  // The first guess may have had no surface to go by; with some it is made once more, then kept.
  if (!room_ || (room_is_guess_ && mapped)) {
    room_ = guess_room(scene);
    room_is_guess_ = !mapped;
    framing_ = {};
  }
  if (const auto bounds = scene_bounds(scene, *room_)) framing_.follow(*bounds, scene.time);
}

View MapView::view_for(ViewKind kind, int width, int height) const {
  switch (kind) {
    case ViewKind::top:
      return side_view(Side::top, framing_, *room_, width, height);
    case ViewKind::front:
      return side_view(Side::front, framing_, *room_, width, height);
    case ViewKind::side:
      return side_view(Side::side, framing_, *room_, width, height);
    case ViewKind::live:
    case ViewKind::map:
      break;
  }
  return orbit_view(orbit_, framing_, *room_, width, height);
}

// A change of the surface may wait: until 0.1 s of video have passed since the last drawing, and
// longer the more points there are, so that drawing stays a small part of the time.
double MapView::patience(const Picture& picture) const {
  return std::max(0.0999, static_cast<double>(picture.points) / kPointsPerSecond);
}

// One picture at a time, first what the person or the scene's objects changed, then what has waited
// longest.
MapView::Picture* MapView::next_due(const Scene& scene) {
  Picture* next = nullptr;
  for (Picture& picture : pictures_) {
    const bool changed = picture.revision != surface_revision_ ||
                         !picture.box.isApprox(framing_.box(), 1e-3) || scene.time < picture.time;
    const bool due = changed && std::abs(scene.time - picture.time) >= patience(picture);
    if (!picture.stale && !due) continue;
    const auto urgency = [](const Picture& p) { return std::pair(!p.stale, p.time); };
    if (!next || urgency(picture) < urgency(*next)) next = &picture;
  }
  return next;
}

void MapView::take_over(const Scene& scene) {
  follow(scene);
  if (framing_.box().isEmpty())
    framing_.follow({Vector3d(-1, -1, -1), Vector3d(1, 1, 1)}, scene.time);
  if (scene.surface && scene.surface->revision != surface_revision_) {
    cloud_.update(*scene.surface);
    surface_revision_ = scene.surface->revision;
  }
  if (!same(scene.objects, objects_)) {
    objects_ = scene.objects;
    for (Picture& picture : pictures_) picture.stale = true;
  }
}

Status MapView::draw(const Scene& scene, ObjectPainter& objects, const LinePainter& lines,
                     const Desk& desk) {
  take_over(scene);
  for (Picture& picture : pictures_) {
    const Rectangle& place = place_of(picture.kind, desk);
    if (picture.framebuffer.width() == place.width && picture.framebuffer.height() == place.height)
      continue;
    // Without MSAA, which would double the cost: a cloud of points has no edges to smooth.
    auto made =
        Framebuffer::make(*gl_, {.width = place.width, .height = place.height, .depth = true});
    if (!made) return made.error();
    picture.framebuffer = *std::move(made);
    draw_picture(picture, scene, objects, lines);
  }
  if (Picture* due = next_due(scene)) draw_picture(*due, scene, objects, lines);
  return ok();
}

void MapView::draw_picture(Picture& picture, const Scene& scene, ObjectPainter& objects,
                           const LinePainter& lines) {
  picture.view = view_for(picture.kind, picture.framebuffer.width(), picture.framebuffer.height());
  picture.time = scene.time;
  picture.revision = surface_revision_;
  picture.box = framing_.box();
  picture.stale = false;

  picture.framebuffer.bind();
  const Eigen::Vector4f background = theme::rgba(theme::kPanel);
  gl_->ClearColor(background.x(), background.y(), background.z(), 1);
  gl_->Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
  gl_->Enable(GL_DEPTH_TEST);
  // The light hangs in the room, behind the left shoulder of who looks along the room's y.
  const Vector3d light_in_room = Vector3d(-0.4, -0.55, 0.73).normalized();
  const Vector3d light_in_camera =
      picture.view.world_from_camera.rotation().conjugate() * (room_->conjugate() * light_in_room);
  picture.points = cloud_.draw(picture.view, light_in_camera.cast<float>());
  Lines ground;
  if (picture.kind == ViewKind::map) add_ground(ground, framing_.box(), *room_);
  lines.draw(picture.view, ground, 1.2F);
  objects.draw_shadows(picture.view, scene.objects, std::nullopt);
  gl_->Disable(GL_DEPTH_TEST);
  objects.draw_objects(picture.view, scene.objects, std::nullopt);
}

void MapView::compose(const Scene& scene, const LinePainter& lines, const Framebuffer& target,
                      const Desk& desk) const {
  Lines moving;
  add_trails(moving, scene);
  if (scene.pose_known) add_camera(moving, scene, 0.07 * framing_.box().diagonal().norm());
  if (scene.world_axes) add_world_axes(moving, kAxes);
  Lines detailed = moving;
  add_points(moving, scene, PointDetail::crosses);
  add_points(detailed, scene, PointDetail::ellipsoids);
  for (const Picture& picture : pictures_) {
    const Rectangle& place = place_of(picture.kind, desk);
    picture.framebuffer.copy_to(target, place.x, place.y);
    View view = picture.view;
    view.target_offset += Eigen::Vector2d(place.x, place.y);
    view.target_width = target.width();
    view.target_height = target.height();
    target.bind();
    gl_->Enable(GL_SCISSOR_TEST);
    gl_->Scissor(place.x, place.y, place.width, place.height);
    lines.draw(view, picture.kind == ViewKind::map ? detailed : moving, 1.8F);
    gl_->Disable(GL_SCISSOR_TEST);
  }
}

void MapView::draw_frames(ImDrawList& list, const Fonts& fonts, const Desk& desk) const {
  for (const Picture& picture : pictures_) {
    const Rectangle& place = place_of(picture.kind, desk);
    round_corners(list, place);
    const char* title = picture.kind == ViewKind::map     ? "Map"
                        : picture.kind == ViewKind::top   ? "Top"
                        : picture.kind == ViewKind::front ? "Front"
                                                          : "Side";
    draw_pill(list, *fonts.small,
              {static_cast<float>(place.x) + 8, static_cast<float>(place.y) + 8}, title);
    if (picture.view.orthographic) draw_scale_bar(list, fonts, picture.view, place);
  }
}

std::optional<ViewClick> MapView::handle_mouse(const InputState& input, const Desk& desk) {
  Picture& map = pictures_[0];
  if (input.wheel != 0 && inside(desk.map, input.mouse)) {
    orbit_.zoom =
        std::clamp(orbit_.zoom * std::pow(1.15, static_cast<double>(input.wheel)), 0.2, 12.0);
    map.stale = true;
  }
  for (int button = 0; button < 2; ++button) {
    if (!input.clicked[static_cast<std::size_t>(button)]) continue;
    for (const Picture& picture : pictures_) {
      if (inside(place_of(picture.kind, desk), input.mouse))
        drag_ = Drag{picture.kind, input.mouse, input.mouse, button};
    }
  }
  if (!drag_) return std::nullopt;
  const Eigen::Vector2d step = (input.mouse - drag_->last).cast<double>();
  drag_->last = input.mouse;
  drag_->moved |= (input.mouse - drag_->start).norm() > 4;
  if (drag_->moved && drag_->view == ViewKind::map && !step.isZero()) {
    if (drag_->button == 0) {
      orbit_.azimuth += 0.006 * step.x();
      orbit_.elevation = std::clamp(orbit_.elevation + 0.006 * step.y(), -1.5, 1.5);
    } else {
      const double distance =
          (map.view.world_from_camera.translation() - room_->conjugate() * framing_.box().center())
              .norm();
      const Vector3d in_camera(-step.x(), -step.y(), 0);
      orbit_.pan += *room_ * (map.view.world_from_camera.rotation() *
                              (in_camera * distance / map.view.camera.fx));
    }
    map.stale = true;
  }
  if (input.down[static_cast<std::size_t>(drag_->button)]) return std::nullopt;
  const Drag ended = *std::exchange(drag_, std::nullopt);
  if (ended.moved || ended.button != 0) return std::nullopt;
  const Rectangle& place = place_of(ended.view, desk);
  const Eigen::Vector2d pixel(static_cast<double>(ended.start.x()) - place.x - 0.5,
                              static_cast<double>(ended.start.y()) - place.y - 0.5);
  return ViewClick{ended.view, pixel, ray(ended.view, pixel), {}};
}

std::optional<Ray> MapView::ray(ViewKind kind, const Eigen::Vector2d& pixel) const {
  for (const Picture& picture : pictures_) {
    if (picture.kind == kind) return ray_through(picture.view, pixel);
  }
  return std::nullopt;
}

}  // namespace armsreach::render
