#include <algorithm>
#include <map>
#include <set>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "devices/sim/hand/gesture.hpp"
#include "devices/sim/hand/hand_surface.hpp"
#include "devices/sim/hand/place.hpp"
#include "devices/sim/hand/raster.hpp"
#include "devices/sim/hand/silhouette.hpp"

namespace armsreach::sim {
namespace {

using Eigen::Vector3f;

// Coarse, and the hand alone: quick to mesh.
HandSurfaceOptions quick() {
  HandSurfaceOptions options;
  options.forearm = 0.06;
  options.cell = 0.0045;
  return options;
}

// How often every directed edge of the triangles is there.
std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges_of(const TriangleMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const auto& triangle : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) ++edges[{triangle[i], triangle[(i + 1) % 3]}];
  }
  return edges;
}

double volume_of(const std::vector<Vector3f>& positions, const TriangleMesh& mesh) {
  double volume = 0;
  for (const auto& t : mesh.triangles) {
    volume += static_cast<double>(positions[t[0]].dot(positions[t[1]].cross(positions[t[2]])) / 6);
  }
  return volume;
}

TEST(SurfaceNet, ABallIsClosedRoundAndFacesOutwards) {
  GridPlanes planes;
  for (auto& axis : planes) {
    for (int i = -12; i <= 12; ++i) axis.push_back(0.1F * static_cast<float>(i));
  }
  const TriangleMesh mesh = surface_net(planes, [](const Vector3f& p) { return p.norm() - 1; });
  for (const auto& [edge, count] : edges_of(mesh)) EXPECT_EQ(count, 1);
  for (const Vector3f& vertex : mesh.vertices) EXPECT_NEAR(vertex.norm(), 1, 0.02);
  // A sphere's volume; the net is inscribed by a share of (cell/radius)^2.
  EXPECT_NEAR(volume_of(mesh.vertices, mesh), 4.18879, 0.06);
}

TEST(HandSurface, IsClosedForEverybody) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    HandSurfaceOptions options = quick();
    options.sleeve = seed % 2 == 0;
    if (options.sleeve) options.forearm = 1;
    const HandSurface surface(random_anatomy(seed), options);
    const auto edges = edges_of(surface.rest());
    for (const auto& [edge, count] : edges) {
      const auto back = edges.find({edge.second, edge.first});
      // Every edge belongs to as many triangles on one side as on the other.
      ASSERT_TRUE(back != edges.end() && back->second == count) << "person " << seed;
    }
  }
}

TEST(HandSurface, NormalsFaceOutwardsAndVolumeIsKeptInEveryPosture) {
  const HandSurface surface(mean_anatomy(), quick());
  PosedSurface posed;
  surface.pose(skeleton_of(surface.anatomy(), HandSurface::rest_pose()), posed);
  const double at_rest = volume_of(posed.positions, surface.rest());
  EXPECT_GT(at_rest, 0.00025);  // a quarter of a litre and more: a hand with its wrist
  EXPECT_LT(at_rest, 0.0006);
  for (int i = 0; i < kGestureCount; ++i) {
    const Gesture gesture = static_cast<Gesture>(i);
    surface.pose(skeleton_of(surface.anatomy(), pose_of(gesture, surface.anatomy())), posed);
    // Flesh is pushed into flesh where fingers fold; what is lost stays small.
    EXPECT_NEAR(volume_of(posed.positions, surface.rest()) / at_rest, 1, 0.12) << name(gesture);
    std::size_t facing = 0;
    for (const auto& t : surface.rest().triangles) {
      const Vector3f across = (posed.positions[t[1]] - posed.positions[t[0]])
                                  .cross(posed.positions[t[2]] - posed.positions[t[0]]);
      facing += across.dot(posed.normals[t[0]] + posed.normals[t[1]] + posed.normals[t[2]]) > 0;
    }
    // Not in the folds, where triangles are pressed together.
    EXPECT_GT(static_cast<double>(facing) / static_cast<double>(surface.rest().triangles.size()),
              0.97)
        << name(gesture);
    for (const Vector3f& normal : posed.normals) ASSERT_NEAR(normal.norm(), 1, 1e-4);
  }
}

TEST(HandSurface, PosedAtRestItIsWhatWasMeshed) {
  const HandSurface surface(random_anatomy(2), quick());
  PosedSurface posed;
  surface.pose(skeleton_of(surface.anatomy(), HandSurface::rest_pose()), posed);
  std::size_t exact = 0;
  for (std::size_t i = 0; i < posed.positions.size(); ++i) {
    const float moved = (posed.positions[i] - surface.rest().vertices[i]).norm();
    EXPECT_LT(moved, 1e-3F);
    exact += moved < 1e-4F;
  }
  // In the webs, lobes that are left out of a vertex's own matter by tenths of a millimetre.
  EXPECT_GT(static_cast<double>(exact), 0.97 * static_cast<double>(posed.positions.size()));
}

TEST(HandSurface, FingertipsAreWhereTheJointsSay) {
  const HandSurface surface(mean_anatomy(), quick());
  PosedSurface posed;
  for (const Gesture gesture : {Gesture::open, Gesture::two, Gesture::pinch, Gesture::fist}) {
    const HandSkeleton skeleton =
        skeleton_of(surface.anatomy(), pose_of(gesture, surface.anatomy()));
    surface.pose(skeleton, posed);
    for (const Finger finger : {Finger::thumb, Finger::index, Finger::little}) {
      const Vector3f tip = skeleton[tip_of(finger)].translation().cast<float>();
      float nearest = 1;
      for (const Vector3f& position : posed.positions)
        nearest = std::min(nearest, (position - tip).norm());
      // The mesh's cell is 4.5 mm: some vertex is within half of its diagonal.
      EXPECT_LT(nearest, 0.004F) << name(gesture);
    }
  }
}

TEST(HandSurface, TheSamePersonIsTheSameMesh) {
  const HandSurface a(random_anatomy(9), quick());
  const HandSurface b(random_anatomy(9), quick());
  EXPECT_EQ(a.rest().vertices, b.rest().vertices);
  EXPECT_EQ(a.rest().triangles, b.rest().triangles);
}

TEST(HandSurface, ALeftHandIsTheMirrorImage) {
  const HandSurface surface(mean_anatomy(), quick());
  PosedSurface right;
  surface.pose(skeleton_of(surface.anatomy(), pose_of(Gesture::L, surface.anatomy())), right);
  PosedSurface left = right;
  place(Pose(), true, left);
  for (std::size_t i = 0; i < left.positions.size(); ++i) {
    EXPECT_EQ(left.positions[i],
              Vector3f(-right.positions[i].x(), right.positions[i].y(), right.positions[i].z()));
    EXPECT_EQ(left.normals[i].x(), -right.normals[i].x());
  }
  // And is drawn as one.
  SilhouetteCamera camera(120);
  HandView view;
  const HandPose pose = pose_of(Gesture::L, surface.anatomy());
  const cv::Mat as_right = camera.draw(surface, pose, view);
  view.left = true;
  const cv::Mat as_left = camera.draw(surface, pose, view);
  int different = 0;
  int covered = 0;
  for (int y = 0; y < 120; ++y) {
    for (int x = 0; x < 120; ++x) {
      covered += as_right.at<std::uint8_t>(y, x) != 0;
      different += as_right.at<std::uint8_t>(y, x) != as_left.at<std::uint8_t>(y, 119 - x);
    }
  }
  EXPECT_GT(covered, 1500);
  EXPECT_LT(different, 0.02 * covered);  // samples on an edge fall to either side
}

}  // namespace
}  // namespace armsreach::sim
