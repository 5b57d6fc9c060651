// The scene: everything that is drawn, as plain data. A Scene is an immutable snapshot composed by
// the application; render/ knows nothing of where it came from. Metres, world frame unless named
// otherwise; pixels are those of `background`.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

#include "vision/core/camera.hpp"
#include "vision/core/pose.hpp"

namespace armsreach::render {

enum class FeatureState { candidate, tracked, failed };

// A point measured in the image, with the 2x2 covariance of where it was expected.
struct Feature {
  Eigen::Vector2f pixel;
  Eigen::Matrix2f covariance;  // px^2; zero draws a dot
  FeatureState state = FeatureState::tracked;
};

// A point of a sparse map, with the 3x3 covariance of where it is.
struct MapPoint {
  Eigen::Vector3f point_in_world;
  Eigen::Matrix3f covariance;  // m^2
  FeatureState state = FeatureState::tracked;
};

// One guess of where a point may be that is not yet known.
struct Particle {
  Eigen::Vector3f point_in_world;
  float weight = 1;  // 0..1
};

struct Cursor {
  Eigen::Vector2f pixel;
  bool pressed = false;
  std::string caption;
};

// A hand as it was seen in the image.
struct Hand {
  std::vector<Eigen::Vector2f> outline;  // closed; may be empty
  Eigen::Vector2f center{0, 0};
  float size = 0;             // px, the root of its area
  float angle = 0;            // rad, 0 with the fingers up, clockwise
  std::string gesture;        // empty: none can be told
  float score = 0;            // how well it matches, up to 1
  Eigen::Vector2f tip{0, 0};  // what its axis goes through: a fingertip, or the centre
  float wedge = 0;            // rad, half the angle that a grasp points at along its axis; 0: none
  std::vector<float> rings;   // px, radii that its detector looks at; empty: not shown
};

// A thing in the image that is known by name.
struct Mark {
  std::string text;
  Eigen::Vector2f corner{0, 0};  // of its box
  Eigen::Vector2f size{0, 0};
  bool highlighted = false;  // pointed at
};

// An inserted thing. Its mesh is one of render::mesh_names(): at scale 1 of the size of things that
// stand on a table (the teapot is 15 cm high), z up, standing on z = 0.
struct VirtualObject {
  std::int64_t id = 0;
  std::string mesh;
  Pose world_from_object;
  double scale = 1;
  bool selected = false;
};

struct Label {
  std::string text;
  Eigen::Vector3d point_in_world;
};

struct Trail {
  std::vector<Eigen::Vector3f> points_in_world;
  Eigen::Vector3f color{1, 1, 1};  // 0..1
};

// One block of mapped surface. Blocks are shared between snapshots: the same pointer means the same
// content, so that only what changed is uploaded.
struct SurfacePoint {
  Eigen::Vector3f point_in_world;
  std::array<std::int8_t, 3> normal;  // unit * 127, towards the free side
  std::uint8_t intensity = 0;
};
struct SurfaceBlock {
  std::array<int, 3> key;  // unique within a surface
  float size = 0;          // edge of one surface element, m
  std::vector<SurfacePoint> points;
};
using SurfaceBlockPtr = std::shared_ptr<const SurfaceBlock>;

struct Surface {
  std::uint64_t revision = 0;
  std::vector<SurfaceBlockPtr> blocks;  // in a stable order
};
using SurfacePtr = std::shared_ptr<const Surface>;

enum class Severity { info, warning, error };
struct Message {
  Severity severity = Severity::info;
  std::string text;
};

// Rows of the statistics table in the panels.
struct StageRow {
  std::string name;
  std::int64_t frames = 0;
  std::int64_t drops = 0;
  double p50 = 0;  // s
  double p95 = 0;
  double p99 = 0;
};

struct Scene {
  std::int64_t frame = -1;
  double time = 0;         // s, source time of the frame
  cv::Mat background;      // CV_8UC3 BGR or CV_8UC1, the video frame everything belongs to
  Camera camera;           // of the background, with its distortion
  Pose world_from_camera;  // of the background's camera, at the time of the frame
  bool pose_known = false;
  cv::Mat depth;    // CV_32F along z in the background's camera, any size with its aspect;
                    // NaN unknown; hides virtual objects behind it; may be empty
  cv::Mat inliers;  // CV_32F 0..1, the tracker's weights; may be empty

  std::vector<Feature> features;
  std::vector<Hand> hands;
  std::vector<Mark> marks;
  std::vector<Cursor> cursors;
  std::vector<VirtualObject> objects;
  std::vector<Label> labels;
  std::vector<Trail> trails;  // the camera's trajectory among them
  SurfacePtr surface;
  std::vector<MapPoint> points;  // of a sparse map
  std::vector<Particle> particles;
  bool world_axes = false;  // shown in the map, 10 cm long
  // Against gravity, for the views of the map; zero where nobody knows: then it is guessed from the
  // surface's normals.
  Eigen::Vector3d up_in_world{0, 0, 0};

  std::string tracking_state;  // "tracking", ...; empty where nobody tracks
  double tracking_rms = 0;
  int tracking_inliers = 0;
  double frame_rate = 0;  // Hz
  double latency = 0;     // s, from frame to drawn overlay
  std::vector<StageRow> stages;
  std::vector<Message> messages;  // newest last
};
using ScenePtr = std::shared_ptr<const Scene>;

}  // namespace armsreach::render
