// Which skin that has made no gesture is a hand: what moves, and not only as the whole picture
// does.
#pragma once

#include <map>
#include <optional>

#include <Eigen/Core>

#include "app/pipelines/hands_stage.hpp"
#include "vision/core/camera.hpp"
#include "vision/core/frame.hpp"
#include "vision/mono_slam/image_turn.hpp"

namespace armsreach::app {

class HandWatch {
 public:
  // `camera`: whose pixels hands are seen in.
  explicit HandWatch(const Camera& camera) : camera_(camera), turn_meter_(camera) {}

  // To be called with every frame. The centre [px] of the unproven hand that, of those that have
  // moved lately, is the likeliest to be one; none while there is a proven one.
  std::optional<Eigen::Vector2d> update(const HandsState& hands, const Frame& frame);

 private:
  // A hand that is badly cut out has less: less than this says nothing.
  static constexpr double kLeastEvidence = -5;
  struct Track {
    Timestamp since = 0;
    Timestamp time = 0;
    Eigen::Vector2d center{0, 0};      // px
    Eigen::Vector2d way{0, 0};         // sizes of the hand, that it has moved by itself lately
    double evidence = kLeastEvidence;  // the most there was that it is a hand
    std::optional<Timestamp> moved{};  // when it had moved far enough
  };
  void follow(Track& track, const gesture::Hand& hand, Timestamp time,
              const Eigen::Quaterniond& before_from_now) const;

  Camera camera_;
  mono_slam::ImageTurnMeter turn_meter_;
  std::map<int, Track> tracks_;  // by the hands' numbers
};

}  // namespace armsreach::app
