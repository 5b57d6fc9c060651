#include "render/surface_cloud.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <utility>

namespace armsreach::render {
namespace {

static_assert(sizeof(SurfacePoint) == 16, "surface points are uploaded as they are");

// Elements smaller than this many pixels are drawn as every second, fourth or eighth one, larger.
constexpr float kFinestPoint = 1.2F;
// With more, coarser levels are taken: a software rasteriser draws some 7 million points a second.
constexpr std::size_t kMostPoints = 160000;

// How often an element may be skipped: 3 when only every eighth element each way is drawn, 0 when
// all are. Elements are counted on the grid, along the two axes in which the surface extends there.
int coarsest_level(const SurfacePoint& point, float size) {
  int across = 0;  // the axis that the surface faces
  for (int i = 1; i < 3; ++i) {
    if (std::abs(point.normal[static_cast<std::size_t>(i)]) >
        std::abs(point.normal[static_cast<std::size_t>(across)]))
      across = i;
  }
  unsigned bits = 1U << (SurfaceCloud::kLevels - 1);
  for (int i = 0; i < 3; ++i) {
    if (i != across)
      bits |= static_cast<unsigned>(static_cast<int>(std::floor(point.point_in_world[i] / size)));
  }
  return std::countr_zero(bits);
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
  describe_vertices(*gl_, sizeof(SurfacePoint),
                    {{3, GL_FLOAT, false, offsetof(SurfacePoint, point_in_world)},
                     {3, GL_BYTE, true, offsetof(SurfacePoint, normal)},
                     {1, GL_UNSIGNED_BYTE, true, offsetof(SurfacePoint, intensity)}});
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
  // Coarser elements first: each level of detail is a beginning.
  std::array<std::vector<SurfacePoint>, kLevels> by_level;
  for (const SurfacePoint& point : block->points)
    by_level[static_cast<std::size_t>(coarsest_level(point, block->size))].push_back(point);
  std::vector<SurfacePoint> points;
  points.reserve(count);
  for (std::size_t level = kLevels; level-- > 0;) {
    points.insert(points.end(), by_level[level].begin(), by_level[level].end());
    slot.counts[level] = static_cast<GLsizei>(points.size());
  }
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

SurfaceCloud::Batches SurfaceCloud::batches(const View& view, float finest_point) const {
  const Eigen::Matrix4f camera_from_world = view.world_from_camera.inverse().matrix().cast<float>();
  Batches batches;
  for (const auto& [key, slot] : slots_) {
    if (slot.block->points.empty()) continue;
    const Eigen::Vector3f centre =
        camera_from_world.topLeftCorner<3, 3>() * slot.centre + camera_from_world.col(3).head<3>();
    if (!seen(view, centre, slot.radius)) continue;
    float element = slot.block->size * px_per_metre(view, centre.z() - slot.radius);
    std::size_t level = 0;
    for (; level + 1 < kLevels && element < finest_point; ++level) element *= 2;
    batches.firsts[level].push_back(slot.first);
    // At least one point: small blocks do not vanish, and Mesa 22 loses what follows an empty draw.
    batches.counts[level].push_back(std::max(slot.counts[level], 1));
    batches.points += static_cast<std::size_t>(batches.counts[level].back());
  }
  return batches;
}

std::size_t SurfaceCloud::draw(const View& view, const Eigen::Vector3f& light_in_camera) const {
  if (slots_.empty()) return 0;
  float finest_point = kFinestPoint;
  Batches drawn = batches(view, finest_point);
  while (drawn.points > kMostPoints && finest_point < 8 * kFinestPoint) {
    finest_point *= 1.25F;
    drawn = batches(view, finest_point);
  }
  program_.use();
  set_view(program_, view);
  program_.set("light_in_camera", light_in_camera);
  array_.bind();
  gl_->Enable(GL_PROGRAM_POINT_SIZE);
  const float size = slots_.begin()->second.block->size;
  for (std::size_t level = 0; level < kLevels; ++level) {
    if (drawn.firsts[level].empty()) continue;
    program_.set("element_size", size * static_cast<float>(1 << level));
    gl_->MultiDrawArrays(GL_POINTS, drawn.firsts[level].data(), drawn.counts[level].data(),
                         static_cast<GLsizei>(drawn.firsts[level].size()));
  }
  gl_->Disable(GL_PROGRAM_POINT_SIZE);
  return drawn.points;
}

}  // namespace armsreach::render
