// Triangle meshes and the ones that come with the program, made by code: metres, z up, standing on
// z = 0 around the origin, counter-clockwise seen from outside, outward unit normals.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "render/gl_objects.hpp"

namespace armsreach::render {

struct Vertex {
  Eigen::Vector3f position;
  Eigen::Vector3f normal;
  std::array<std::uint8_t, 4> color{255, 255, 255, 255};  // sRGB
};

struct Mesh {
  std::vector<Vertex> vertices;
  std::vector<std::uint32_t> indices;  // three a triangle

  std::size_t triangle_count() const { return indices.size() / 3; }
  void append(const Mesh& other);
  // Between existing vertices; nothing when two of them coincide.
  void append_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c);
};

// Meshes that virtual objects can have: "teapot", "table", "cube", "axes".
const std::vector<std::string>& mesh_names();
// One of those; an unknown name gives the cube.
Mesh named_mesh(const std::string& name);

// The Utah teapot from Newell's bicubic patches, `height` metres to the top of its knob, each patch
// cut into divisions^2 quadrilaterals (8: 4076 triangles).
Mesh make_teapot(float height, int divisions = 8);
// An axis-aligned box with its lower face's centre at `foot`.
Mesh make_box(const Eigen::Vector3f& foot, const Eigen::Vector3f& size,
              const std::array<std::uint8_t, 4>& color = {255, 255, 255, 255});
// A closed solid of revolution about z; profile points are (radius, z) from the bottom to the top.
// Neighbouring profile points closer in direction than 40 degrees share a smooth normal.
Mesh make_lathe(const std::vector<Eigen::Vector2f>& profile, int segments,
                const std::array<std::uint8_t, 4>& color = {255, 255, 255, 255});

// A mesh in the memory of a context. Attributes: 0 position, 1 normal, 2 colour.
class GpuMesh {
 public:
  GpuMesh() = default;
  GpuMesh(const Gl& gl, const Mesh& mesh);
  void draw() const;

 private:
  const Gl* gl_ = nullptr;
  VertexArray array_;
  Buffer vertices_;
  Buffer indices_;
  GLsizei count_ = 0;
};

}  // namespace armsreach::render
