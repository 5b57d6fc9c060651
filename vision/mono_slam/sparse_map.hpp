// What a session leaves behind of its map: points, their looks and their joint covariance; and the
// codec of it, so that the place can be entered again another day.
//
// "ARSPARS1", then little-endian values without padding: the number of points n (u32) and for each:
// position (3 f64), whether it belongs to a start target (u8), attempts and successes (u32), and of
// its patch: size (i32), pixel (2 f64), normal (3 f64), world_from_camera (qx qy qz qw tx ty tz,
// f64), 33 lines of 33 grey values (u8); then the lower triangle of the 3n x 3n covariance by rows
// (f64).
#pragma once

#include <istream>
#include <ostream>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "vision/core/result.hpp"
#include "vision/mono_slam/landmark.hpp"

namespace armsreach::mono_slam {

struct SparseMap {
  std::vector<Landmark> landmarks;  // their ids are void
  std::vector<Eigen::Vector3d> points_in_world;
  Eigen::MatrixXd covariance;
};

// The stream's state tells whether it could be written.
void write_sparse_map(std::ostream& out, const SparseMap& map);

// `where` names the stream in errors. A stream that ends early, or has positions, poses, patches or
// a covariance that cannot be, is an error.
Result<SparseMap> read_sparse_map(std::istream& in, const std::string& where);

}  // namespace armsreach::mono_slam
