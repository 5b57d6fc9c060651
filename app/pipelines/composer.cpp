#include "app/pipelines/composer.hpp"

#include <algorithm>
#include <utility>

#include <opencv2/imgproc.hpp>

#include "app/pipelines/background.hpp"
#include "app/pipelines/hands_scene.hpp"
#include "app/pipelines/mono_scene.hpp"
#include "render/room.hpp"
#include "vision/core/pyramid.hpp"
#include "vision/core/registration.hpp"

namespace armsreach::app {
namespace {

constexpr float kTrailStep = 0.01F;                // m between kept points of the camera's trail
constexpr Timestamp kMessageTime = 4'000'000'000;  // ns that a message is shown
constexpr size_t kLongestTrail = 4000;             // points
constexpr size_t kEventsKept = 64;      // more than a person can cause while scenes are skipped
constexpr int kOcclusionReduction = 2;  // depth is compared at half the video's resolution

// A camera without colour still shows something: its depth, near bright, 4 m dark.
cv::Mat picture_of_depth(const cv::Mat& depth) {
  cv::Mat grey;
  depth.convertTo(grey, CV_8U, -60, 255);
  grey.setTo(0, depth != depth);
  return grey;
}

render::Severity severity_of(const Event& event) {
  return std::holds_alternative<FaultEvent>(event.body) ? render::Severity::warning
                                                        : render::Severity::info;
}

// What is worth a line of text; the rest is shown where it happens, the tracking's state as such,
// and what is said is about an event that is shown itself.
struct BodyToText {
  std::string operator()(const InsertEvent& e) const { return e.object + " inserted"; }
  std::string operator()(const MoveEvent& e) const { return e.object + " moved"; }
  std::string operator()(const DeleteEvent& e) const { return e.object + " deleted"; }
  std::string operator()(const GazeEvent& e) const {
    return std::string("gaze: ").append(armsreach::name(e.mode)).append(" ").append(e.target);
  }
  std::string operator()(const AcceptEvent&) const { return "accepted"; }
  std::string operator()(const RejectEvent&) const { return "rejected"; }
  std::string operator()(const FaultEvent& e) const { return e.message; }
  template <class Shown>
  std::string operator()(const Shown&) const {
    return "";
  }
};

Viewer viewer_of(const TrackedFrame& tracked, const render::Scene& scene) {
  // A few points of a sparse map cannot tell a wall from the things on a table.
  const auto up = scene.surface ? render::known_up(scene) : std::nullopt;
  return {tracked.world_from_camera.translation(), up};
}

}  // namespace

void UserInput::add(const UserInput& more) {
  clicks.insert(clicks.end(), more.clicks.begin(), more.clicks.end());
  faults.insert(faults.end(), more.faults.begin(), more.faults.end());
  delete_selected |= more.delete_selected;
}

Composer::Composer(const EventLog& log, Placement placement, HandInteraction hands,
                   StageRows stage_rows, Latency latency)
    : log_(log),
      stage_rows_(std::move(stage_rows)),
      latency_(std::move(latency)),
      placement_(std::move(placement)),
      hands_(std::move(hands)) {}

ComposedPtr Composer::process(const ComposeInput& input) {
  for (const UserInput& user : input.user) pending_.add(user);
  news_.insert(news_.end(), input.news.begin(), input.news.end());
  if (!input.tracked) return nullptr;  // the tracker failed on this frame and has said so
  const TrackedFrame& tracked = *input.tracked;
  const WorldView* world = input.map ? input.map->view.get() : tracked.world.get();

  auto composed = std::make_shared<Composed>();
  composed->arrival = tracked.frame->arrival;
  if (input.registration != registration_) {
    registration_ = input.registration;
    if (registration_->fault) tell({tracked.frame->time, *registration_->fault});
  }
  auto scene = std::make_shared<render::Scene>();
  add_video(tracked, scene.get());
  add_tracking(tracked, scene.get());
  if (input.map) scene->surface = input.map->surface;
  for (const HandNews& news : std::exchange(news_, {})) apply(news, world, tracked, *scene);
  apply(std::exchange(pending_, {}), world, tracked, *scene);
  composed->events = events_;
  composed->events_before = events_told_ - static_cast<std::int64_t>(events_.size());
  if (tracked.mono) add_sparse_map(tracked, scene.get());
  add_objects(world, scene.get());
  if (input.hands) add_hands(*input.hands, scene.get());
  add_messages(tracked.frame->time, scene.get());
  measure_rate(tracked.frame->arrival);
  scene->frame_rate = frame_rate_;
  scene->latency = latency_();
  scene->stages = stage_rows_();
  composed->scene = std::move(scene);
  return composed;
}

// The background, its camera and the depth that hides things, all of one instant.
void Composer::add_video(const TrackedFrame& tracked, render::Scene* scene) {
  const Frame& frame = *tracked.frame;
  scene->frame = frame.index;
  scene->time = seconds_from_timestamp(frame.time);
  scene->background = frame.color.empty() ? picture_of_depth(frame.depth) : frame.color;
  const BackgroundCamera background = background_camera(frame);
  scene->camera = background.camera;
  scene->world_from_camera =
      tracked.world_from_camera * background.background_from_camera.inverse();
  if (frame.depth.empty()) return;
  const cv::Mat depth = reduced_depth(frame.depth, kOcclusionReduction);
  if (background.sees_depth) {
    scene->depth = depth;
    return;
  }
  const Camera target = resized(scene->camera, scene->camera.width / kOcclusionReduction,
                                scene->camera.height / kOcclusionReduction);
  scene->depth =
      registered_depth(depth, resized(*frame.sensor->depth_camera, depth.cols, depth.rows), target,
                       background.background_from_camera);
}

void Composer::add_tracking(const TrackedFrame& tracked, render::Scene* scene) {
  scene->pose_known = pose_known(tracked);
  if (tracked.state == TrackingState::untracked) return;
  scene->tracking_state = armsreach::name(tracked.state);
  scene->tracking_rms = tracked.rms;
  scene->tracking_inliers = tracked.inliers;
  scene->inliers = tracked.weights;
  scene->up_in_world = tracked.up_in_world;
  if (scene->pose_known && tracked.pose_seen) {
    const Eigen::Vector3f here = tracked.world_from_camera.translation().cast<float>();
    if (camera_trail_.empty() || (here - camera_trail_.back()).norm() > kTrailStep) {
      camera_trail_.push_back(here);
    }
    if (camera_trail_.size() > kLongestTrail) {
      camera_trail_.erase(camera_trail_.begin(), camera_trail_.begin() + kLongestTrail / 4);
    }
  }
  scene->trails.push_back({camera_trail_, {1.0F, 0.76F, 0.25F}});
}

void Composer::add_objects(const WorldView* world, render::Scene* scene) {
  for (const PlacedObject& object : placement_.objects()) {
    scene->objects.push_back({object.id, object.mesh, Placement::world_from_object(object, world),
                              1.0, object.selected});
  }
}

void Composer::add_messages(Timestamp now, render::Scene* scene) {
  for (const Event& event : log_.recent()) {
    if (now - event.time > kMessageTime) continue;
    const std::string text = std::visit(BodyToText{}, event.body);
    if (!text.empty()) scene->messages.push_back({severity_of(event), text});
  }
}

void Composer::apply(const HandNews& news, const WorldView* world, const TrackedFrame& tracked,
                     const render::Scene& scene) {
  for (const Event& event : news.events) tell(event);
  if (news.commands.empty()) return;
  const Viewer viewer = viewer_of(tracked, scene);
  for (const HandCommand& command : news.commands) {
    for (Event& event : hands_.act(command, &placement_, world, viewer, tracked.frame->time))
      tell(std::move(event));
  }
}

void Composer::apply(const UserInput& user, const WorldView* world, const TrackedFrame& tracked,
                     const render::Scene& scene) {
  const Timestamp time = tracked.frame->time;
  for (const FaultEvent& fault : user.faults) tell({time, fault});
  for (const Click& click : user.clicks) {
    for (Event& event : placement_.click(click, world, viewer_of(tracked, scene), time))
      tell(std::move(event));
  }
  if (!user.delete_selected) return;
  for (Event& event : placement_.remove_selected(world, time)) tell(std::move(event));
}

void Composer::tell(Event event) {
  events_.push_back(std::move(event));
  ++events_told_;
  if (events_.size() > kEventsKept) events_.erase(events_.begin());
}

void Composer::measure_rate(std::int64_t arrival) {
  if (last_arrival_ != 0 && arrival > last_arrival_) {
    const double rate = 1e9 / static_cast<double>(arrival - last_arrival_);
    constexpr double kSmoothing = 0.1;
    frame_rate_ = frame_rate_ == 0 ? rate : frame_rate_ + kSmoothing * (rate - frame_rate_);
  }
  last_arrival_ = arrival;
}

}  // namespace armsreach::app
