#include "vision/mono_slam/consensus.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>

namespace armsreach::mono_slam {
namespace {

using Eigen::Matrix2d;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

// Those within the tolerance of where measurement `one` puts them; always `one` itself.
std::vector<int> supporters(const JointInnovation& joint, int one, double tolerance) {
  std::vector<int> out;
  const Matrix2d s = joint.covariance.block<2, 2>(2 * one, 2 * one);
  const Vector2d weighted = s.inverse() * joint.value.segment<2>(2 * one);
  const int count = static_cast<int>(joint.ids.size());
  for (int i = 0; i < count; ++i) {
    const Vector2d left =
        joint.value.segment<2>(2 * i) - joint.covariance.block<2, 2>(2 * i, 2 * one) * weighted;
    if (i == one || left.squaredNorm() < tolerance * tolerance) out.push_back(i);
  }
  return out;
}

// Rows of the chosen measurements of a matrix with two rows a measurement.
MatrixXd chosen_rows(const MatrixXd& all, const std::vector<int>& chosen) {
  MatrixXd out(2 * static_cast<Eigen::Index>(chosen.size()), all.cols());
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    out.middleRows<2>(2 * static_cast<Eigen::Index>(i)) = all.middleRows<2>(2 * chosen[i]);
  }
  return out;
}

// Those that fit what the chosen ones together say, within what that leaves uncertain. A chosen one
// is judged by what is left of its own innovation.
std::vector<int> fitting(const JointInnovation& joint, const std::vector<int>& chosen,
                         double pixel_sigma, const ConsensusOptions& options) {
  const MatrixXd rows = chosen_rows(joint.covariance, chosen);
  const MatrixXd s = chosen_rows(rows.transpose(), chosen);
  const Eigen::LLT<MatrixXd> factor(s);
  const MatrixXd weighted = factor.matrixL().solve(rows);
  const VectorXd value = factor.matrixL().solve(chosen_rows(joint.value, chosen));
  const double noise = pixel_sigma * pixel_sigma;

  std::vector<int> out;
  std::size_t next = 0;
  for (int i = 0; i < static_cast<int>(joint.ids.size()); ++i) {
    const auto own = weighted.middleCols<2>(2 * i);
    const Vector2d left = joint.value.segment<2>(2 * i) - own.transpose() * value;
    if (next < chosen.size() && chosen[next] == i) {
      ++next;
      // Its own noise is in both s and rows: what is left is noise * s^-1 * innovation.
      const double limit = options.pixel_tolerance * options.pixel_tolerance;
      if (left.squaredNorm() < limit) out.push_back(i);
      continue;
    }
    const Matrix2d uncertain = joint.covariance.block<2, 2>(2 * i, 2 * i) - own.transpose() * own +
                               1e-9 * noise * Matrix2d::Identity();
    if (left.dot(uncertain.inverse() * left) < options.gate) out.push_back(i);
  }
  return out;
}

}  // namespace

std::vector<int> consensus(const JointInnovation& innovation, double pixel_sigma,
                           const ConsensusOptions& options) {
  std::vector<int> best;
  const int count = static_cast<int>(innovation.ids.size());
  for (int i = 0; i < count; ++i) {
    std::vector<int> agreeing = supporters(innovation, i, options.pixel_tolerance);
    if (agreeing.size() > best.size()) best = std::move(agreeing);
  }
  // One that disagrees with all others is as likely wrong as they are.
  if (best.size() < 2) return count == 1 ? best : std::vector<int>();
  return fitting(innovation, best, pixel_sigma, options);
}

}  // namespace armsreach::mono_slam
