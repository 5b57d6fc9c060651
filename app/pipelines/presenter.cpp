#include "app/pipelines/presenter.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <system_error>

namespace armsreach::app {
namespace {

namespace fs = std::filesystem;

render::ContextKind kind_from_name(const std::string& name) {
  if (name == "window") return render::ContextKind::window;
  if (name == "egl") return render::ContextKind::egl;
  if (name == "osmesa") return render::ContextKind::osmesa;
  return render::ContextKind::automatic;
}

render::ViewKind view_from_name(const std::string& name) {
  if (name == "map") return render::ViewKind::map;
  if (name == "top") return render::ViewKind::top;
  if (name == "front") return render::ViewKind::front;
  if (name == "side") return render::ViewKind::side;
  return render::ViewKind::live;
}

UserInput user_input(const render::Requests& requests) {
  UserInput user;
  for (const render::ViewClick& click : requests.clicks) {
    if (click.ray_in_world) user.clicks.push_back({*click.ray_in_world, click.insert});
  }
  user.delete_selected = requests.delete_selected;
  return user;
}

}  // namespace

render::Layout layout_from_name(const std::string& name) {
  return name == "operator" ? render::Layout::operator_desk : render::Layout::wearer;
}

Result<std::unique_ptr<Presenter>> Presenter::make(const PresenterOptions& options) {
  std::unique_ptr<Presenter> presenter(new Presenter(options));
  std::stable_sort(presenter->options_.actions.begin(), presenter->options_.actions.end(),
                   [](const Action& a, const Action& b) { return a.frame < b.frame; });
  if (options.display != "none") {
    render::ContextOptions context_options;
    context_options.kind = kind_from_name(options.display);
    context_options.width = options.width;
    context_options.height = options.height;
    auto context = render::make_context(context_options);
    if (!context) return context.error();
    presenter->context_ = std::move(*context);
    render::RendererOptions renderer_options;
    renderer_options.width = options.width;
    renderer_options.height = options.height;
    renderer_options.layout = options.layout;
    auto renderer = render::Renderer::make(*presenter->context_, renderer_options);
    if (!renderer) return renderer.error();
    presenter->renderer_ = std::move(*renderer);
  } else if (!options.record.empty() || !options.screenshots.empty()) {
    return Error{"--record and --screenshots need something that draws", "--display none",
                 "use --display egl or leave --display away"};
  }
  if (auto status = presenter->make_picture_keepers(); !status) return status.error();
  return presenter;
}

Status Presenter::make_picture_keepers() {
  if (!options_.screenshots.empty()) {
    std::error_code error;
    fs::create_directories(options_.screenshots, error);
    if (error) return Error{error.message(), options_.screenshots, "give a folder that is yours"};
  }
  if (options_.record.empty()) return ok();
  render::RecordingOptions recording;
  recording.file = options_.record;
  recording.width = options_.width;
  recording.height = options_.height;
  recording.rate = options_.rate;
  recording.pace =
      options_.may_drop ? render::RecordingPace::live : render::RecordingPace::every_frame;
  auto recorder = render::Recorder::open(recording);
  if (!recorder) return recorder.error();
  recorder_ = std::move(*recorder);
  return ok();
}

Result<UserInput> Presenter::present(const render::Scene& scene) {
  UserInput user;
  if (renderer_) {
    user = user_input(renderer_->draw(scene, input_for_picture()));
    for (const std::string& note : renderer_->take_notes()) {
      user.faults.push_back({"drawing", note, "see 'Displays' in the README"});
    }
  }
  const bool fresh = scene.frame != last_drawn_;
  last_drawn_ = scene.frame;
  if (!fresh) return user;
  add_actions(scene, &user);
  if (auto status = keep_picture(scene); !status) return status.error();
  return user;
}

// A window's picture takes the window's size, unless it is filmed: then it keeps its own and the
// mouse is brought to it.
render::InputState Presenter::input_for_picture() {
  render::InputState input = context_->poll_input();
  if (!interactive() || context_->width() == 0 || context_->height() == 0) return input;
  if (!recorder_ && options_.screenshots.empty() &&
      (context_->width() != options_.width || context_->height() != options_.height)) {
    if (renderer_->resize(context_->width(), context_->height())) {
      options_.width = context_->width();
      options_.height = context_->height();
    }
  }
  input.mouse.x() *= static_cast<float>(options_.width) / static_cast<float>(context_->width());
  input.mouse.y() *= static_cast<float>(options_.height) / static_cast<float>(context_->height());
  return input;
}

// An action is a click that nobody had to make: from here on nothing tells the two apart. Live, one
// whose own frame was skipped is done on the next.
void Presenter::add_actions(const render::Scene& scene, UserInput* user) {
  for (; next_action_ < options_.actions.size(); ++next_action_) {
    const Action& action = options_.actions[next_action_];
    if (action.frame > scene.frame) break;
    if (!action.layout.empty()) {
      if (renderer_) renderer_->set_layout(layout_from_name(action.layout));
      continue;
    }
    const render::ViewKind view = view_from_name(action.view);
    const auto ray = view == render::ViewKind::live ? render::ray_through(scene, action.click)
                     : renderer_                    ? renderer_->map_ray(view, action.click)
                                                    : std::nullopt;
    if (ray) {
      user->clicks.push_back({*ray, action.insert});
    } else {
      user->faults.push_back({"actions",
                              "the click at frame " + std::to_string(action.frame) +
                                  " met no view '" + action.view + "'",
                              "the map's views need layout: operator, the live view a known pose"});
    }
  }
}

Status Presenter::keep_picture(const render::Scene& scene) {
  const bool due = !options_.screenshots.empty() && scene.frame % options_.screenshot_every == 0;
  if (recorder_) {
    if (auto status =
            recorder_->write(renderer_->read_picture(), timestamp_from_seconds(scene.time));
        !status)
      return status;
  }
  return due ? save_screenshot(scene.frame) : ok();
}

Status Presenter::save_screenshot(std::int64_t frame) {
  char name[40];
  std::snprintf(name, sizeof name, "frame_%06lld.png", static_cast<long long>(frame));
  const std::string path = (fs::path(options_.screenshots) / name).string();
  last_saved_ = frame;
  return render::write_png(path, renderer_->read_picture());
}

Status Presenter::close() {
  Status screenshot = ok();
  if (!options_.screenshots.empty() && last_drawn_ >= 0 && last_drawn_ != last_saved_) {
    screenshot = save_screenshot(last_drawn_);
  }
  if (recorder_) {
    const SoundTrack sounds = options_.film_sounds ? options_.film_sounds() : SoundTrack{};
    if (auto film = recorder_->close(sounds); !film) return film.error();
  }
  return screenshot;
}

bool Presenter::interactive() const {
  return context_ && context_->kind() == render::ContextKind::window;
}
bool Presenter::should_close() const { return context_ && context_->should_close(); }
void Presenter::wait() { context_->wait(); }
void Presenter::wake() { context_->wake(); }
std::int64_t Presenter::dropped_film_frames() const { return recorder_ ? recorder_->dropped() : 0; }

}  // namespace armsreach::app
