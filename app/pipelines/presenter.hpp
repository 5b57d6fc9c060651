// Shows composed scenes: on a window or off screen, as screenshots and as a film. Owns the graphics
// context, so it lives on the thread that made it.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "app/pipelines/composer.hpp"
#include "app/session/config.hpp"
#include "render/context.hpp"
#include "render/recorder.hpp"
#include "render/renderer.hpp"
#include "vision/core/sound.hpp"

namespace armsreach::app {

render::Layout layout_from_name(const std::string& name);  // "wearer" or "operator"

struct PresenterOptions {
  std::string display = "auto";  // auto, window, egl, osmesa, none
  render::Layout layout = render::Layout::wearer;
  int width = 640;  // px of the picture
  int height = 480;
  std::string record;         // mp4 file, or ""
  std::string screenshots;    // folder, or ""
  int screenshot_every = 30;  // frames; the last one is always kept
  double rate = 30;           // Hz of the film
  bool may_drop = false;      // live: rather lose a frame of the film than wait for the encoder
  std::function<SoundTrack()> film_sounds;  // asked at the end for the film's sound track
  std::vector<Action> actions;
};

class Presenter {
 public:
  static Result<std::unique_ptr<Presenter>> make(const PresenterOptions& options);

  // Draws and keeps what was asked for; returns what the person (or an action) did meanwhile.
  Result<UserInput> present(const render::Scene& scene);
  // Screenshot of the last scene, end of the film.
  Status close();

  // Only a window has a person in front of it.
  bool interactive() const;
  bool should_close() const;
  void wait();  // for a person or for wake()
  void wake();  // from any thread
  std::int64_t dropped_film_frames() const;

 private:
  explicit Presenter(const PresenterOptions& options) : options_(options) {}
  Status make_picture_keepers();
  render::InputState input_for_picture();
  void add_actions(const render::Scene& scene, UserInput* user);
  Status keep_picture(const render::Scene& scene);
  Status save_screenshot(std::int64_t frame);

  PresenterOptions options_;
  std::unique_ptr<render::Context> context_;    // null with display none
  std::unique_ptr<render::Renderer> renderer_;  // null with display none
  std::unique_ptr<render::Recorder> recorder_;  // null without --record
  std::size_t next_action_ = 0;
  std::int64_t last_drawn_ = -1;
  std::int64_t last_saved_ = -1;
};

}  // namespace armsreach::app
