// The Utah teapot: Martin Newell's 32 bicubic Bezier patches of 1975, 16 one-based indices each
// into a list of control points; units are his, the knob's top at z = 3.15.
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string_view>
#include <vector>

#include <Eigen/Geometry>

#include "render/assets.hpp"
#include "render/mesh.hpp"

namespace armsreach::render {
namespace {

using Eigen::Vector3f;
using Patch = std::array<Vector3f, 16>;

constexpr float kNewellHeight = 3.15F;

// Reads the next number and steps over the separator after it.
template <class T>
T next(std::string_view& text) {
  while (!text.empty() && (text.front() == ',' || text.front() == '\n' || text.front() == '\r'))
    text.remove_prefix(1);
  T value{};
  const auto parsed = std::from_chars(text.data(), text.data() + text.size(), value);
  text.remove_prefix(static_cast<std::size_t>(parsed.ptr - text.data()));
  return value;
}

std::vector<Patch> newell_patches() {
  std::string_view text = asset("meshes/teapot.newell.txt");
  std::vector<std::array<std::size_t, 16>> indices(next<std::size_t>(text));
  for (auto& patch : indices) {
    for (auto& index : patch) index = next<std::size_t>(text);
  }
  std::vector<Vector3f> points(next<std::size_t>(text));
  for (Vector3f& point : points) {
    for (int i = 0; i < 3; ++i) point[i] = next<float>(text);
  }
  std::vector<Patch> patches(indices.size());
  for (std::size_t p = 0; p < patches.size(); ++p) {
    for (std::size_t i = 0; i < 16; ++i) patches[p][i] = points[indices[p][i] - 1];
  }
  return patches;
}

struct Bernstein {
  std::array<float, 4> value;
  std::array<float, 4> derivative;
};

Bernstein bernstein(float t) {
  const float s = 1 - t;
  return {{s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t},
          {-3 * s * s, 3 * s * (s - 2 * t), 3 * t * (2 * s - t), 3 * t * t}};
}

Vector3f sum(const Patch& patch, const std::array<float, 4>& u, const std::array<float, 4>& v) {
  Vector3f point = Vector3f::Zero();
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) point += u[i] * v[j] * patch[4 * i + j];
  }
  return point;
}

// Newell's patches have u x v inwards.
Vector3f unscaled_normal(const Patch& patch, float u, float v) {
  const Bernstein bu = bernstein(u);
  const Bernstein bv = bernstein(v);
  return sum(patch, bu.value, bv.derivative).cross(sum(patch, bu.derivative, bv.value));
}

// Where an edge of the patch shrinks to a point (the lid's top, the bottom's middle) one derivative
// vanishes; the limit of the normal is found a little inside.
Vector3f normal_at(const Patch& patch, float u, float v) {
  Vector3f normal = unscaled_normal(patch, u, v);
  if (normal.norm() < 1e-3F) {
    const float inset = 1e-2F;
    normal =
        unscaled_normal(patch, std::clamp(u, inset, 1 - inset), std::clamp(v, inset, 1 - inset));
  }
  return normal.normalized();
}

void add_patch(Mesh& mesh, const Patch& patch, int divisions, float scale) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  const auto side = static_cast<std::uint32_t>(divisions + 1);
  for (int i = 0; i <= divisions; ++i) {
    for (int j = 0; j <= divisions; ++j) {
      const float u = static_cast<float>(i) / static_cast<float>(divisions);
      const float v = static_cast<float>(j) / static_cast<float>(divisions);
      const Vector3f position = scale * sum(patch, bernstein(u).value, bernstein(v).value);
      mesh.vertices.push_back({position, normal_at(patch, u, v)});
    }
  }
  for (std::uint32_t i = 0; i + 1 < side; ++i) {
    for (std::uint32_t j = 0; j + 1 < side; ++j) {
      const std::uint32_t a = first + i * side + j;
      mesh.append_triangle(a, a + side + 1, a + side);
      mesh.append_triangle(a, a + 1, a + side + 1);
    }
  }
}

// Lids the openings (under the lid's edge, in the spout) from inside, in Newell's units: a dark
// disc facing up. Without them one would see through the pot, whose inner faces are not drawn.
void add_stopper(Mesh& mesh, const Vector3f& centre, float radius_x, float radius_y, float scale) {
  const std::array<std::uint8_t, 4> dark{132, 110, 94, 255};
  const int corners = 24;
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (int i = 0; i < corners; ++i) {
    const float angle = 2 * std::numbers::pi_v<float> * static_cast<float>(i) / corners;
    const Vector3f corner(radius_x * std::cos(angle), radius_y * std::sin(angle), 0);
    mesh.vertices.push_back({scale * (centre + corner), Vector3f::UnitZ(), dark});
  }
  for (std::uint32_t i = 1; i + 1 < corners; ++i)
    mesh.append_triangle(first, first + i, first + i + 1);
}

}  // namespace

Mesh make_teapot(float height, int divisions) {
  const float scale = height / kNewellHeight;
  Mesh teapot;
  for (const Patch& patch : newell_patches()) add_patch(teapot, patch, divisions, scale);
  for (Vertex& vertex : teapot.vertices) vertex.color = {240, 222, 200, 255};
  add_stopper(teapot, {0, 0, 2.38F}, 1.41F, 1.41F, scale);
  add_stopper(teapot, {3.0F, 0, 2.37F}, 0.2F, 0.12F, scale);
  return teapot;
}

}  // namespace armsreach::render
