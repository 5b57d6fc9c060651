// Contexts of both headless kinds: alike, side by side, on several threads.
#include "render/context.hpp"

#include <array>
#include <cstdint>
#include <cstdlib>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "render/gl_objects.hpp"
#include "render/view.hpp"

namespace armsreach::render {
namespace {

// Draws a triangle over the upper left half of an 8x8 picture and reads one pixel of each half.
std::array<int, 2> red_of_both_halves(const Gl& gl, int samples) {
  auto framebuffer = Framebuffer::make(gl, {.width = 8, .height = 8, .samples = samples});
  if (!framebuffer) return {-1, -1};
  auto program = Program::from_source(gl, "test", R"(#version 330 core
    void main() { gl_Position = vec4(gl_VertexID == 1, gl_VertexID == 2, 0.5, 0.5) * 2.0 - 1.0;
                  gl_Position.zw = vec2(0.0, 1.0); })",
                                      R"(#version 330 core
    out vec4 color; void main() { color = vec4(1.0, 0.0, 0.0, 1.0); })");
  if (!program) return {-1, -1};
  framebuffer->bind();
  gl.ClearColor(0, 0, 0, 1);
  gl.Clear(GL_COLOR_BUFFER_BIT);
  program->use();
  const VertexArray none(gl);
  none.bind();
  gl.DrawArrays(GL_TRIANGLES, 0, 3);
  framebuffer->resolve();
  std::vector<std::uint8_t> pixels(8 * 8 * 4);
  framebuffer->read(GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
  return {pixels[4 * (8 * 1 + 1)], pixels[4 * (8 * 6 + 6)]};
}

class HeadlessContextTest : public testing::TestWithParam<ContextKind> {};

TEST_P(HeadlessContextTest, DrawsAndReadsBackTopRowFirst) {
  auto context = make_context({.kind = GetParam(), .width = 320, .height = 240});
  ASSERT_TRUE(context.ok()) << context.error().message();
  EXPECT_EQ((*context)->width(), 320);
  for (const int samples : {0, 4}) {
    EXPECT_EQ(red_of_both_halves((*context)->gl(), samples), (std::array{255, 0}));
  }
}

TEST_P(HeadlessContextTest, BadShaderIsAnErrorWithTheCompilersWords) {
  auto context = make_context({.kind = GetParam()});
  ASSERT_TRUE(context.ok()) << context.error().message();
  auto program =
      Program::from_source((*context)->gl(), "broken", "#version 330 core\nvoid main() { x; }",
                           "#version 330 core\nvoid main() {}");
  ASSERT_FALSE(program.ok());
  EXPECT_NE(program.error().message().find("broken"), std::string::npos);
  EXPECT_NE(program.error().message().find("undeclared"), std::string::npos);
}

TEST_P(HeadlessContextTest, WakeEndsWait) {
  auto context = make_context({.kind = GetParam()});
  ASSERT_TRUE(context.ok()) << context.error().message();
  std::thread waker([&] { (*context)->wake(); });
  (*context)->wait();
  waker.join();
}

INSTANTIATE_TEST_SUITE_P(Kinds, HeadlessContextTest,
                         testing::Values(ContextKind::egl, ContextKind::osmesa),
                         [](const auto& kind) { return std::string(name(kind.param)); });

TEST(Context, BothKindsDrawAtOnceOnTheirOwnThreads) {
  std::array<std::array<int, 2>, 4> seen{};
  {
    std::vector<std::jthread> threads;
    for (std::size_t i = 0; i < seen.size(); ++i) {
      threads.emplace_back([&seen, i] {
        auto context = make_context({.kind = i % 2 ? ContextKind::egl : ContextKind::osmesa});
        if (!context) return;
        for (int k = 0; k < 5; ++k) seen[i] = red_of_both_halves((*context)->gl(), 4);
      });
    }
  }
  for (const auto& halves : seen) EXPECT_EQ(halves, (std::array{255, 0}));
}

TEST(Context, WindowWithoutADisplayIsAReadableError) {
  if (display_exists()) GTEST_SKIP() << "there is a display here";
  auto context = make_context({.kind = ContextKind::window});
  ASSERT_FALSE(context.ok());
  EXPECT_EQ(context.error().kind, Error::Kind::device);
  EXPECT_NE(context.error().message().find("DISPLAY"), std::string::npos);
  EXPECT_NE(context.error().message().find("--display egl"), std::string::npos);
}

TEST(Context, AutomaticIsHeadlessWithoutADisplay) {
  if (display_exists()) GTEST_SKIP() << "there is a display here";
  auto context = make_context({});
  ASSERT_TRUE(context.ok()) << context.error().message();
  EXPECT_EQ((*context)->kind(), ContextKind::egl);
}

}  // namespace
}  // namespace armsreach::render
