// The update of an extended Kalman filter as textbooks print it, with dense matrices of Eigen: the
// peer of our filter's.
#pragma once

#include <Eigen/Core>

namespace armsreach {

struct TextbookEkf {
  Eigen::VectorXd state;
  Eigen::MatrixXd covariance;

  // x += K v, P = (I - K H) P with K = P H^T (H P H^T + R)^-1.
  void update(const Eigen::MatrixXd& jacobian, const Eigen::VectorXd& innovation, double variance);
};

}  // namespace armsreach
