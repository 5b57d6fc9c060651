// The filter's map as the question desk. A few dozen points are no surface: between them it is
// guessed, as what the points around a place suggest.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "vision/core/world_view.hpp"
#include "vision/mono_slam/mono_slam.hpp"

namespace armsreach::mono_slam {

class SparseView final : public WorldView {
 public:
  struct Place {
    PointId id;
    Eigen::Vector3d point_in_world;
  };
  using Places = std::vector<Place>;  // in order of id

  // `gone`: where points were that the map no longer has, for what is anchored to them.
  SparseView(Places points, std::shared_ptr<const Places> gone, const Eigen::Vector3d& up_in_world,
             const Eigen::Vector3d& viewer_in_world, std::uint64_t revision);

  // As far along the ray as the points are that it passes closest by; nothing where it passes by
  // all of them.
  std::optional<Eigen::Vector3d> pick(const Ray& ray, double range) const override;
  std::optional<Eigen::Vector3d> nearest(const Eigen::Vector3d& point_in_world,
                                         double radius) const override;
  // Of the nearest points, which may be farther away than `radius`; level where those are not
  // plane-like, so that what is put there stands upright. Nothing far from all points.
  std::optional<Plane> local_plane(const Eigen::Vector3d& point_in_world,
                                   double radius) const override;
  // Tied to the nearest point: it moves when that is corrected.
  Anchor anchor(const Pose& world_from_thing) const override;
  Pose resolve(const Anchor& anchor) const override;
  std::uint64_t revision() const override { return revision_; }

 private:
  std::vector<Eigen::Vector3d> around(const Eigen::Vector3d& point_in_world) const;

  Places points_;
  std::shared_ptr<const Places> gone_;
  Eigen::Vector3d up_;
  Eigen::Vector3d viewer_;
  std::uint64_t revision_;
};

// Makes the view of each frame, and remembers the points that have gone.
class SparseViewMaker {
 public:
  WorldViewPtr view(const MonoResult& result, const Eigen::Vector3d& up_in_world);

 private:
  SparseView::Places known_;
  std::shared_ptr<const SparseView::Places> gone_ = std::make_shared<SparseView::Places>();
  std::uint64_t revision_ = 0;
};

}  // namespace armsreach::mono_slam
