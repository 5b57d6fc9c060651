#include "vision/registration/simplex.hpp"

#include <algorithm>
#include <vector>

namespace armsreach {
namespace {

bool lower(const SimplexMinimum& a, const SimplexMinimum& b) { return a.value < b.value; }

}  // namespace

SimplexMinimum minimise(const SimplexFunction& function, const Eigen::VectorXd& start, double size,
                        double precision, int most_steps) {
  const auto evaluated = [&](const Eigen::VectorXd& at) {
    return SimplexMinimum{at, function(at)};
  };
  std::vector<SimplexMinimum> corners = {evaluated(start)};
  for (Eigen::Index axis = 0; axis < start.size(); ++axis) {
    corners.push_back(evaluated(start + size * Eigen::VectorXd::Unit(start.size(), axis)));
  }
  for (int step = 0; step < most_steps; ++step) {
    std::sort(corners.begin(), corners.end(), lower);
    const SimplexMinimum& best = corners.front();
    SimplexMinimum& worst = corners.back();
    if ((worst.at - best.at).lpNorm<Eigen::Infinity>() < precision) break;
    Eigen::VectorXd middle = Eigen::VectorXd::Zero(start.size());
    for (std::size_t i = 0; i + 1 < corners.size(); ++i) middle += corners[i].at;
    middle /= static_cast<double>(start.size());
    const auto along = [&](double t) { return evaluated(middle + t * (worst.at - middle)); };
    const SimplexMinimum reflected = along(-1);
    if (lower(reflected, best)) {
      worst = std::min(reflected, along(-2), lower);
    } else if (lower(reflected, corners[corners.size() - 2])) {
      worst = reflected;
    } else if (const SimplexMinimum inner = along(0.5); lower(inner, worst)) {
      worst = inner;
    } else {
      for (std::size_t i = 1; i < corners.size(); ++i) {
        corners[i] = evaluated(0.5 * (corners[i].at + best.at));
      }
    }
  }
  return *std::min_element(corners.begin(), corners.end(), lower);
}

}  // namespace armsreach
