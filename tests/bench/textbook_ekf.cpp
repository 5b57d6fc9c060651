#include "tests/bench/textbook_ekf.hpp"

#include <Eigen/LU>

namespace armsreach {

using Eigen::MatrixXd;

void TextbookEkf::update(const MatrixXd& jacobian, const Eigen::VectorXd& innovation,
                         double variance) {
  const auto rows = state.size();
  const MatrixXd s = jacobian * covariance * jacobian.transpose() +
                     variance * MatrixXd::Identity(innovation.size(), innovation.size());
  const MatrixXd gain = covariance * jacobian.transpose() * s.inverse();
  state += gain * innovation;
  covariance = (MatrixXd::Identity(rows, rows) - gain * jacobian) * covariance;
}

}  // namespace armsreach
