// Draws a Scene: the live view (video, overlays, virtual objects), the 3D map view, the
// orthographic views and the panels, laid out for a wearer or an operator; reads the picture back.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "render/context.hpp"
#include "render/input.hpp"
#include "render/mesh.hpp"
#include "render/scene.hpp"
#include "vision/core/result.hpp"
#include "vision/core/world_view.hpp"

namespace armsreach::render {

enum class Layout {
  wearer,         // the video fills the picture, letterboxed
  operator_desk,  // map view, live view, top/front/side views and panels
};

enum class ViewKind { live, map, top, front, side };

// A click that meant the scene and not a panel.
struct ViewClick {
  ViewKind view = ViewKind::live;
  Eigen::Vector2d pixel;            // live: pixel of the background image; else of the view
  std::optional<Ray> ray_in_world;  // nothing while the pose is unknown (live)
  std::string insert;               // the mesh chosen in the panel; empty: select or highlight
};

// What the person asked for during one frame.
struct Requests {
  std::vector<ViewClick> clicks;  // on the scene
  bool delete_selected = false;
};

struct RendererOptions {
  int width = 640;  // px, of the picture
  int height = 480;
  Layout layout = Layout::wearer;
  int samples = 4;  // MSAA of virtual objects in the live view
};

// Renderers of several contexts may exist, but draw from one thread at a time: the panels' library
// keeps its current context in a global.
class Renderer {
 public:
  // The context is current on this thread and outlives the renderer.
  static Result<std::unique_ptr<Renderer>> make(Context& context, const RendererOptions& options);
  virtual ~Renderer() = default;

  // Draws into an offscreen picture and, for a window, onto it. The input's mouse is in pixels of
  // the picture.
  virtual Requests draw(const Scene& scene, const InputState& input) = 0;
  virtual Status resize(int width, int height) = 0;
  virtual void set_layout(Layout layout) = 0;  // the person may change it as well (Tab)
  virtual Layout layout() const = 0;
  virtual void show_inliers(bool shown) = 0;  // tints what the tracker rejects
  // The ray through a pixel of a map view as it was drawn last; nothing while none is shown.
  virtual std::optional<Ray> map_ray(ViewKind view, const Eigen::Vector2d& pixel) const = 0;
  // What could not be had and was replaced, e.g. missing fonts; each once.
  virtual std::vector<std::string> take_notes() = 0;

  // The last picture, CV_8UC3 BGR, top row first; shared with nobody.
  virtual cv::Mat read_picture() = 0;
};

// The ray through a pixel of the scene's background image; nothing while the pose is unknown.
std::optional<Ray> ray_through(const Scene& scene, const Eigen::Vector2d& pixel);

}  // namespace armsreach::render
