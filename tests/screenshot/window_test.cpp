// A window, under a virtual X server of the test's own.
#include <array>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <string>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "render/context.hpp"
#include "render/renderer.hpp"
#include "tests/screenshot/golden.hpp"
#include "tests/screenshot/tiny_world.hpp"

namespace armsreach::render::test {
namespace {

// Runs Xvfb on a display number it chooses itself.
class VirtualDisplay {
 public:
  VirtualDisplay() {
    std::array<int, 2> pipe_ends{};
    if (pipe(pipe_ends.data()) != 0) return;
    server_ = fork();
    if (server_ == 0) {
      close(pipe_ends[0]);
      const int nowhere = open("/dev/null", O_WRONLY);
      dup2(nowhere, STDERR_FILENO);
      const std::string fd = std::to_string(pipe_ends[1]);
      execlp("Xvfb", "Xvfb", "-displayfd", fd.c_str(), "-screen", "0", "1024x768x24", "-nolisten",
             "tcp", nullptr);
      _exit(127);
    }
    close(pipe_ends[1]);
    std::string number;
    char digit = 0;
    while (read(pipe_ends[0], &digit, 1) == 1 && digit != '\n') number += digit;
    close(pipe_ends[0]);
    if (!number.empty()) setenv("DISPLAY", (":" + number).c_str(), 1);
    running_ = !number.empty();
  }
  ~VirtualDisplay() {
    if (server_ <= 0) return;
    kill(server_, SIGTERM);
    waitpid(server_, nullptr, 0);
    unsetenv("DISPLAY");
  }
  VirtualDisplay(const VirtualDisplay&) = delete;
  VirtualDisplay& operator=(const VirtualDisplay&) = delete;

  bool running() const { return running_; }

 private:
  pid_t server_ = -1;
  bool running_ = false;
};

TEST(Window, ShowsTheSamePictureAsWithoutOneAndUpright) {
  const VirtualDisplay display;
  if (!display.running()) GTEST_SKIP() << "install xvfb to test windows";
  auto context = make_context({.kind = ContextKind::automatic, .width = 640, .height = 480});
  ASSERT_TRUE(context.ok()) << context.error().message();
  ASSERT_EQ((*context)->kind(), ContextKind::window);
  auto renderer = Renderer::make(**context, {.width = 640, .height = 480});
  ASSERT_TRUE(renderer.ok()) << renderer.error().message();
  Scene scene = tiny_scene(pinhole(640, 480, 500, 500, 319.5, 239.5), world_from_viewer());
  scene.objects = {standing(1, "teapot", 0, 0)};
  EXPECT_FALSE((*context)->should_close());
  (*renderer)->draw(scene, (*context)->poll_input());
  const cv::Mat picture = (*renderer)->read_picture();

  // What the window shows, lower row first as OpenGL has windows.
  const Gl& gl = (*context)->gl();
  gl.BindFramebuffer(GL_READ_FRAMEBUFFER, 0);
  gl.ReadBuffer(GL_BACK);
  cv::Mat shown(480, 640, CV_8UC4);
  gl.ReadPixels(0, 0, 640, 480, GL_RGBA, GL_UNSIGNED_BYTE, shown.data);
  cv::flip(shown, shown, 0);
  cv::cvtColor(shown, shown, cv::COLOR_RGBA2BGR);
  EXPECT_LT(share_that_differs(shown, picture), 0.003);

  std::thread waker([&] { (*context)->wake(); });
  (*context)->wait();
  waker.join();
  renderer->reset();
  context->reset();

  auto headless = make_context({.kind = ContextKind::egl});
  ASSERT_TRUE(headless.ok()) << headless.error().message();
  auto without_window = Renderer::make(**headless, {.width = 640, .height = 480});
  ASSERT_TRUE(without_window.ok());
  (*without_window)->draw(scene, {});
  EXPECT_LT(share_that_differs((*without_window)->read_picture(), picture), 0.003);
}

}  // namespace
}  // namespace armsreach::render::test
