// Finds the colour camera of a depth camera from what both see: occluding contours of the depth
// images lie on edges of the colour images where the guess at the colour camera is right.
//
// A coarse search over focal length, centre and baseline through a wide Gaussian, then a simplex,
// with roll, through narrower ones. Coinciding cameras (registered images) are a guess like any
// other, kept when they explain nearly as much as the best. Contours over a narrow range of depths
// tell the baseline only to within a centimetre, and too short, so the baselines that such sensors
// have (25 mm, give or take 5) weigh about as much. Whether an answer can be relied on is judged by
// a jackknife over parts of the image, by what it owes to those usual figures, and by how well the
// best guess elsewhere does.
#pragma once

#include <optional>
#include <vector>

#include "vision/core/frame.hpp"
#include "vision/registration/color_search.hpp"

namespace armsreach {

enum class Registration {
  registered,   // colour and depth pixels coincide, as far as can be seen
  estimated,    // they do not, and this is the colour camera
  cannot_tell,  // too little structure so far
};

struct RegistrationVerdict {
  Registration registration = Registration::cannot_tell;
  ColorCamera color;         // the best guess, whatever the verdict; if registered, that they are
  ColorSearchResult search;  // that it came from
  int frames = 0;            // given so far
};

struct RegistrationOptions {
  int stride = 3;  // every so many frames one is looked at
  int views = 20;  // looked at before the first attempt; each later one waits for twice as many
  int most_views = 60;  // that are kept, the newest
};

class ColorCameraEstimator {
 public:
  // `assumed` is the colour camera if the images are registered.
  ColorCameraEstimator(const Camera& depth, const Camera& assumed,
                       RegistrationOptions options = {});

  // Frames in the order of time. Answers `cannot_tell` at most once, after the first attempt that
  // fails, and goes on; any other answer is the last.
  std::optional<RegistrationVerdict> add(const Frame& frame);

  bool done() const { return done_; }

 private:
  void keep(const Frame& frame);
  RegistrationVerdict attempt() const;

  Camera depth_;
  Camera assumed_;
  RegistrationOptions options_;
  std::vector<ContourView> views_;
  int frames_ = 0;
  int looked_at_ = 0;
  int next_attempt_ = 0;
  bool told_ = false;
  bool done_ = false;
};

}  // namespace armsreach
