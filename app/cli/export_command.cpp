// armsreach export: a saved map as a PLY mesh or point cloud.
#include <cstdio>
#include <fstream>
#include <memory>
#include <string>

#include "app/cli/commands.hpp"
#include "app/runtime/output_file.hpp"
#include "vision/mapping/mesh.hpp"
#include "vision/mapping/octree_codec.hpp"
#include "vision/mapping/ply.hpp"

namespace armsreach::app {
namespace {

struct ExportOptions {
  std::string map;
  std::string out;
  bool cloud = false;
};

Status export_map(const ExportOptions& options) {
  std::ifstream in(options.map, std::ios::binary);
  if (!in) return Error{"cannot be opened", options.map, "give a map saved with run --map"};
  mapping::VoxelMapOptions map_options;
  map_options.max_blocks = 500'000;  // 2 GB: a map that only passes through may be a large one
  const auto map = mapping::read_octree(in, options.map, map_options);
  if (!map) return map.error();
  const mapping::SurfaceMesh mesh =
      options.cloud ? mapping::surface_cloud(map->grid()) : mapping::surface_mesh(map->grid());
  if (mesh.vertices.empty()) {
    return Error{"has no surface", options.map, "map a few frames first: run --map FILE"};
  }
  const Status status =
      write_file(options.out, [&](std::ostream& out) { mapping::write_ply(out, mesh); });
  if (!status) return status;
  std::printf("%s: %zu vertices", options.out.c_str(), mesh.vertices.size());
  if (!options.cloud) {
    std::printf(", %zu triangles, %.2f m2", mesh.triangles.size(), mapping::area(mesh));
  }
  std::printf("\n");
  return ok();
}

}  // namespace

void add_export_command(CLI::App& app, Task* task) {
  CLI::App* command = app.add_subcommand("export", "a saved map as a PLY mesh or point cloud");
  auto options = std::make_shared<ExportOptions>();
  command->add_option("map", options->map, "map to export (.ot)")->required();
  command->add_option("--out", options->out, "PLY file to write")->required();
  command->add_flag("--cloud", options->cloud, "points with normals instead of a mesh");
  command->callback([task, options] { *task = [options] { return export_map(*options); }; });
}

}  // namespace armsreach::app
