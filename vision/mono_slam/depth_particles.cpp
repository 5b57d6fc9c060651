#include "vision/mono_slam/depth_particles.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

namespace armsreach::mono_slam {

DepthParticles::DepthParticles(int count, double nearest, double farthest) {
  for (int i = 0; i < count; ++i) {
    particles_.push_back(
        {nearest + (farthest - nearest) * i / std::max(count - 1, 1), 1.0 / count});
  }
}

std::vector<DepthParticles::Hypothesis> DepthParticles::predict(const Filter& filter,
                                                                PointId ray) const {
  std::vector<Hypothesis> out;
  out.reserve(particles_.size());
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    const auto prediction = filter.predict_along(ray, particles_[i].distance);
    if (prediction && filter.camera().contains(prediction->sighting.pixel)) {
      out.push_back({i, *prediction});
    }
  }
  return out;
}

void DepthParticles::weigh(const std::vector<Hypothesis>& hypotheses, const Eigen::Vector2d& pixel,
                           double prune) {
  std::vector<double> likelihood(particles_.size(), 0.0);
  for (const Hypothesis& h : hypotheses) {
    const Eigen::Vector2d error = pixel - h.prediction.sighting.pixel;
    const Eigen::Matrix2d& s = h.prediction.covariance;
    likelihood[h.particle] =
        std::exp(-0.5 * error.dot(s.inverse() * error)) / std::sqrt(s.determinant());
  }
  double sum = 0;
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    particles_[i].weight *= likelihood[i];
    sum += particles_[i].weight;
  }
  const double least = prune / static_cast<double>(particles_.size()) * sum;
  std::erase_if(particles_, [&](const DepthParticle& p) { return !(sum > 0) || p.weight < least; });
  sum = 0;
  for (const DepthParticle& p : particles_) sum += p.weight;
  for (DepthParticle& p : particles_) p.weight /= sum;
}

double DepthParticles::mean() const {
  double sum = 0;
  for (const DepthParticle& p : particles_) sum += p.weight * p.distance;
  return sum;
}

double DepthParticles::sigma() const {
  const double middle = mean();
  double sum = 0;
  for (const DepthParticle& p : particles_) sum += p.weight * std::pow(p.distance - middle, 2);
  return std::sqrt(sum);
}

}  // namespace armsreach::mono_slam
