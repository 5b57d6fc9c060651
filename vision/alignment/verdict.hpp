// Whether an alignment is to be believed. No absolute residual tells, since residuals scale with
// the sensor, the map and the resolution: what counts is how many pixels take part and agree,
// whether they determine the motion, and how large the residuals are beside those of this run so
// far.
#pragma once

#include "vision/alignment/aligner.hpp"

namespace armsreach {

class Verdict {
 public:
  explicit Verdict(double alpha) : alpha_(alpha) {}

  bool trusts(const AlignmentResult& alignment, int pixels) const;
  // The same for a pose that nothing but the alignment speaks for: the views must overlap well and
  // fit about as closely as usual.
  bool confirms(const AlignmentResult& alignment, int pixels) const;
  // Learns the usual residuals from an alignment that was trusted.
  void learn(const AlignmentResult& alignment);
  // Residuals beside the usual ones: about 1 when all is well.
  double relative_rms(const AlignmentResult& alignment) const;

 private:
  bool fits(const AlignmentResult& alignment, int pixels, double least_compared,
            const ResidualScales& suspicious) const;
  ResidualScales suspicious(double surprise) const;

  double alpha_;
  ResidualScales usual_;
  int learnt_ = 0;
};

}  // namespace armsreach
