// What a session leaves behind of its map: points, their looks and their joint covariance; and the
// codec of it, so that the place can be entered again another day.
//
// "ARSPARS2", then little-endian values without padding: the camera (width, height, distortion
// model as in core/camera.hpp, i32; fx fy cx cy and eight coefficients, f64), the number of points
// n (u32) and for each: position (3 f64), whether it belongs to a start target (u8), attempts and
// successes (u32), and of its patch: size (i32), pixel (2 f64), normal (3 f64), world_from_camera
// (qx qy qz qw tx ty tz, f64), 33 lines of 33 grey values (u8); then the lower triangle of the 3n x
// 3n covariance by rows (f64).
#pragma once

#include <istream>
#include <ostream>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "vision/core/camera.hpp"
#include "vision/core/result.hpp"
#include "vision/mono_slam/landmark.hpp"

namespace armsreach::mono_slam {

struct SparseMap {
  Camera camera;                    // that the patches were seen by
  std::vector<Landmark> landmarks;  // their ids are void
  std::vector<Eigen::Vector3d> points_in_world;
  Eigen::MatrixXd covariance;
};

// The stream's state tells whether it could be written.
void write_sparse_map(std::ostream& out, const SparseMap& map);

// `where` names the stream in errors. A stream that ends early or goes on after the map, or has a
// camera, positions, poses, patches or a covariance that cannot be, is an error; so is a map of the
// first version of the format, which does not say what camera it is of.
Result<SparseMap> read_sparse_map(std::istream& in, const std::string& where);

// Patches and directions are of the camera that saw them: to another one the map is another world.
// An error that says how they differ, or nothing. `where` names the map.
Status check_same_camera(const SparseMap& map, const Camera& camera, const std::string& where);

}  // namespace armsreach::mono_slam
