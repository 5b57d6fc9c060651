// The mapped world from outside: an orbiting view and orthographic top, front and side views with
// surface, camera, trajectory and inserted objects. What changes slowly is kept as a picture and
// drawn again only when it has changed, at most ten times a second of video, one view at a time.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "render/desk.hpp"
#include "render/line_painter.hpp"
#include "render/object_painter.hpp"
#include "render/renderer.hpp"
#include "render/room.hpp"
#include "render/surface_cloud.hpp"
#include "render/ui.hpp"

namespace armsreach::render {

class MapView {
 public:
  static Result<MapView> make(const Gl& gl);

  // Brings the pictures up to date.
  Status draw(const Scene& scene, ObjectPainter& objects, const LinePainter& lines,
              const Desk& desk);
  // Places them on the desk's picture, and what moves with every frame over them: camera, trails.
  void compose(const Scene& scene, const LinePainter& lines, const Framebuffer& target,
               const Desk& desk) const;
  // Round corners, titles and scale bars.
  void draw_frames(ImDrawList& list, const Fonts& fonts, const Desk& desk) const;
  // Turns (left drag), moves (right drag) and zooms (wheel) the orbiting view; a left click that
  // does not drag is returned with its ray, from any of the four views.
  std::optional<ViewClick> handle_mouse(const InputState& input, const Desk& desk);
  // The ray through a pixel of one of the four views as it is drawn now; nothing for others.
  std::optional<Ray> ray(ViewKind kind, const Eigen::Vector2d& pixel) const;

 private:
  // A view's surface, ground and objects, and what was known when they were drawn.
  struct Picture {
    ViewKind kind = ViewKind::map;
    Framebuffer framebuffer;
    View view;
    double time = 0;  // s, of the scene
    std::uint64_t revision = 0;
    Eigen::AlignedBox3d box;
    std::size_t points = 0;
    bool stale = true;  // to be drawn whatever the time: new, or moved by the person
  };

  void take_over(const Scene& scene);
  void follow(const Scene& scene);
  View view_for(ViewKind kind, int width, int height) const;
  double patience(const Picture& picture) const;
  Picture* next_due(const Scene& scene);
  void draw_picture(Picture& picture, const Scene& scene, ObjectPainter& objects,
                    const LinePainter& lines);

  const Gl* gl_ = nullptr;
  SurfaceCloud cloud_;
  std::optional<RoomFromWorld> room_;
  bool room_is_guess_ = true;
  Framing framing_;
  Orbit orbit_;
  std::array<Picture, 4> pictures_;
  std::uint64_t surface_revision_ = 0;
  std::vector<VirtualObject> objects_;  // as drawn

  struct Drag {
    ViewKind view = ViewKind::map;
    Eigen::Vector2f start{0, 0};
    Eigen::Vector2f last{0, 0};
    int button = 0;
    bool moved = false;
  };
  std::optional<Drag> drag_;
};

// Covers a view's corners with the desk. (Drawing the view as a rounded image would cost a software
// rasteriser more than drawing the view.)
void round_corners(ImDrawList& list, const Rectangle& place);

}  // namespace armsreach::render
