#include "render/mesh.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include <Eigen/Geometry>

namespace armsreach::render {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;
using Color = std::array<std::uint8_t, 4>;

constexpr float kPi = 3.14159265F;

// A small side table that fits on a desk: a thick top on four legs.
Mesh make_table() {
  const Color top{196, 154, 108, 255};
  const Color leg{150, 112, 74, 255};
  const float height = 0.12F;
  const float board = 0.014F;
  Mesh table = make_box({0, 0, height - board}, {0.22F, 0.15F, board}, top);
  for (const float x : {-0.096F, 0.096F}) {
    for (const float y : {-0.061F, 0.061F}) {
      table.append(make_box({x, y, 0}, {0.014F, 0.014F, height - board}, leg));
    }
  }
  return table;
}

// An arrow along +z, then turned onto each axis: x red, y green, z blue.
Mesh make_axes() {
  const float r = 0.0035F;
  const std::vector<Vector2f> arrow{{0, 0}, {r, 0}, {r, 0.078F}, {3 * r, 0.078F}, {0, 0.1F}};
  Mesh axes;
  const std::array<Color, 3> colors{{{226, 88, 80, 255}, {104, 186, 92, 255}, {82, 136, 232, 255}}};
  for (int axis = 0; axis < 3; ++axis) {
    Mesh one = make_lathe(arrow, 16, colors[static_cast<std::size_t>(axis)]);
    for (Vertex& vertex : one.vertices) {
      // Cyclic permutations keep orientation: (x, y, z) -> (z, x, y) takes +z to +x.
      for (Vector3f* v : {&vertex.position, &vertex.normal}) {
        const Vector3f z_up = *v;
        for (int i = 0; i < 3; ++i) (*v)[(i + axis + 1) % 3] = z_up[i];
      }
      vertex.position.z() += 2 * r;  // the shafts lie on the plane z = 0 and not in it
    }
    axes.append(one);
  }
  return axes;
}

// Two triangles; one where an edge has shrunk to a point.
void add_quad(Mesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  mesh.append_triangle(a, b, c);
  mesh.append_triangle(a, c, d);
}

// Outward normal of a profile segment in (radius, z).
Vector2f profile_normal(const Vector2f& from, const Vector2f& to) {
  const Vector2f along = to - from;
  return Vector2f(along.y(), -along.x()).normalized();
}

}  // namespace

void Mesh::append(const Mesh& other) {
  const auto offset = static_cast<std::uint32_t>(vertices.size());
  vertices.insert(vertices.end(), other.vertices.begin(), other.vertices.end());
  for (const std::uint32_t index : other.indices) indices.push_back(offset + index);
}

void Mesh::append_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  const Vector3f ab = vertices[b].position - vertices[a].position;
  const Vector3f ac = vertices[c].position - vertices[a].position;
  const Vector3f bc = ac - ab;
  if (ab.isZero() || ac.isZero() || bc.isZero()) return;
  for (const std::uint32_t i : {a, b, c}) indices.push_back(i);
}

const std::vector<std::string>& mesh_names() {
  static const std::vector<std::string> names{"teapot", "table", "cube", "axes"};
  return names;
}

Mesh named_mesh(const std::string& name) {
  if (name == "teapot") return make_teapot(0.15F);
  if (name == "table") return make_table();
  if (name == "axes") return make_axes();
  return make_box({0, 0, 0}, {0.08F, 0.08F, 0.08F}, {120, 168, 200, 255});
}

Mesh make_box(const Vector3f& foot, const Vector3f& size, const Color& color) {
  Mesh box;
  const Vector3f centre = foot + Vector3f(0, 0, size.z() / 2);
  for (int axis = 0; axis < 3; ++axis) {
    for (const float side : {-1.F, 1.F}) {
      const Vector3f normal = side * Vector3f::Unit(axis);
      const Vector3f u = Vector3f::Unit((axis + 1) % 3);
      const Vector3f v = normal.cross(u);
      const auto first = static_cast<std::uint32_t>(box.vertices.size());
      for (const auto& [s, t] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
        const Vector3f corner = normal + static_cast<float>(s) * u + static_cast<float>(t) * v;
        box.vertices.push_back({centre + 0.5F * corner.cwiseProduct(size), normal, color});
      }
      add_quad(box, first, first + 1, first + 2, first + 3);
    }
  }
  return box;
}

Mesh make_lathe(const std::vector<Vector2f>& profile, int segments, const Color& color) {
  const float smooth = std::cos(40 * kPi / 180);
  Mesh lathe;
  for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
    const Vector2f normal = profile_normal(profile[i], profile[i + 1]);
    // Normals at both ends of the segment, shared with a neighbour that bends little.
    std::array<Vector2f, 2> ends{normal, normal};
    if (i > 0) {
      const Vector2f before = profile_normal(profile[i - 1], profile[i]);
      if (before.dot(normal) > smooth) ends[0] = (before + normal).normalized();
    }
    if (i + 2 < profile.size()) {
      const Vector2f after = profile_normal(profile[i + 1], profile[i + 2]);
      if (after.dot(normal) > smooth) ends[1] = (after + normal).normalized();
    }
    const auto first = static_cast<std::uint32_t>(lathe.vertices.size());
    for (int s = 0; s <= segments; ++s) {
      const float angle = 2 * kPi * static_cast<float>(s % segments) / static_cast<float>(segments);
      const Vector3f outwards(std::cos(angle), std::sin(angle), 0);
      for (std::size_t end = 0; end < 2; ++end) {
        const Vector2f& p = profile[i + end];
        const Vector2f& n = ends[end];
        lathe.vertices.push_back({p.x() * outwards + p.y() * Vector3f::UnitZ(),
                                  n.x() * outwards + n.y() * Vector3f::UnitZ(), color});
      }
    }
    for (int s = 0; s < segments; ++s) {
      const auto k = first + static_cast<std::uint32_t>(2 * s);
      add_quad(lathe, k, k + 2, k + 3, k + 1);
    }
  }
  return lathe;
}

GpuMesh::GpuMesh(const Gl& gl, const Mesh& mesh)
    : gl_(&gl),
      array_(gl),
      vertices_(gl),
      indices_(gl),
      count_(static_cast<GLsizei>(mesh.indices.size())) {
  array_.bind();
  vertices_.bind(GL_ARRAY_BUFFER);
  gl.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(mesh.vertices.size() * sizeof(Vertex)),
                mesh.vertices.data(), GL_STATIC_DRAW);
  indices_.bind(GL_ELEMENT_ARRAY_BUFFER);
  gl.BufferData(GL_ELEMENT_ARRAY_BUFFER,
                static_cast<GLsizeiptr>(mesh.indices.size() * sizeof(std::uint32_t)),
                mesh.indices.data(), GL_STATIC_DRAW);
  describe_vertices(gl, sizeof(Vertex),
                    {{3, GL_FLOAT, false, offsetof(Vertex, position)},
                     {3, GL_FLOAT, false, offsetof(Vertex, normal)},
                     {4, GL_UNSIGNED_BYTE, true, offsetof(Vertex, color)}});
  gl.BindVertexArray(0);
}

void GpuMesh::draw() const {
  array_.bind();
  gl_->DrawElements(GL_TRIANGLES, count_, GL_UNSIGNED_INT, nullptr);
}

}  // namespace armsreach::render
