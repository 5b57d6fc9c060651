#include "app/evaluation/gaze_figures.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include <nlohmann/json.hpp>

namespace armsreach::app {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kSettling = 1;          // s, at the start
constexpr double kWithin = 1 * kDegree;  // has arrived
constexpr double kSide = 0.5 * kDegree;  // is on one side
constexpr double kLeap = 5 * kDegree;    // between two frames
constexpr double kStill = 1 * kDegree;   // of a target that stands, in the mount
constexpr double kWatched = 1;           // s after a leap

double angle_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

// From when on all samples of [begin, end) are within a degree, or nothing.
std::optional<double> settled(const std::vector<GazeSample>& samples, std::size_t begin,
                              std::size_t end) {
  std::size_t first = end;
  while (first > begin && samples[first - 1].off < kWithin) --first;
  if (first == end) return std::nullopt;
  return samples[first].time - samples[begin].time;
}

// The samples after a leap at `leap`, while the target stands; too few when it goes on.
std::size_t end_of_rest(const std::vector<GazeSample>& samples, std::size_t leap) {
  std::size_t end = leap;
  while (end < samples.size() &&
         angle_between(samples[end].direction, samples[leap].direction) < kStill)
    ++end;
  return end;
}

// Bearings along the way of the leap: positive while the axis has not yet come to the target.
void add_swing(const std::vector<GazeSample>& samples, std::size_t leap, std::size_t end,
               StepFigures& figures) {
  const Eigen::Vector2d way = samples[leap].bearing.normalized();
  int side = 1;
  int crossings = 0;
  for (std::size_t i = leap; i < end; ++i) {
    const double left = samples[i].bearing.dot(way);
    figures.overshoot = std::max(figures.overshoot, -left);
    if (std::abs(left) < kSide) continue;
    crossings += (left > 0) != (side > 0);
    side = left > 0 ? 1 : -1;
  }
  figures.crossings = std::max(figures.crossings, crossings);
}

}  // namespace

HoldFigures hold_figures(const GazeRun& run) {
  HoldFigures figures;
  double count = 0;
  for (std::size_t i = 1; i < run.samples.size(); ++i) {
    const GazeSample& sample = run.samples[i];
    const GazeSample& before = run.samples[i - 1];
    if (sample.time < kSettling) continue;
    const double seconds = sample.time - before.time;
    const double turned = angle_between(sample.direction, before.direction);
    ++count;
    figures.central += sample.central;
    figures.rms += sample.off * sample.off;
    figures.largest = std::max(figures.largest, sample.off);
    figures.torsion_rms += sample.torsion * sample.torsion;
    figures.mount_speed +=
        (sample.mount_in_world - before.mount_in_world).squaredNorm() / (seconds * seconds);
    if (turned > kLeap) continue;  // no motion but another place
    figures.bearing_speed = std::max(figures.bearing_speed, turned / seconds);
    figures.target_speed = std::max(
        figures.target_speed, (sample.target_in_world - before.target_in_world).norm() / seconds);
  }
  if (count == 0) return figures;
  figures.central /= count;
  figures.rms = std::sqrt(figures.rms / count);
  figures.torsion_rms = std::sqrt(figures.torsion_rms / count);
  figures.mount_speed = std::sqrt(figures.mount_speed / count);
  return figures;
}

StepFigures step_figures(const GazeRun& run) {
  StepFigures figures;
  const auto& samples = run.samples;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const double size = angle_between(samples[i].direction, samples[i - 1].direction);
    if (size < kLeap) continue;
    const std::size_t end = end_of_rest(samples, i);
    if (samples[end - 1].time - samples[i].time < kWatched) continue;
    ++figures.steps;
    figures.size = std::max(figures.size, size);
    add_swing(samples, i, end, figures);
    const double until_end = samples[end - 1].time - samples[i].time;
    figures.settled = std::max(figures.settled, settled(samples, i, end).value_or(until_end));
  }
  return figures;
}

std::vector<SaccadeFigures> saccade_figures(const GazeRun& run) {
  std::vector<SaccadeFigures> all;
  const auto& samples = run.samples;
  for (std::size_t begin = 0; begin < samples.size();) {
    std::size_t end = begin;
    while (end < samples.size() && samples[end].saccade == samples[begin].saccade) ++end;
    SaccadeFigures one;
    one.begins = samples[begin].time;
    one.off = samples[begin].off;
    one.beyond_edge = std::max(0.0, std::abs(samples[begin].bearing.x()) - run.half_width);
    one.arrived = settled(samples, begin, end);
    one.error = samples[end - 1].off;
    all.push_back(one);
    begin = end;
  }
  return all;
}

nlohmann::json json_from(const HoldFigures& f) {
  return {{"central", f.central},
          {"rms_deg", f.rms / kDegree},
          {"largest_deg", f.largest / kDegree},
          {"torsion_rms_deg", f.torsion_rms / kDegree},
          {"target_speed", f.target_speed},
          {"bearing_speed", f.bearing_speed},
          {"mount_speed_rms", f.mount_speed}};
}

nlohmann::json json_from(const StepFigures& f) {
  return {{"steps", f.steps},
          {"size_deg", f.size / kDegree},
          {"overshoot_deg", f.overshoot / kDegree},
          {"crossings", f.crossings},
          {"settled", f.settled}};
}

nlohmann::json json_from(const SaccadeFigures& f) {
  return {{"begins", f.begins},
          {"off_deg", f.off / kDegree},
          {"beyond_edge_deg", f.beyond_edge / kDegree},
          {"arrived", f.arrived ? nlohmann::json(*f.arrived) : nlohmann::json()},
          {"error_deg", f.error / kDegree}};
}

}  // namespace armsreach::app
