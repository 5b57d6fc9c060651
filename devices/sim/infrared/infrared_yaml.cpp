#include "devices/sim/infrared/infrared_yaml.hpp"

#include <Eigen/Geometry>

namespace armsreach::sim {
namespace {

Camera camera_from(YamlMap& map) {
  const int width = static_cast<int>(map.number("width", 16, 4096));
  const int height = static_cast<int>(map.number("height", 16, 4096));
  const double focal = 1e3 * map.number("lens_mm", 0.5, 200) / map.number("pixel_um", 0.5, 50);
  Camera camera = pinhole(width, height, focal, focal, 0.5 * width - 0.5, 0.5 * height - 0.5);
  const auto coefficients = map.vector<5>("distortion");
  for (Eigen::Index i = 0; i < coefficients.size(); ++i)
    camera.coefficients[static_cast<std::size_t>(i)] = coefficients[i];
  return camera;
}

Pose view_from(YamlMap& map) {
  const Eigen::Vector3d eye = map.vector<3>("eye");
  const Eigen::Vector3d forward = map.vector<3>("target") - eye;
  const Eigen::Vector3d right = forward.cross(map.vector<3>("up"));
  if (right.norm() < 1e-9)
    throw map.complaint("up", "does not lie across the view from eye to target");
  const Eigen::Vector3d z = forward.normalized();
  const Eigen::Vector3d x = right.normalized();
  Eigen::Matrix3d turn;
  turn << x, z.cross(x), z;
  return {Eigen::Quaterniond(turn), eye};
}

BraceletDescription bracelet_from(YamlMap map) {
  BraceletDescription bracelet;
  bracelet.radius = map.number("radius", 0.015, 0.08, bracelet.radius);
  bracelet.segment = map.number("segment", 0.002, 0.02, bracelet.segment);
  bracelet.spacing = map.number("spacing", bracelet.segment, 0.1, bracelet.spacing);
  bracelet.behind = map.number("behind", 0, 0.15, bracelet.behind);
  bracelet.width = map.number("width", 0, 0.05, bracelet.width);
  map.refuse_others();
  return bracelet;
}

GloveDescription glove_from(YamlMap map) {
  GloveDescription glove;
  glove.cell = map.number("cell", 0.002, 0.009, glove.cell);
  glove.finger = map.number("finger", 0.003, 0.015, glove.finger);
  map.refuse_others();
  return glove;
}

}  // namespace

InfraredDescription infrared_from(YamlMap map) {
  InfraredDescription infrared;
  infrared.camera = camera_from(map);
  infrared.world_from_camera = view_from(map);
  infrared.rate = map.number("rate", 0.1, 1000, infrared.rate);
  infrared.tape_level = map.number("tape_level", 0, 1e6, infrared.tape_level);
  infrared.white_level = map.number("white_level", 0, 1e4, infrared.white_level);
  infrared.noise = map.number("noise", 0, 100, infrared.noise);
  if (map.find("bracelet")) infrared.bracelet = bracelet_from(map.section("bracelet"));
  if (map.find("glove")) infrared.glove = glove_from(map.section("glove"));
  map.refuse_others();
  return infrared;
}

}  // namespace armsreach::sim
