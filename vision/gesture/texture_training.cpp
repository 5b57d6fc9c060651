#include "vision/gesture/texture_training.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Core>

namespace armsreach::gesture {
namespace {

constexpr double kRidge = 0.003;  // on the weights, of the mean loss
constexpr int kRounds = 25;
constexpr double kSettled = 1e-9;  // change of the loss
constexpr double kLeastStep = 1e-9;
constexpr auto kSize = static_cast<Eigen::Index>(kTextureSize);

// Two rows an example, as it is and in the mirror; the last column 1.
struct Regression {
  Eigen::MatrixXd features;
  Eigen::VectorXd sign, weight;  // +1 a hand, -1 none; all weights add up to 1
};

// Its own share of half the weight, by kind. False where there is none of one kind.
bool balance(std::vector<TextureExample>* examples) {
  std::array<double, 2> sums{};
  for (const TextureExample& one : *examples) sums[one.hand ? 1 : 0] += one.weight;
  if (!(sums[0] > 0 && sums[1] > 0)) return false;
  for (TextureExample& one : *examples) one.weight /= 2 * sums[one.hand ? 1 : 0];
  return true;
}

Regression regression_from(const std::vector<TextureExample>& examples) {
  const auto rows = 2 * static_cast<Eigen::Index>(examples.size());
  Regression all{{rows, kSize + 1}, Eigen::VectorXd(rows), Eigen::VectorXd(rows)};
  Eigen::Index row = 0;
  for (const TextureExample& one : examples) {
    for (const TextureFeatures& features : {one.features, mirrored(one.features)}) {
      all.features.row(row).head(kSize) =
          Eigen::Map<const Eigen::VectorXf>(features.data(), kSize).cast<double>();
      all.features(row, kSize) = 1;
      all.sign[row] = one.hand ? 1 : -1;
      all.weight[row++] = one.weight / 2;
    }
  }
  return all;
}

double loss(const Regression& all, const Eigen::VectorXd& beta) {
  const Eigen::ArrayXd margin = all.sign.array() * (all.features * beta).array();
  return (all.weight.array() * (-margin).exp().log1p()).sum() +
         kRidge / 2 * beta.head(kSize).squaredNorm();
}

Eigen::VectorXd newton_step(const Regression& all, const Eigen::VectorXd& beta) {
  const Eigen::ArrayXd margin = all.sign.array() * (all.features * beta).array();
  const Eigen::ArrayXd doubt = (1 + margin.exp()).inverse();  // probability of the other kind
  Eigen::VectorXd slope =
      -all.features.transpose() * (all.weight.array() * all.sign.array() * doubt).matrix();
  slope.head(kSize) += kRidge * beta.head(kSize);
  const Eigen::ArrayXd curvature = all.weight.array() * doubt * (1 - doubt);
  const Eigen::MatrixXd scaled = curvature.sqrt().matrix().asDiagonal() * all.features;
  Eigen::MatrixXd hessian = Eigen::MatrixXd::Zero(kSize + 1, kSize + 1);
  hessian.selfadjointView<Eigen::Lower>().rankUpdate(scaled.transpose());
  hessian.diagonal().head(kSize).array() += kRidge;
  return -hessian.selfadjointView<Eigen::Lower>().ldlt().solve(slope);
}

// Convex, so that halving a step until it helps always ends at the one minimum.
Eigen::VectorXd minimum(const Regression& all) {
  Eigen::VectorXd beta = Eigen::VectorXd::Zero(kSize + 1);
  double least = loss(all, beta);
  for (int round = 0; round < kRounds; ++round) {
    Eigen::VectorXd step = newton_step(all, beta);
    double next = loss(all, beta + step);
    while (next > least && step.norm() > kLeastStep) {
      step /= 2;
      next = loss(all, beta + step);
    }
    if (next >= least) break;
    beta += step;
    const double gain = least - next;
    least = next;
    if (gain < kSettled) break;
  }
  return beta;
}

}  // namespace

Result<TextureModel> fitted_texture_model(std::vector<TextureExample> examples,
                                          const std::string& where) {
  if (!balance(&examples)) {
    return Error{"there are no examples of hands, or none of other things", where,
                 "give pictures in which hands are found, and others of skin's colours without"};
  }
  const Eigen::VectorXd beta = minimum(regression_from(examples));
  TextureModel model;
  model.constant = beta[kSize];
  for (Eigen::Index i = 0; i < kSize; ++i)
    model.weights[static_cast<std::size_t>(i)] = static_cast<float>(beta[i]);
  return model;
}

}  // namespace armsreach::gesture
