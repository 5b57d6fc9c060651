// What is really so at the instant of a frame, known of simulated sensors and of their recordings.
// Measures results; nothing that makes them may look at it, which is why vision cannot include it.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

#include "vision/core/gimbal.hpp"
#include "vision/core/pose.hpp"

namespace armsreach {

struct TrueThing {
  std::string name;
  int mask = 0;  // its value in Truth::masks
  Pose world_from_thing;
};

constexpr std::size_t kTrueHandJoints = 25;

struct TrueHand {
  std::string name;     // "right hand"
  int mask = 0;         // its value in Truth::masks; 0: it is not drawn
  std::string gesture;  // empty on the way from one to another
  std::string holds;    // the thing that goes with it, or empty
  // Wrist; then of thumb, index, middle, ring and little finger from the palm out.
  std::array<Pose, kTrueHandJoints> world_from_joint;
};

struct TrueMarker {
  std::string name;
  Eigen::Vector3d point_in_world{0, 0, 0};
  double visible = 0;  // share of it that the camera sees
};

struct Truth {
  Pose world_from_camera;
  std::optional<GimbalState> gimbal;
  cv::Mat depth;  // CV_32F m along z, NaN where the world is open; or empty
  cv::Mat masks;  // CV_16U, 0: nothing; or empty
  std::vector<TrueThing> things;
  std::vector<TrueHand> hands;
  std::vector<TrueMarker> markers;
  // What touches: things, of which at least one moves, and things with parts of hands, such as
  // "right hand/index" (thumb, index, middle, ring, little, palm, arm).
  std::vector<std::pair<std::string, std::string>> contacts;
};

}  // namespace armsreach
