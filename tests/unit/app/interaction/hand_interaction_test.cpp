// What a bare hand does to objects: inserts or selects, accepts, rejects.
#include "app/interaction/hand_interaction.hpp"

#include <gtest/gtest.h>

namespace armsreach::app {
namespace {

using gesture::Action;

// The plane z = 0.
class FloorWorld final : public WorldView {
 public:
  std::optional<Eigen::Vector3d> pick(const Ray& ray, double) const override {
    const double t = -ray.origin_in_world.z() / ray.direction_in_world.z();
    return ray.origin_in_world + t * ray.direction_in_world;
  }
  std::optional<Eigen::Vector3d> nearest(const Eigen::Vector3d&, double) const override {
    return std::nullopt;
  }
  std::optional<Plane> local_plane(const Eigen::Vector3d& p, double) const override {
    return Plane{{p.x(), p.y(), 0}, {0, 0, 1}};
  }
  Anchor anchor(const Pose& pose) const override { return {0, pose}; }
  Pose resolve(const Anchor& anchor) const override { return anchor.world_from_anchor; }
  std::uint64_t revision() const override { return 1; }
};

const Eigen::Vector3d kEye(0, -1, 1);
const Viewer kViewer{kEye};

class HandInteractionTest : public testing::Test {
 protected:
  Events act(Action action, double x = 0) {
    const Ray ray{kEye, Eigen::Vector3d(x, 0, 0) - kEye};
    return hand_.act({action, ray}, &placement_, &world_, kViewer, 5);
  }

  FloorWorld world_;
  Placement placement_;
  HandInteraction hand_{"cube"};
};

TEST_F(HandInteractionTest, AnInsertedObjectIsAcceptedAndStays) {
  ASSERT_EQ(act(Action::select).size(), 1U);
  EXPECT_TRUE(placement_.objects().at(0).selected);
  const Events accepted = act(Action::accept);
  ASSERT_EQ(accepted.size(), 1U);
  EXPECT_EQ(std::get<AcceptEvent>(accepted[0].body).anchor, placement_.objects().at(0).id);
  EXPECT_FALSE(placement_.objects().at(0).selected);
  EXPECT_TRUE(act(Action::reject).empty());  // nothing is in question any more
  EXPECT_EQ(placement_.objects().size(), 1U);
}

TEST_F(HandInteractionTest, ARejectedObjectGoes) {
  act(Action::select);
  const Events rejected = act(Action::reject);
  ASSERT_EQ(rejected.size(), 2U);
  EXPECT_TRUE(std::holds_alternative<RejectEvent>(rejected[0].body));
  EXPECT_TRUE(std::holds_alternative<DeleteEvent>(rejected[1].body));
  EXPECT_TRUE(placement_.objects().empty());
}

TEST_F(HandInteractionTest, AnObjectThatIsPointedAtIsSelectedInsteadOfInsertingAnother) {
  act(Action::select, 0);
  act(Action::accept);
  EXPECT_TRUE(act(Action::select, 0.02).empty());
  EXPECT_EQ(placement_.objects().size(), 1U);
  EXPECT_TRUE(placement_.objects().at(0).selected);
  act(Action::select, 0.6);
  EXPECT_EQ(placement_.objects().size(), 2U);
  EXPECT_FALSE(placement_.objects().at(0).selected);
}

TEST_F(HandInteractionTest, WithoutAPoseOrAMeshNothingIsInsertedAndItIsSaidWhereAMapIs) {
  const Events lost = hand_.act({Action::select, {}}, &placement_, &world_, kViewer, 5);
  ASSERT_EQ(lost.size(), 1U);
  EXPECT_FALSE(std::get<FaultEvent>(lost[0].body).remedy.empty());
  EXPECT_TRUE(hand_.act({Action::select, {}}, &placement_, nullptr, kViewer, 5).empty());
  hand_ = HandInteraction("");
  EXPECT_TRUE(act(Action::select).empty());
  EXPECT_TRUE(placement_.objects().empty());
}

}  // namespace
}  // namespace armsreach::app
