#include "devices/sim/mesh_file.hpp"

#include <algorithm>
#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <limits>
#include <memory>
#include <string>
#include <utility>

#include <Eigen/Geometry>

namespace armsreach::sim {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

Vector3d vector(const aiVector3D& v) { return Eigen::Vector3f(v.x, v.y, v.z).cast<double>(); }

MeshTriangle triangle_of(const aiMesh& mesh, const aiFace& face, double scale) {
  MeshTriangle triangle;
  for (std::size_t i = 0; i < 3; ++i) {
    const unsigned index = face.mIndices[i];
    triangle.positions[i] = scale * vector(mesh.mVertices[index]);
    triangle.normals[i] = vector(mesh.mNormals[index]).normalized();
    triangle.pictured[i].setZero();
    if (!mesh.HasTextureCoords(0)) continue;
    const Vector3d texture = vector(mesh.mTextureCoords[0][index]);
    triangle.pictured[i] = {texture.x(), 1 - texture.y()};  // the file's v runs upwards
  }
  return triangle;
}

bool sound(const MeshTriangle& triangle) {
  constexpr double kLeastArea = 1e-10;  // m^2
  const auto& [a, b, c] = triangle.positions;
  if (!(0.5 * (b - a).cross(c - a).norm() > kLeastArea)) return false;
  return std::all_of(triangle.normals.begin(), triangle.normals.end(),
                     [](const Vector3d& normal) { return normal.norm() > 0.5; });
}

void lay_picture_from_above(std::vector<MeshTriangle>& triangles) {
  Eigen::AlignedBox3d box;
  for (const MeshTriangle& triangle : triangles) {
    for (const Vector3d& corner : triangle.positions) box.extend(corner);
  }
  const Vector3d size = box.sizes().cwiseMax(1e-6);
  for (MeshTriangle& triangle : triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector3d share = (triangle.positions[i] - box.min()).cwiseQuotient(size);
      triangle.pictured[i] = {share.x(), 1 - share.y()};
    }
  }
}

// 26 sides: towards the faces, edges and corners of a cube.
std::vector<Eigen::Hyperplane<double, 3>> solid_around(const std::vector<MeshTriangle>& triangles) {
  std::vector<Eigen::Hyperplane<double, 3>> sides;
  for (int i = 0; i < 27; ++i) {
    if (i == 13) continue;  // nowhere
    const Vector3d normal = Vector3d(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1).normalized();
    double farthest = -std::numeric_limits<double>::infinity();
    for (const MeshTriangle& triangle : triangles) {
      for (const Vector3d& corner : triangle.positions)
        farthest = std::max(farthest, normal.dot(corner));
    }
    sides.emplace_back(normal, -farthest);
  }
  return sides;
}

std::vector<MeshTriangle> triangles_of(const aiScene& scene, double scale) {
  std::vector<MeshTriangle> triangles;
  bool pictured = true;
  for (unsigned i = 0; i < scene.mNumMeshes; ++i) {
    const aiMesh& mesh = *scene.mMeshes[i];
    pictured = pictured && mesh.HasTextureCoords(0);
    if (!mesh.HasNormals()) continue;
    for (unsigned k = 0; k < mesh.mNumFaces; ++k) {
      const MeshTriangle triangle = triangle_of(mesh, mesh.mFaces[k], scale);
      if (sound(triangle)) triangles.push_back(triangle);
    }
  }
  if (!pictured) lay_picture_from_above(triangles);
  return triangles;
}

}  // namespace

Result<Mesh> load_mesh(const std::filesystem::path& file, double scale) {
  const std::string name = file.string();
  if (file.extension() != ".obj" && file.extension() != ".ply")
    return Error{"a mesh of a kind that is not read", name, "give an .obj or a .ply file"};
  if (!std::filesystem::is_regular_file(file))
    return Error{"no such mesh file", name, "give its path from the world's file"};
  Assimp::Importer importer;
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE,
                              aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  importer.SetPropertyFloat(AI_CONFIG_PP_GSN_MAX_SMOOTHING_ANGLE, 40);
  const aiScene* scene =
      importer.ReadFile(name, aiProcess_Triangulate | aiProcess_SortByPType |
                                  aiProcess_GenSmoothNormals | aiProcess_PreTransformVertices);
  if (!scene) {
    return Error{"not readable as a mesh: " + std::string(importer.GetErrorString()), name,
                 "export it anew from a modelling program"};
  }
  std::vector<MeshTriangle> triangles = triangles_of(*scene, scale);
  if (triangles.empty()) {
    return Error{"a mesh without triangles of any size", name,
                 "see whether its 'scale' makes it metres"};
  }
  if (triangles.size() > kMostMeshTriangles) {
    return Error{"a mesh of " + std::to_string(triangles.size()) + " triangles", name,
                 "decimate it to " + std::to_string(kMostMeshTriangles) + " or fewer"};
  }
  Mesh mesh{name, scale, nullptr, solid_around(triangles)};
  mesh.triangles = std::make_shared<const std::vector<MeshTriangle>>(std::move(triangles));
  return mesh;
}

}  // namespace armsreach::sim
