// Whether an alignment is to be believed. No absolute residual tells, since residuals scale with
// the sensor, the map and the resolution: what counts is how many pixels take part and agree,
// whether they determine the motion, and how large the residuals are beside those of this run so
// far.
#pragma once

#include "vision/alignment/aligner.hpp"

namespace armsreach {

class Verdict {
 public:
  // Of a camera that was followed to where it is.
  bool trusts(const AlignmentResult& alignment, int pixels) const;
  // Of a pose that nothing but the alignment speaks for: the views must overlap well, and depth and
  // intensity, whatever their weight, must each fit about as closely as usual.
  bool confirms(const AlignmentResult& alignment, int pixels) const;
  // Learns the usual residuals from an alignment that was trusted.
  void learn(const AlignmentResult& alignment);
  // Residuals beside the usual ones: about 1 when all is well.
  double relative_rms(const AlignmentResult& alignment) const;

 private:
  struct Demands {
    double overlap;          // least share of all pixels that are compared
    double surprise;         // greatest residuals beside the usual ones
    ResidualScales unknown;  // greatest residuals while none are usual
  };
  static const Demands kFollowed;
  static const Demands kFound;
  struct Usual {
    double scale = 0;
    int frames = 0;  // it was learnt from
  };

  static bool meets(const Demands& demands, const AlignmentResult& alignment, int pixels);
  ResidualScales suspicious(const Demands& demands) const;

  Usual depth_;
  Usual intensity_;
};

}  // namespace armsreach
