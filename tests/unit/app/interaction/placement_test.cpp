// Clicks on an analytic table: where objects stand, what is selected, what is said when nothing is.
#include "app/interaction/placement.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace armsreach::app {
namespace {

// The plane z = 0.5 seen from above, mapped within a metre of the origin; moved as a whole by
// `correction` to stand for a corrected map.
class TableWorld final : public WorldView {
 public:
  explicit TableWorld(const Pose& correction = Pose()) : correction_(correction) {}

  std::optional<Eigen::Vector3d> pick(const Ray& ray, double range) const override {
    const double t = (0.5 - ray.origin_in_world.z()) / ray.direction_in_world.z();
    const Eigen::Vector3d hit = ray.origin_in_world + t * ray.direction_in_world;
    if (!(t > 0) || t * ray.direction_in_world.norm() > range) return std::nullopt;
    if (hit.head<2>().norm() >= 1) return std::nullopt;
    return hit + Eigen::Vector3d(0, 0, 0.004);  // off the plane, as the side of a voxel would be
  }
  std::optional<Eigen::Vector3d> nearest(const Eigen::Vector3d&, double) const override {
    return std::nullopt;
  }
  std::optional<Plane> local_plane(const Eigen::Vector3d& p, double) const override {
    if (p.head<2>().norm() > 0.9) return std::nullopt;  // the rim is not flat
    return Plane{{p.x(), p.y(), 0.5}, {0, 0, 1}};
  }
  Anchor anchor(const Pose& pose) const override { return {0, pose}; }
  Pose resolve(const Anchor& anchor) const override {
    return correction_ * anchor.world_from_anchor;
  }
  std::uint64_t revision() const override { return 1; }

 private:
  Pose correction_;
};

const Eigen::Vector3d kEye(0, -2, 2);
const Viewer kViewer{kEye};

Click at(double x, double y, const std::string& mesh) {
  return {{kEye, Eigen::Vector3d(x, y, 0.5) - kEye}, mesh};
}

TEST(Placement, AnObjectStandsOnThePlaneAndFacesTheViewer) {
  const TableWorld world;
  Placement placement;
  const Events events = placement.click(at(0.3, 0.2, "teapot"), &world, kViewer, 7);
  ASSERT_EQ(events.size(), 1U);
  const auto& inserted = std::get<InsertEvent>(events[0].body);
  EXPECT_EQ(inserted.object, "teapot");
  const Pose& pose = inserted.world_from_object;
  EXPECT_NEAR(pose.translation().z(), 0.5, 1e-9);
  EXPECT_LT((pose.translation() - Eigen::Vector3d(0.3, 0.2, 0.5)).norm(), 0.01);
  EXPECT_LT((pose.rotation() * Eigen::Vector3d::UnitZ() - Eigen::Vector3d::UnitZ()).norm(), 1e-9);
  EXPECT_GT((pose.rotation() * -Eigen::Vector3d::UnitY()).dot(kEye - pose.translation()), 0);
  EXPECT_NEAR(pose.rotation_matrix().determinant(), 1, 1e-9);
}

TEST(Placement, SaysWhyNothingWasInserted) {
  const TableWorld world;
  Placement placement;
  for (const auto& events : {placement.click(at(0, 0, "cube"), nullptr, kViewer, 0),
                             placement.click(at(0.95, 0, "cube"), &world, kViewer, 0),
                             placement.click(at(3, 0, "cube"), &world, kViewer, 0)}) {
    ASSERT_EQ(events.size(), 1U);
    EXPECT_FALSE(std::get<FaultEvent>(events[0].body).remedy.empty());
  }
  EXPECT_TRUE(placement.objects().empty());
}

TEST(Placement, NothingIsStoodOnWhatIsSteep) {
  const TableWorld world;
  Placement placement;
  const double slope = 50 * std::numbers::pi / 180;
  const Viewer table_is_level{kEye, Eigen::Vector3d::UnitZ()};
  const Viewer table_is_sloping{kEye, Eigen::Vector3d(std::sin(slope), 0, std::cos(slope))};
  const Viewer table_is_a_wall{kEye, Eigen::Vector3d::UnitY()};
  placement.click(at(0, 0, "cube"), &world, table_is_level, 0);
  placement.click(at(0.3, 0, "cube"), &world, table_is_sloping, 0);
  EXPECT_EQ(placement.objects().size(), 2U);
  const Events refused = placement.click(at(-0.3, 0, "cube"), &world, table_is_a_wall, 0);
  EXPECT_EQ(placement.objects().size(), 2U);
  ASSERT_EQ(refused.size(), 1U);
  EXPECT_FALSE(std::get<FaultEvent>(refused[0].body).remedy.empty());
}

TEST(Placement, SelectsTheObjectThatIsMeantAndDeletesIt) {
  const TableWorld world;
  Placement placement;
  placement.click(at(0.3, 0, "cube"), &world, kViewer, 0);
  placement.click(at(-0.3, 0, "cube"), &world, kViewer, 0);
  placement.click(at(-0.3, 0, ""), &world, kViewer, 0);
  EXPECT_FALSE(placement.objects()[0].selected);
  EXPECT_TRUE(placement.objects()[1].selected);
  const Events events = placement.remove_selected(&world, 9);
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(std::get<DeleteEvent>(events[0].body).id, 2);
  ASSERT_EQ(placement.objects().size(), 1U);
  placement.click(at(0, 0.8, ""), &world, kViewer, 0);
  EXPECT_TRUE(placement.remove_selected(&world, 9).empty());
}

TEST(Placement, ObjectsMoveWithACorrectedMap) {
  const TableWorld before;
  Placement placement;
  placement.click(at(0, 0, "cube"), &before, kViewer, 0);
  const Pose shift(Eigen::Quaterniond::Identity(), {0.01, 0, 0});
  const TableWorld after(shift);
  const PlacedObject& object = placement.objects()[0];
  const Pose moved = Placement::world_from_object(object, &after);
  EXPECT_NEAR(moved.translation().x(), 0.01, 1e-9);
}

}  // namespace
}  // namespace armsreach::app
