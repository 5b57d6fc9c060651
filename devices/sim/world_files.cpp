#include "devices/sim/world_files.hpp"

#include <utility>
#include <variant>

#include <opencv2/imgcodecs.hpp>

#include "devices/sim/mesh_file.hpp"

namespace armsreach::sim {
namespace {

Status load_picture(const std::filesystem::path& file, Material& material) {
  // OpenCV warns of files that are not there.
  if (std::filesystem::is_regular_file(file))
    material.picture = cv::imread(file.string(), cv::IMREAD_COLOR);
  if (!material.picture.empty()) return ok();
  return Error{"the texture of material '" + material.name + "' cannot be read", file.string(),
               "give a PNG or JPEG file by its path from the world's file"};
}

}  // namespace

Status load_files(const std::filesystem::path& folder, World& world) {
  for (Material& material : world.materials) {
    if (material.texture.empty()) continue;
    const Status loaded = load_picture(folder / material.texture, material);
    if (!loaded) return loaded;
  }
  for (Part& part : world.parts) {
    const Mesh* named = std::get_if<Mesh>(&part.shape);
    if (!named) continue;
    auto mesh = load_mesh(folder / named->file, named->scale);
    if (!mesh) return mesh.error();
    mesh->file = named->file;
    part.shape = std::move(*mesh);
  }
  return ok();
}

}  // namespace armsreach::sim
