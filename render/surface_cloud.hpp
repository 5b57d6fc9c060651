// The mapped surface in a context's memory: one buffer of points in which each block has its slot,
// so that only blocks that changed are uploaded, and drawing is one call.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include <Eigen/Geometry>

#include "render/gl_objects.hpp"
#include "render/scene.hpp"
#include "render/view.hpp"

namespace armsreach::render {

class SurfaceCloud {
 public:
  static Result<SurfaceCloud> make(const Gl& gl);

  // Takes over what is new; blocks whose pointer is the same are left alone. Returns the number of
  // points uploaded.
  std::size_t update(const Surface& surface);
  // Into the bound framebuffer, testing depth. Far blocks are drawn with fewer points.
  // `light_in_camera` points towards the light. Returns the number of points drawn.
  std::size_t draw(const View& view, const Eigen::Vector3f& light_in_camera) const;

  static constexpr std::size_t kLevels = 4;  // of detail

 private:
  struct Slot {
    SurfaceBlockPtr block;
    GLint first = 0;
    std::uint32_t capacity = 0;             // points
    std::array<GLsizei, kLevels> counts{};  // points to draw at each level; all at level 0
    Eigen::Vector3f centre{0, 0, 0};
    float radius = 0;
  };

  // What to draw of each level: the beginnings of slots.
  struct Batches {
    std::array<std::vector<GLint>, kLevels> firsts;
    std::array<std::vector<GLsizei>, kLevels> counts;
    std::size_t points = 0;
  };

  Batches batches(const View& view, float finest_point) const;
  GLint allocate(std::uint32_t capacity);
  void grow(std::uint32_t points);
  void describe_points() const;
  void fill(Slot& slot, const SurfaceBlockPtr& block);

  const Gl* gl_ = nullptr;
  Program program_;
  VertexArray array_;
  Buffer points_;
  std::uint32_t capacity_ = 0;                        // points
  std::uint32_t used_ = 0;                            // the buffer's end so far
  std::map<std::uint32_t, std::vector<GLint>> free_;  // slots given back, by capacity
  std::map<std::array<int, 3>, Slot> slots_;
};

}  // namespace armsreach::render
