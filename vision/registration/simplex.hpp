// Downhill simplex: a minimum of a function whose derivatives are not worth having.
// Source: Nelder and Mead, "A simplex method for function minimization", Computer Journal 1965.
#pragma once

#include <functional>

#include <Eigen/Core>

namespace armsreach {

using SimplexFunction = std::function<double(const Eigen::VectorXd&)>;

struct SimplexMinimum {
  Eigen::VectorXd at;
  double value = 0;
};

// Starts from `start` and steps of `size` along each axis; ends when the simplex is smaller than
// `precision`, or after `most_steps`.
SimplexMinimum minimise(const SimplexFunction& function, const Eigen::VectorXd& start, double size,
                        double precision, int most_steps);

}  // namespace armsreach
