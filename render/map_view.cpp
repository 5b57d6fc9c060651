#include "render/map_view.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "render/annotations.hpp"
#include "render/theme.hpp"

namespace armsreach::render {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr double kPeriod = 0.0999;  // s of video between two drawings of a view

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

// 1, 2 or 5 times a power of ten, at most `limit`.
double round_length(double limit) {
  const double decade = std::pow(10, std::floor(std::log10(limit)));
  for (const double factor : {5.0, 2.0}) {
    if (factor * decade <= limit) return factor * decade;
  }
  return decade;
}

// A square grid on the lowest level of the room, fading outwards.
void add_ground(Lines& lines, const Eigen::AlignedBox3d& box, const RoomFromWorld& room) {
  const double radius = 0.5 * box.sizes().head<2>().norm();
  const double cell = round_length(std::max(0.1, 0.45 * radius));
  const int reach = std::clamp(static_cast<int>(std::ceil(1.4 * radius / cell)), 2, 8);
  const Vector3d centre(std::round(box.center().x() / cell) * cell,
                        std::round(box.center().y() / cell) * cell, box.min().z());
  const auto world = [&](double x, double y) {
    return Vector3f((room.conjugate() * (centre + Vector3d(x, y, 0))).cast<float>());
  };
  for (int i = -reach; i <= reach; ++i) {
    theme::Color color = theme::kLine;
    const double fade = 1 - std::abs(i) / (reach + 1.0);
    color[3] = static_cast<std::uint8_t>(190 * fade);
    lines.segment(world(i * cell, -reach * cell), world(i * cell, reach * cell), color);
    lines.segment(world(-reach * cell, i * cell), world(reach * cell, i * cell), color);
  }
}

// The camera as a pyramid with its image's outline, as the lens sees it.
void add_camera(Lines& lines, const Scene& scene, float size) {
  const Camera& camera = scene.camera;
  if (camera.width <= 0) return;
  const auto at = [&](double x, double y) {
    return Vector3f(
        (scene.world_from_camera * (static_cast<double>(size) * unproject(camera, {x, y})))
            .cast<float>());
  };
  const double right = camera.width - 0.5;
  const double low = camera.height - 0.5;
  const std::array corners{at(-0.5, -0.5), at(right, -0.5), at(right, low), at(-0.5, low)};
  const Vector3f centre = scene.world_from_camera.translation().cast<float>();
  for (std::size_t i = 0; i < 4; ++i) {
    lines.segment(centre, corners[i], theme::kAccent);
    lines.segment(corners[i], corners[(i + 1) % 4], theme::kAccent);
  }
}

void add_trails(Lines& lines, const Scene& scene) {
  for (const Trail& trail : scene.trails) {
    const Vector3f rgb = 255 * trail.color.cwiseMax(0.F).cwiseMin(1.F);
    lines.fading_path(trail.points_in_world,
                      {static_cast<std::uint8_t>(rgb.x()), static_cast<std::uint8_t>(rgb.y()),
                       static_cast<std::uint8_t>(rgb.z()), 255});
  }
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
  const bool mapped = scene.surface && scene.surface->blocks.size() > 20;
  // The first guess may have had no surface to go by; with some it is made once more, then kept.
  if (!room_ || (room_is_guess_ && mapped)) {
    room_ = guess_room(scene);
    room_is_guess_ = !mapped;
    framing_ = {};
  }
  if (const auto bounds = scene_bounds(scene, *room_)) framing_.follow(*bounds, scene.time);
}

View MapView::view_for(const Picture& picture, const Rectangle& place) const {
  switch (picture.kind) {
    case ViewKind::top:
      return side_view(Side::top, framing_, *room_, place.width, place.height);
    case ViewKind::front:
      return side_view(Side::front, framing_, *room_, place.width, place.height);
    case ViewKind::side:
      return side_view(Side::side, framing_, *room_, place.width, place.height);
    case ViewKind::live:
    case ViewKind::map:
      break;
  }
  return orbit_view(orbit_, framing_, *room_, place.width, place.height);
}

// The view that has waited longest of those that are due.
MapView::Picture* MapView::next_due(const Scene& scene) {
  Picture* oldest = nullptr;
  for (Picture& picture : pictures_) {
    const bool due = scene.time - picture.time >= kPeriod || scene.time < picture.time;
    if (due && (!oldest || picture.time < oldest->time)) oldest = &picture;
  }
  return oldest;
}

Status MapView::draw(const Scene& scene, ObjectPainter& objects, const LinePainter& lines,
                     const Desk& desk) {
  follow(scene);
  if (framing_.box().isEmpty())
    framing_.follow({Vector3d(-1, -1, -1), Vector3d(1, 1, 1)}, scene.time);
  if (scene.surface && scene.surface->revision != surface_revision_) {
    cloud_.update(*scene.surface);
    surface_revision_ = scene.surface->revision;
  }
  if (Picture* due = next_due(scene)) due->stale = true;
  for (Picture& picture : pictures_) {
    const Rectangle& place = place_of(picture.kind, desk);
    const bool resized =
        picture.framebuffer.width() != place.width || picture.framebuffer.height() != place.height;
    if (!picture.stale && !resized) continue;
    if (const Status drawn = draw_picture(picture, scene, objects, lines, place); !drawn)
      return drawn.error();
  }
  return ok();
}

Status MapView::draw_picture(Picture& picture, const Scene& scene, ObjectPainter& objects,
                             const LinePainter& lines, const Rectangle& place) {
  if (picture.framebuffer.width() != place.width || picture.framebuffer.height() != place.height) {
    // Without MSAA, which would double the cost: a cloud of points has no edges to smooth.
    auto made =
        Framebuffer::make(*gl_, {.width = place.width, .height = place.height, .depth = true});
    if (!made) return made.error();
    picture.framebuffer = *std::move(made);
  }
  picture.view = view_for(picture, place);
  picture.time = scene.time;
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
  cloud_.draw(picture.view, light_in_camera.cast<float>());
  Lines ground;
  if (picture.kind == ViewKind::map) add_ground(ground, framing_.box(), *room_);
  lines.draw(picture.view, ground, 1.2F);
  objects.draw_shadows(picture.view, scene.objects, std::nullopt);
  gl_->Disable(GL_DEPTH_TEST);
  objects.draw_objects(picture.view, scene.objects, std::nullopt);
  Lines over;  // always in sight
  add_trails(over, scene);
  if (scene.pose_known)
    add_camera(over, scene, static_cast<float>(0.07 * framing_.box().diagonal().norm()));
  lines.draw(picture.view, over, 1.8F);
  return ok();
}

void MapView::copy_pictures(const Framebuffer& target, const Desk& desk) const {
  for (const Picture& picture : pictures_) {
    const Rectangle& place = place_of(picture.kind, desk);
    picture.framebuffer.copy_to(target, place.x, place.y);
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
  for (const Picture& picture : pictures_) {
    if (picture.kind != ended.view) continue;
    const Rectangle& place = place_of(picture.kind, desk);
    const Eigen::Vector2d pixel(static_cast<double>(ended.start.x()) - place.x - 0.5,
                                static_cast<double>(ended.start.y()) - place.y - 0.5);
    return ViewClick{picture.kind, pixel, ray_through(picture.view, pixel), {}};
  }
  return std::nullopt;
}

}  // namespace armsreach::render
