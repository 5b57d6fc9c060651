// The extended Kalman filter over the camera and the points of the map.
//
// Everything is allocated once. The covariance is kept whole and exactly symmetric; an update
// subtracts W^T W, W = L^-1 H P with L the Cholesky factor of S: no inverse, and what is subtracted
// is positive whatever the rounding.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "vision/core/camera.hpp"
#include "vision/mono_slam/camera_motion.hpp"
#include "vision/mono_slam/point.hpp"

namespace armsreach::mono_slam {

using PointId = std::int64_t;

// A point's sighting as the state predicts it.
struct Prediction {
  PointId id = 0;
  Sighting sighting;
  Eigen::Matrix2d covariance;  // S: of the pixel that will be measured, px^2
};

struct Measurement {
  Prediction prediction;
  Eigen::Vector2d pixel;
  double noise = 1;  // its deviation, in units of the filter's
  Eigen::Vector2d innovation() const { return pixel - prediction.sighting.pixel; }
};

// How whole pictures turn over the last prediction, besides what was commanded. What a carrier
// moves sideways looks like a turn, too.
struct Turning {
  Eigen::Vector3d rate = Eigen::Vector3d::Zero();  // about the camera's axes, rad/s
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Identity();
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  // where it looked on average, in the camera
  double inverse_distance = 0;                      // of what is seen, 1/m
};

// Several measurements predicted together.
struct JointInnovation {
  std::vector<PointId> ids;
  Eigen::VectorXd value;       // two entries a measurement, px
  Eigen::MatrixXd covariance;  // S
};

class Filter {
 public:
  // Room for so many points of three rows beside the camera. `pixel_sigma`: of a measurement, px.
  Filter(const Camera& camera, int most_points, double pixel_sigma);

  // Forgets everything.
  void start(const CameraState& state, const CameraCovariance& covariance);

  void predict(double seconds, const MotionNoise& noise,
               const std::optional<CameraControl>& control);

  // Nothing when there is no room, as for all that add.
  std::optional<PointId> add_known(const Eigen::Vector3d& point_in_world, double sigma);
  // A ray through a pixel; a point on it at a distance; the inverse of the distance as a row.
  std::optional<PointId> add_ray(const Eigen::Vector2d& pixel);
  std::optional<PointId> add_point(const Eigen::Vector2d& pixel, double distance, double sigma);
  std::optional<PointId> add_inverse_depth(const Eigen::Vector2d& pixel, double inverse_distance,
                                           double sigma);
  // Points as read from a file, with their joint covariance (three rows each).
  std::vector<PointId> add_map(const std::vector<Eigen::Vector3d>& points_in_world,
                               const Eigen::MatrixXd& covariance);
  void remove(PointId id);
  // A ray whose distance has been found, independently of the filter.
  void fix_distance(PointId id, double distance, double sigma);
  // A point with inverse depth becomes one of three rows.
  void make_position(PointId id);

  // Not of rays. Nothing when the point cannot be seen.
  std::optional<Prediction> predict(PointId id) const;
  std::optional<Prediction> predict_along(PointId ray, double distance) const;

  // Largest uncertainty first or any order; at most kMostMeasurements.
  const JointInnovation& innovation(const std::vector<Measurement>& measurements);
  // Takes those measurements of the last innovation() whose indices are given into the state.
  void update(const std::vector<int>& chosen);

  void observe_turning(const Turning& turning);

  // The camera is somewhere else, and what was known about its place is void; the map stays.
  void replace_camera(const CameraState& state, const CameraCovariance& covariance);

  const CameraState& camera_state() const { return state_; }
  const Camera& camera() const { return camera_; }
  double pixel_sigma() const { return pixel_sigma_; }
  CameraCovariance camera_covariance() const;
  const Point& point(PointId id) const { return slot(id).point; }
  std::vector<PointId> ids() const;  // oldest first
  int rows() const { return rows_; }
  bool has_room(int rows) const { return rows_ + rows <= capacity_; }
  // Of the camera and all points, in the order of ids().
  Eigen::MatrixXd covariance() const;
  // Of a ray: of its origin.
  Eigen::Matrix3d position_covariance(PointId id) const;
  // Of points of three rows, in this order.
  Eigen::MatrixXd joint_covariance(const std::vector<PointId>& ids) const;
  double inverse_depth_sigma(PointId id) const;  // 1/m
  double trace() const;

  static constexpr int kMostMeasurements = 64;

 private:
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  struct Slot {
    PointId id;
    int row;  // its first one
    Point point;
  };

  const Slot& slot(PointId id) const;
  Slot& slot(PointId id);
  auto rows_of_p(int first, int count) { return p_.block(first, 0, count, rows_); }
  PointId append(const Point& point);
  PointId append_from_camera(const Point& point,
                             const Eigen::Matrix<double, -1, kCameraRows>& by_camera,
                             const Eigen::MatrixXd& own);
  void reduce_to_position(Slot& slot, const Eigen::Matrix<double, 3, -1>& by_old,
                          const Eigen::Vector3d& position, const Eigen::Matrix3d& added);
  void erase_rows(int first, int count);
  void mirror_rows(int first, int count);
  std::optional<Prediction> predicted(const Slot& slot,
                                      const std::optional<Sighting>& sighting) const;
  void correct_state(const Eigen::VectorXd& correction);

  Camera camera_;
  double pixel_sigma_;
  int capacity_;  // rows
  CameraState state_;
  std::vector<Slot> slots_;  // in the order of their rows
  PointId next_id_ = 1;
  int rows_ = kCameraRows;
  RowMajor p_;
  RowMajor scratch_;   // kCameraRows rows of the covariance
  RowMajor stacked_;   // H P of the last innovation
  RowMajor weighted_;  // L^-1 H P of the chosen ones
  JointInnovation joint_;
  int stacked_rows_ = 0;
};

}  // namespace armsreach::mono_slam
