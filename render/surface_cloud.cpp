#include "render/surface_cloud.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>

namespace armsreach::render {
namespace {

static_assert(sizeof(SurfacePoint) == 16, "surface points are uploaded as they are");

// Below this many pixels an element's neighbours cover it, and points are left out instead.
constexpr float kFinestPoint = 2;

// The points in an order whose every beginning is spread over the block.
std::vector<SurfacePoint> spread(const std::vector<SurfacePoint>& points) {
  const std::size_t n = points.size();
  std::vector<SurfacePoint> result;
  result.reserve(n);
  // Steps of the golden section fall between all earlier ones; the step must not divide n.
  std::size_t step =
      std::max<std::size_t>(1, static_cast<std::size_t>(0.618 * static_cast<double>(n)));
  while (std::gcd(step, n) != 1) ++step;
  for (std::size_t i = 0, at = 0; i < n; ++i, at = (at + step) % n) result.push_back(points[at]);
  return result;
}

float px_per_metre(const View& view, float z) {
  const float px = static_cast<float>(view.camera.fx * view.target_scale.x());
  return view.orthographic ? px : px / std::max(z, static_cast<float>(view.near));
}

// Whether a sphere may be seen; its pixels are compared with the target's, generously.
bool seen(const View& view, const Eigen::Vector3f& centre_in_camera, float radius) {
  const float z = centre_in_camera.z();
  if (!view.orthographic && z < -radius) return false;
  if (!view.orthographic && z < 2 * radius) return true;
  const float px = px_per_metre(view, z);
  const Eigen::Vector2f centre(static_cast<float>(view.camera.cx),
                               static_cast<float>(view.camera.cy));
  const Eigen::Vector2f at = px * centre_in_camera.head<2>() + centre;
  const float margin = 1.5F * px * radius;
  return at.x() > -margin && at.y() > -margin &&
         at.x() < static_cast<float>(view.camera.width) + margin &&
         at.y() < static_cast<float>(view.camera.height) + margin;
}

}  // namespace

Result<SurfaceCloud> SurfaceCloud::make(const Gl& gl) {
  auto program = Program::from_assets(
      gl, {"shaders/target.glsl", "shaders/view.glsl", "shaders/surface.vert.glsl"},
      {"shaders/surface.frag.glsl"});
  if (!program) return program.error();
  SurfaceCloud cloud;
  cloud.gl_ = &gl;
  cloud.program_ = *std::move(program);
  cloud.array_ = VertexArray(gl);
  cloud.grow(1U << 16);
  return cloud;
}

void SurfaceCloud::describe_points() const {
  array_.bind();
  points_.bind(GL_ARRAY_BUFFER);
  const auto attribute = [this](GLuint index, GLint size, GLenum type, GLboolean normalised,
                                std::size_t offset) {
    gl_->EnableVertexAttribArray(index);
    gl_->VertexAttribPointer(index, size, type, normalised, sizeof(SurfacePoint),
                             reinterpret_cast<const void*>(offset));
  };
  attribute(0, 3, GL_FLOAT, GL_FALSE, offsetof(SurfacePoint, point_in_world));
  attribute(1, 3, GL_BYTE, GL_TRUE, offsetof(SurfacePoint, normal));
  attribute(2, 1, GL_UNSIGNED_BYTE, GL_TRUE, offsetof(SurfacePoint, intensity));
}

void SurfaceCloud::grow(std::uint32_t points) {
  Buffer larger(*gl_);
  larger.bind(GL_COPY_WRITE_BUFFER);
  gl_->BufferData(GL_COPY_WRITE_BUFFER, static_cast<GLsizeiptr>(points * sizeof(SurfacePoint)),
                  nullptr, GL_DYNAMIC_DRAW);
  if (used_ > 0) {
    points_.bind(GL_COPY_READ_BUFFER);
    gl_->CopyBufferSubData(GL_COPY_READ_BUFFER, GL_COPY_WRITE_BUFFER, 0, 0,
                           static_cast<GLsizeiptr>(used_ * sizeof(SurfacePoint)));
  }
  points_ = std::move(larger);
  capacity_ = points;
  describe_points();
}

GLint SurfaceCloud::allocate(std::uint32_t capacity) {
  std::vector<GLint>& given_back = free_[capacity];
  if (!given_back.empty()) {
    const GLint first = given_back.back();
    given_back.pop_back();
    return first;
  }
  if (used_ + capacity > capacity_) grow(std::max(2 * capacity_, used_ + capacity));
  const GLint first = static_cast<GLint>(used_);
  used_ += capacity;
  return first;
}

void SurfaceCloud::fill(Slot& slot, const SurfaceBlockPtr& block) {
  slot.block = block;
  const auto count = static_cast<std::uint32_t>(block->points.size());
  if (count > slot.capacity) {
    if (slot.capacity > 0) free_[slot.capacity].push_back(slot.first);
    slot.capacity = std::bit_ceil(std::max(count, 32U));
    slot.first = allocate(slot.capacity);
  }
  if (count == 0) return;
  Eigen::AlignedBox3f box;
  for (const SurfacePoint& point : block->points) box.extend(point.point_in_world);
  slot.centre = box.center();
  slot.radius = 0.5F * box.diagonal().norm() + block->size;
  const std::vector<SurfacePoint> points = spread(block->points);
  points_.bind(GL_ARRAY_BUFFER);
  gl_->BufferSubData(
      GL_ARRAY_BUFFER,
      static_cast<GLintptr>(slot.first) * static_cast<GLintptr>(sizeof(SurfacePoint)),
      static_cast<GLsizeiptr>(count * sizeof(SurfacePoint)), points.data());
}

std::size_t SurfaceCloud::update(const Surface& surface) {
  std::size_t uploaded = 0;
  std::map<std::array<int, 3>, Slot> kept;
  for (const SurfaceBlockPtr& block : surface.blocks) {
    auto slot = slots_.extract(block->key);
    if (slot.empty()) slot = decltype(kept)({{block->key, Slot{}}}).extract(block->key);
    if (slot.mapped().block != block) {
      fill(slot.mapped(), block);
      uploaded += block->points.size();
    }
    kept.insert(std::move(slot));
  }
  for (const auto& [key, slot] : slots_) free_[slot.capacity].push_back(slot.first);
  slots_ = std::move(kept);
  return uploaded;
}

void SurfaceCloud::draw(const View& view, const Eigen::Vector3f& light_in_camera) const {
  if (slots_.empty()) return;
  const Eigen::Matrix4f camera_from_world = view.world_from_camera.inverse().matrix().cast<float>();
  std::vector<GLint> firsts;
  std::vector<GLsizei> counts;
  for (const auto& [key, slot] : slots_) {
    if (slot.block->points.empty()) continue;
    const Eigen::Vector3f centre =
        camera_from_world.topLeftCorner<3, 3>() * slot.centre + camera_from_world.col(3).head<3>();
    if (!seen(view, centre, slot.radius)) continue;
    const float element = slot.block->size * px_per_metre(view, centre.z() - slot.radius);
    const float share = std::min(1.F, element * element / (kFinestPoint * kFinestPoint));
    const float count = std::ceil(share * static_cast<float>(slot.block->points.size()));
    firsts.push_back(slot.first);
    counts.push_back(static_cast<GLsizei>(count));
  }
  program_.use();
  set_view(program_, view);
  program_.set("element_size", slots_.begin()->second.block->size);
  program_.set("finest_point", kFinestPoint);
  program_.set("light_in_camera", light_in_camera);
  array_.bind();
  gl_->Enable(GL_PROGRAM_POINT_SIZE);
  gl_->MultiDrawArrays(GL_POINTS, firsts.data(), counts.data(),
                       static_cast<GLsizei>(firsts.size()));
  gl_->Disable(GL_PROGRAM_POINT_SIZE);
}

}  // namespace armsreach::render
