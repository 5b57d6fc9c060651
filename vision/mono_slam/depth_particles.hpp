// The distance of a new point along its ray, as weighted guesses (factored sampling): each predicts
// where the point is seen, and each measurement weighs them anew.
// Source: Davison, Reid, Molton, Stasse, "MonoSLAM", PAMI 2007, section 3.6.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "vision/mono_slam/filter.hpp"

namespace armsreach::mono_slam {

struct DepthParticle {
  double distance;  // m
  double weight;    // sums to 1
};

class DepthParticles {
 public:
  // Evenly between two distances.
  DepthParticles(int count, double nearest, double farthest);

  // Where each one's point is seen; nothing for those that are out of view.
  struct Hypothesis {
    std::size_t particle;
    Prediction prediction;
  };
  std::vector<Hypothesis> predict(const Filter& filter, PointId ray) const;

  // Bayes' rule; then those below `prune` / count of the weight are dropped.
  void weigh(const std::vector<Hypothesis>& hypotheses, const Eigen::Vector2d& pixel, double prune);

  const std::vector<DepthParticle>& particles() const { return particles_; }
  double mean() const;
  double sigma() const;

 private:
  std::vector<DepthParticle> particles_;
};

}  // namespace armsreach::mono_slam
