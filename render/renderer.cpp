#include "render/renderer.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <opencv2/imgproc.hpp>

#include "render/annotations.hpp"
#include "render/desk.hpp"
#include "render/live_view.hpp"
#include "render/map_view.hpp"
#include "render/panels.hpp"
#include "render/ui.hpp"

namespace armsreach::render {
namespace {

bool inside(const Rectangle& r, const Eigen::Vector2f& p) {
  return p.x() >= static_cast<float>(r.x) && p.y() >= static_cast<float>(r.y) &&
         p.x() < static_cast<float>(r.x + r.width) && p.y() < static_cast<float>(r.y + r.height);
}

// From a mouse position, which counts pixel edges, to pixel centres within a rectangle.
Eigen::Vector2d within(const Rectangle& r, const Eigen::Vector2f& mouse) {
  return {static_cast<double>(mouse.x()) - r.x - 0.5, static_cast<double>(mouse.y()) - r.y - 0.5};
}

class SceneRenderer final : public Renderer {
 public:
  SceneRenderer(Context& context, const RendererOptions& options)
      : context_(context), options_(options) {}

  Status open() {
    const Gl& gl = context_.gl();
    auto ui = Ui::make(gl);
    if (!ui) return ui.error();
    ui_.emplace(*std::move(ui));
    notes_ = ui_->notes();
    auto objects = ObjectPainter::make(gl);
    if (!objects) return objects.error();
    objects_ = *std::move(objects);
    auto lines = LinePainter::make(gl);
    if (!lines) return lines.error();
    lines_ = *std::move(lines);
    auto live = LiveView::make(gl, {.samples = options_.samples});
    if (!live) return live.error();
    live_ = *std::move(live);
    auto map = MapView::make(gl);
    if (!map) return map.error();
    map_ = *std::move(map);
    return resize(options_.width, options_.height);
  }

  Requests draw(const Scene& scene, const InputState& input) override {
    handle_keys(input);
    Requests requests =
        options_.layout == Layout::wearer ? draw_wearer(scene, input) : draw_desk(scene, input);
    requests.delete_selected |= delete_pressed(input);
    if (context_.kind() == ContextKind::window) show_in_window();
    return requests;
  }

  Status resize(int width, int height) override {
    options_.width = width;
    options_.height = height;
    return resized(picture_, width, height);
  }

  void set_layout(Layout layout) override { options_.layout = layout; }
  Layout layout() const override { return options_.layout; }
  std::optional<Ray> map_ray(ViewKind view, const Eigen::Vector2d& pixel) const override {
    return options_.layout == Layout::operator_desk ? map_.ray(view, pixel) : std::nullopt;
  }
  void show_inliers(bool shown) override { choices_.show_inliers = shown; }
  std::vector<std::string> take_notes() override { return std::exchange(notes_, {}); }

  cv::Mat read_picture() override {
    rgba_.create(picture_.height(), picture_.width(), CV_8UC4);
    picture_.read(GL_RGBA, GL_UNSIGNED_BYTE, rgba_.data);
    cv::Mat bgr;
    cv::cvtColor(rgba_, bgr, cv::COLOR_RGBA2BGR);
    return bgr;
  }

 private:
  Status resized(Framebuffer& framebuffer, int width, int height) {
    if (framebuffer.width() == width && framebuffer.height() == height) return ok();
    auto made = Framebuffer::make(context_.gl(), {.width = width, .height = height});
    if (!made) return made.error();
    framebuffer = *std::move(made);
    return ok();
  }

  void handle_keys(const InputState& input) {
    for (const KeyPress& press : input.keys) {
      if (press.key == Key::tab)
        options_.layout =
            options_.layout == Layout::wearer ? Layout::operator_desk : Layout::wearer;
      if (press.key == Key::escape) choices_.insert.clear();
    }
  }

  static bool delete_pressed(const InputState& input) {
    return std::any_of(input.keys.begin(), input.keys.end(),
                       [](const KeyPress& press) { return press.key == Key::del; });
  }

  // A failed view (out of memory for its buffers) leaves its place dark and says why, once.
  void note_failure(const Status& status) {
    if (status || status.error().message() == last_failure_) return;
    last_failure_ = status.error().message();
    notes_.push_back(last_failure_);
  }

  Requests draw_wearer(const Scene& scene, const InputState& input) {
    live_.show_inliers(choices_.show_inliers);
    note_failure(live_.draw(scene, objects_, lines_, picture_));
    const View view = live_view_of(scene, options_.width, options_.height);
    picture_.bind();
    ui_->begin(input, options_.width, options_.height);
    draw_annotations(*ImGui::GetBackgroundDrawList(), ui_->fonts(), scene, view, {0, 0});
    draw_wearer_overlay(ui_->fonts(), scene, image_rectangle(view));
    ui_->end_and_draw();
    Requests requests;
    if (input.clicked[0])
      add_live_click(scene, view, {0, 0, options_.width, options_.height}, input, requests);
    return requests;
  }

  void add_live_click(const Scene& scene, const View& view, const Rectangle& place,
                      const InputState& input, Requests& requests) const {
    const Eigen::Vector2d pixel = camera_pixel_from_target(view, within(place, input.mouse));
    if (!view.camera.contains(pixel)) return;
    requests.clicks.push_back({ViewKind::live, pixel, ray_through(scene, pixel), choices_.insert});
  }

  Requests draw_desk(const Scene& scene, const InputState& input) {
    const Gl& gl = context_.gl();
    const View shape = live_view_of(scene, options_.width, options_.height);
    const Desk desk = desk_for(options_.width, options_.height,
                               static_cast<double>(shape.camera.width) / shape.camera.height);
    live_.show_inliers(choices_.show_inliers);
    note_failure(resized(live_picture_, desk.live.width, desk.live.height));
    note_failure(live_.draw(scene, objects_, lines_, live_picture_));
    note_failure(map_.draw(scene, objects_, lines_, desk));

    picture_.bind();
    const Eigen::Vector4f background = theme::rgba(theme::kDesk);
    gl.ClearColor(background.x(), background.y(), background.z(), 1);
    gl.Clear(GL_COLOR_BUFFER_BIT);
    live_picture_.copy_to(picture_, desk.live.x, desk.live.y);
    map_.compose(scene, lines_, picture_, desk);
    picture_.bind();
    ui_->begin(input, options_.width, options_.height);
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    draw_header(ui_->fonts(), scene, desk.header);
    map_.draw_frames(list, ui_->fonts(), desk);
    draw_messages(list, ui_->fonts(), scene, desk.map);
    round_corners(list, desk.live);
    draw_annotations(list, ui_->fonts(), scene,
                     live_view_of(scene, desk.live.width, desk.live.height),
                     {static_cast<float>(desk.live.x), static_cast<float>(desk.live.y)});
    const Presses presses = draw_side_panel(ui_->fonts(), scene, desk.panel, choices_);
    const bool over_panel = ImGui::GetIO().WantCaptureMouse;
    ui_->end_and_draw();

    Requests requests;
    requests.delete_selected = presses.delete_selected;
    if (presses.wearer_layout) options_.layout = Layout::wearer;
    if (over_panel) return requests;
    if (input.clicked[0] && inside(desk.live, input.mouse))
      add_live_click(scene, live_view_of(scene, desk.live.width, desk.live.height), desk.live,
                     input, requests);
    if (auto click = map_.handle_mouse(input, desk)) {
      click->insert = choices_.insert;
      requests.clicks.push_back(*click);
    }
    return requests;
  }

  // The only flip there is: a window's row 0 is its lower edge.
  void show_in_window() {
    const Gl& gl = context_.gl();
    const int width = context_.width();
    const int height = context_.height();
    gl.BindFramebuffer(GL_READ_FRAMEBUFFER, picture_.resolved_id());
    gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
    gl.BlitFramebuffer(0, 0, picture_.width(), picture_.height(), 0, height, width, 0,
                       GL_COLOR_BUFFER_BIT, GL_LINEAR);
    context_.swap();
  }

  Context& context_;
  RendererOptions options_;
  std::optional<Ui> ui_;
  ObjectPainter objects_;
  LinePainter lines_;
  LiveView live_;
  MapView map_;
  Framebuffer picture_;
  Framebuffer live_picture_;
  Choices choices_;
  cv::Mat rgba_;
  std::vector<std::string> notes_;
  std::string last_failure_;
};

}  // namespace

Result<std::unique_ptr<Renderer>> Renderer::make(Context& context, const RendererOptions& options) {
  auto renderer = std::make_unique<SceneRenderer>(context, options);
  if (const Status opened = renderer->open(); !opened) return opened.error();
  return std::unique_ptr<Renderer>(std::move(renderer));
}

std::optional<Ray> ray_through(const Scene& scene, const Eigen::Vector2d& pixel) {
  if (!scene.pose_known) return std::nullopt;
  return Ray{scene.world_from_camera.translation(),
             scene.world_from_camera.rotation() * unproject(scene.camera, pixel).normalized()};
}

}  // namespace armsreach::render
