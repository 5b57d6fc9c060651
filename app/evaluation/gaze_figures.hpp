// What a trial of the gaze says in figures.
#pragma once

#include <optional>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "app/evaluation/gaze_trial.hpp"

namespace armsreach::app {

// Frames of the first second, in which the camera gets there, do not count.
struct HoldFigures {
  double central = 0;        // share of the frames with the target in the central half
  double rms = 0;            // rad, off the target
  double largest = 0;        // rad
  double torsion_rms = 0;    // rad, off the horizon
  double target_speed = 0;   // m/s, the fastest
  double bearing_speed = 0;  // rad/s, the fastest at which the target moves round the mount
  double mount_speed = 0;    // m/s, rms
};
HoldFigures hold_figures(const GazeRun& run);

// Where the target leapt and then stood still for a second.
struct StepFigures {
  int steps = 0;
  double size = 0;       // rad, of the largest
  double overshoot = 0;  // rad, the worst, beyond where the target stands now
  int crossings = 0;     // the most: how often the axis went to the other side by over 0.5 degrees
  double settled = 0;    // s, the longest until it stayed within a degree
};
StepFigures step_figures(const GazeRun& run);

struct SaccadeFigures {
  double begins = 0;              // s
  double off = 0;                 // rad, at its beginning
  double beyond_edge = 0;         // rad, by which the target lay outside of the image sideways
  std::optional<double> arrived;  // s from its beginning until it stayed within a degree
  double error = 0;               // rad, at the end of its interval
};
std::vector<SaccadeFigures> saccade_figures(const GazeRun& run);

nlohmann::json json_from(const HoldFigures& figures);
nlohmann::json json_from(const StepFigures& figures);
nlohmann::json json_from(const SaccadeFigures& figures);

}  // namespace armsreach::app
