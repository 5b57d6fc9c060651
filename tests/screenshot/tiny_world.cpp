#include "tests/screenshot/tiny_world.hpp"

#include <cmath>
#include <limits>
#include <map>

#include <Eigen/Geometry>

namespace armsreach::render::test {
namespace {

using Eigen::Vector3d;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Hit {
  double distance = kInfinity;  // in units of the ray's direction
  Vector3d color{0, 0, 0};      // RGB 0..255
};

// Squares of 10 cm, two tones.
double checker(double u, double v) {
  return static_cast<int>(std::floor(10 * u) + std::floor(10 * v)) % 2 == 0 ? 1.0 : 0.86;
}

void meet_plane(const Vector3d& origin, const Vector3d& ray, int axis, double at,
                const Eigen::AlignedBox3d& limits, const Vector3d& color, Hit& hit) {
  const double distance = (at - origin[axis]) / ray[axis];
  if (!(distance > 1e-6) || distance >= hit.distance) return;
  const Vector3d p = origin + distance * ray;
  for (int i = 0; i < 3; ++i) {
    if (i != axis && (p[i] < limits.min()[i] || p[i] > limits.max()[i])) return;
  }
  hit = {distance, color * checker(p[(axis + 1) % 3], p[(axis + 2) % 3])};
}

Hit cast(const Vector3d& origin, const Vector3d& ray) {
  Hit hit;
  const Eigen::AlignedBox3d table(Vector3d(-0.6, -0.4, 0), Vector3d(0.6, 0.4, 0));
  const Eigen::AlignedBox3d wall(Vector3d(-2, 0.7, -1), Vector3d(2, 0.7, 2));
  const Eigen::AlignedBox3d block(kBlockLow, kBlockHigh);
  meet_plane(origin, ray, 2, 0, table, {186, 164, 138}, hit);
  meet_plane(origin, ray, 1, 0.7, wall, {150, 164, 172}, hit);
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3d tone = Vector3d(120, 76, 66) * (axis == 2 ? 1.25 : axis == 1 ? 1.0 : 0.8);
    meet_plane(origin, ray, axis, kBlockLow[axis], block, tone, hit);
    meet_plane(origin, ray, axis, kBlockHigh[axis], block, tone, hit);
  }
  return hit;
}

}  // namespace

Pose world_from_viewer() {
  const Vector3d eye(0.1, -0.75, 0.5);
  const Vector3d forward = (Vector3d(0, 0.02, 0.03) - eye).normalized();
  Eigen::Matrix3d axes;
  axes.col(2) = forward;
  axes.col(0) = forward.cross(Vector3d::UnitZ()).normalized();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  return {Eigen::Quaterniond(axes), eye};
}

Scene tiny_scene(const Camera& camera, const Pose& world_from_camera) {
  Scene scene;
  scene.frame = 42;
  scene.time = 1.4;
  scene.camera = camera;
  scene.world_from_camera = world_from_camera;
  scene.pose_known = true;
  scene.tracking_state = "tracking";
  scene.background.create(camera.height, camera.width, CV_8UC3);
  scene.depth.create(camera.height, camera.width, CV_32F);
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      // The ray has z = 1, so the distance along it is depth.
      const Vector3d ray = world_from_camera.rotation() * unproject(camera, {x, y});
      const Hit hit = cast(world_from_camera.translation(), ray);
      const bool met = hit.distance < kInfinity;
      const Vector3d rgb = met ? hit.color : Vector3d(60, 66, 74);
      scene.background.at<cv::Vec3b>(y, x) = cv::Vec3b(
          static_cast<uchar>(rgb.z()), static_cast<uchar>(rgb.y()), static_cast<uchar>(rgb.x()));
      scene.depth.at<float>(y, x) =
          met ? static_cast<float>(hit.distance) : std::numeric_limits<float>::quiet_NaN();
    }
  }
  return scene;
}

SurfacePtr tiny_surface(float size) {
  std::map<std::array<int, 3>, SurfaceBlock> blocks;
  const auto add = [&](const Vector3d& p, int axis, int sign) {
    std::array<int, 3> key{};
    for (int i = 0; i < 3; ++i)
      key[static_cast<std::size_t>(i)] =
          static_cast<int>(std::floor(p[i] / (8 * static_cast<double>(size))));
    SurfacePoint point{p.cast<float>(), {0, 0, 0}, 0};
    point.normal[static_cast<std::size_t>(axis)] = static_cast<std::int8_t>(127 * sign);
    const double tone = axis == 2 ? 0.75 : axis == 1 && p.y() > 0.6 ? 0.62 : 0.45;
    point.intensity =
        static_cast<std::uint8_t>(255 * tone * checker(p[(axis + 1) % 3], p[(axis + 2) % 3]));
    SurfaceBlock& block = blocks[key];
    block.key = key;
    block.size = size;
    block.points.push_back(point);
  };
  const double s = static_cast<double>(size);
  // Elements sit at the centres of grid cells along the surface.
  const auto each = [s](double low, double high, const auto& visit) {
    for (double cell = std::floor(low / s + 0.5); (cell + 0.5) * s < high; ++cell)
      visit((cell + 0.5) * s);
  };
  each(-0.6, 0.6, [&](double x) {
    each(-0.4, 0.4, [&](double y) { add({x, y, 0}, 2, 1); });
    each(-0.3, 0.7, [&](double z) { add({x, 0.7, z}, 1, -1); });
  });
  each(kBlockLow.x(), kBlockHigh.x(), [&](double x) {
    each(kBlockLow.y(), kBlockHigh.y(), [&](double y) { add({x, y, kBlockHigh.z()}, 2, 1); });
    each(0, kBlockHigh.z(), [&](double z) { add({x, kBlockLow.y(), z}, 1, -1); });
  });
  auto surface = std::make_shared<Surface>();
  surface->revision = 1;
  for (auto& [key, block] : blocks)
    surface->blocks.push_back(std::make_shared<const SurfaceBlock>(std::move(block)));
  return surface;
}

VirtualObject standing(std::int64_t id, const std::string& mesh, double x, double y) {
  VirtualObject object;
  object.id = id;
  object.mesh = mesh;
  object.world_from_object = Pose(Eigen::Quaterniond::Identity(), {x, y, 0});
  return object;
}

}  // namespace armsreach::render::test
