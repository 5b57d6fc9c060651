// Numeric derivatives, to check analytic ones against.
#pragma once

#include <Eigen/Core>

namespace armsreach::mono_slam::test {

// Central differences of a vector-valued function of a vector, at zero.
template <class Function>
Eigen::MatrixXd numeric_jacobian(const Function& f, Eigen::Index inputs, double step = 1e-6) {
  Eigen::MatrixXd out;
  for (Eigen::Index i = 0; i < inputs; ++i) {
    Eigen::VectorXd delta = Eigen::VectorXd::Zero(inputs);
    delta[i] = step;
    const Eigen::VectorXd slope = (f(delta) - f(-delta)) / (2 * step);
    if (out.size() == 0) out.resize(slope.size(), inputs);
    out.col(i) = slope;
  }
  return out;
}

}  // namespace armsreach::mono_slam::test
