// Where a single camera is, and where some dozens of points around it are, at video rate.
//
// After Davison, Reid, Molton, Stasse, "MonoSLAM: Real-Time Single Camera SLAM", PAMI 2007. The
// same frames, options and seed give the same results.
#pragma once

#include <cstdint>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

#include "vision/core/camera.hpp"
#include "vision/core/event.hpp"
#include "vision/core/time.hpp"
#include "vision/mono_slam/consensus.hpp"
#include "vision/mono_slam/filter.hpp"
#include "vision/mono_slam/image_turn.hpp"
#include "vision/mono_slam/interest.hpp"
#include "vision/mono_slam/landmark.hpp"
#include "vision/mono_slam/relocaliser.hpp"
#include "vision/mono_slam/search.hpp"
#include "vision/mono_slam/sparse_map.hpp"
#include "vision/mono_slam/start_target.hpp"

namespace armsreach::mono_slam {

enum class NewPoints { particles, inverse_depth };

struct MonoSlamOptions {
  MotionNoise motion;
  double pixel_sigma = 0.75;  // of a measurement, px: a template's errors persist
  double search_deviations = 3;
  // When that finds too little the camera was jerked: once more, farther.
  double jerk_deviations = 9;
  double least_score = 0.85;  // ZNCC of a match
  ConsensusOptions consensus;
  LandmarkRules rules;
  InterestOptions interest;
  RelocaliserOptions relocaliser;

  int visible_points = 36;  // new ones are added while fewer are in view
  int most_points = 120;    // in the map
  int most_new = 3;         // a frame
  int patch_size = 15;      // px
  int first_group = 12;     // measured before the others are predicted again

  NewPoints new_points = NewPoints::inverse_depth;
  double nearest = 0.5;  // m, of new points
  double farthest = 5;
  int particle_count = 100;
  double prune = 0.05;  // particles below this share of the mean weight
  int least_particles = 20;
  double known_ratio = 0.3;   // sigma / distance at which particles become a point
  double linear_ratio = 0.1;  // Civera's linearity index at which an inverse depth does

  int least_inliers = 4;         // of a frame that counts as tracked
  double least_share = 1.0 / 3;  // and of what was looked for in it
  int patience = 10;             // frames below that before the camera is lost
  // How long a commanded leap excuses that nothing is seen: on the way, and until what is there is
  // mapped.
  double leap_patience = 1;  // s

  std::optional<StartTarget> target;
  int depth_patience = 30;  // frames whose depth shows too little, before the scale is stated
  std::optional<int> forget_start_target_at;  // frame, counted from the first one given
  double stated_distance = 1;  // m, of what is seen first, where there is no target and no depth
  std::uint64_t seed = 1;
};

struct MonoInput {
  Timestamp time = 0;
  cv::Mat grey;                          // CV_8UC1 of the camera's size
  cv::Mat allowed;                       // CV_8UC1, 0 where nothing belongs to the scene (a hand)
  cv::Mat depth;                         // CV_32F m along z, same camera; only to start with
  std::optional<CameraControl> control;  // commanded motion since the last frame
};

enum class ScaleFrom { nothing_yet, target, depth, stated, map };

enum class Outcome {
  out_of_view,  // or from where it is not recognisable
  not_found,
  rejected,  // found where the others disagree
  measured,
};

// A point of the map as one frame left it.
struct MapPoint {
  PointId id = 0;
  PointKind kind = PointKind::position;
  bool of_target = false;
  Outcome outcome = Outcome::out_of_view;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();    // in the world; of a ray: its mean
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  // m^2
  // Where it was expected before anything was measured, and the covariance S of that.
  std::optional<Eigen::Vector2d> predicted;
  Eigen::Matrix2d innovation_covariance = Eigen::Matrix2d::Zero();
  std::optional<Eigen::Vector2d> measured;
  Eigen::Vector2d innovation = Eigen::Vector2d::Zero();  // against the prediction searched around
  double residual = 0;                                   // px left after the update
  int attempts = 0;
  int successes = 0;
  // Of a ray with particles: places in the world and their weights.
  std::vector<std::pair<Eigen::Vector3d, double>> particles;
};

struct MonoResult {
  Timestamp time = 0;
  std::int64_t frame = 0;  // counted from the first one given
  TrackingState state = TrackingState::initialising;
  bool state_changed = false;
  ScaleFrom scale = ScaleFrom::nothing_yet;
  TargetSight target = TargetSight::nothing;    // while initialising
  Pose world_from_camera;                       // while lost: the last one that was believed
  bool pose_seen = false;                       // too little was seen otherwise: it is predicted
  Matrix6d pose_covariance = Matrix6d::Zero();  // position [m], turn about the camera's axes [rad]
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  // m/s in the world
  double trace = 0;                                    // of the whole covariance
  int visible = 0;                                     // points looked for
  int inliers = 0;                                     // points measured
  std::vector<MapPoint> points;
};

class MonoSlam {
 public:
  MonoSlam(const Camera& camera, const MonoSlamOptions& options);

  MonoResult step(const MonoInput& input);

  const Filter& filter() const { return filter_; }
  const std::vector<Landmark>& landmarks() const { return landmarks_; }
  TrackingState state() const { return state_; }

  // What can be kept: the points with three rows, as they are known now.
  SparseMap map() const;
  // Enters a known map; the camera is lost in it until it recognises something.
  void enter(const SparseMap& map);

 private:
  // One landmark in one frame.
  struct Look {
    std::size_t landmark;
    Prediction prediction;  // before anything was measured
    Outcome outcome = Outcome::not_found;
    std::optional<Eigen::Vector2d> measured{};
    Eigen::Vector2d innovation = Eigen::Vector2d::Zero();
  };

  // mono_slam.cpp: what state it is in.
  void initialise(const MonoInput& input);
  void start_on_target(const MonoInput& input, const TargetFix& fix);
  bool waits_for_depth(const MonoInput& input) const;
  void start_on_depth(const MonoInput& input);
  void start_as_stated(const MonoInput& input);
  void start_at_origin();
  void track(const MonoInput& input);
  int count_inliers() const;
  bool sees_enough() const;
  bool excused(Timestamp now) const;
  bool turned_away(Timestamp now);
  void feel_turning(const MonoInput& input, double seconds);
  double background_inverse_distance() const;
  void find_again();
  void forget_target();
  MonoResult result(const MonoInput& input) const;

  // measuring.cpp: one frame of the filter.
  std::vector<Look> expected_looks() const;
  std::optional<Prediction> expected(const Landmark& landmark) const;
  void measure(double deviations);
  std::optional<Match> look_for(Landmark* landmark, const Prediction& prediction,
                                double deviations) const;
  int take(const std::vector<Look*>& group, const std::vector<Measurement>& measurements,
           int least);
  void weigh_particles();

  // map_management.cpp: which points there are.
  void manage_map(const MonoInput& input);
  void record(const std::vector<Look>& looks);
  void fix_distances();
  void remove_failed();
  void add_points(const MonoInput& input, int most);
  bool add_point(const MonoInput& input, const Eigen::Vector2d& pixel);
  struct InverseDepthPrior {
    double mean;  // 1/m
    double sigma;
  };
  InverseDepthPrior inverse_depth_prior(const Eigen::Vector2d& pixel) const;
  void make_room();
  void erase(std::size_t landmark);
  void keep(PointId id, const cv::Mat& grey, const Eigen::Vector2d& pixel);
  std::vector<Eigen::Vector2d> taken_pixels() const;

  Camera camera_;
  MonoSlamOptions options_;
  std::mt19937_64 random_;
  Filter filter_;
  SearchImage image_;
  ImageTurnMeter turn_meter_;
  std::optional<TargetWatch> target_;
  TargetSight target_sight_ = TargetSight::nothing;
  std::vector<Landmark> landmarks_;  // oldest first, ids ascending
  std::vector<Look> looks_;          // of this frame
  TrackingState state_ = TrackingState::initialising;
  ScaleFrom scale_ = ScaleFrom::nothing_yet;
  std::optional<Timestamp> last_time_;
  std::int64_t frame_ = -1;
  int inliers_ = 0;
  int poor_frames_ = 0;                // in a row
  std::optional<Timestamp> leapt_at_;  // by a command, and little has been seen since
};

}  // namespace armsreach::mono_slam
