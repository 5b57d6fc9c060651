// Every instruction-set level gives the same bits, and the right ones.
#include <random>
#include <vector>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include "vision/mono_slam/filter_kernels.hpp"
#include "vision/mono_slam/search_kernels.hpp"

namespace armsreach::mono_slam {
namespace {

std::vector<Isa> levels() {
  std::vector<Isa> out{Isa::baseline};
  if (best_isa() != Isa::baseline) out.push_back(Isa::v3);
  if (best_isa() == Isa::v4) out.push_back(Isa::v4);
  return out;
}

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

TEST(FilterKernels, SubtractTheSquareAlikeAtEveryLevel) {
  for (const int n : {1, 7, 12, 33, 80, 313}) {
    const int stride = (n + 15) / 16 * 16;
    RowMajor root = RowMajor::Random(n, n);
    RowMajor p = RowMajor::Zero(stride, stride);
    p.topLeftCorner(n, n) = root * root.transpose();
    p.topLeftCorner(n, n) = (0.5 * (p + p.transpose())).eval().topLeftCorner(n, n);
    RowMajor w = RowMajor::Zero(24, stride);
    w.leftCols(n).setRandom();
    const RowMajor expected = p.topLeftCorner(n, n) - w.leftCols(n).transpose() * w.leftCols(n);
    RowMajor first;
    for (const Isa isa : levels()) {
      RowMajor out = p;
      filter_kernels(isa).subtract_square(out.data(), w.data(), 24, n, stride);
      const RowMajor inside = out.topLeftCorner(n, n);
      EXPECT_LT((inside - expected).cwiseAbs().maxCoeff(), 1e-12 * n);
      EXPECT_TRUE(inside == inside.transpose());
      if (first.size() == 0) first = inside;
      EXPECT_TRUE(inside == first);
    }
  }
}

TEST(SearchKernels, SumsAreExactAtEveryLevel) {
  constexpr int kRows = 5;
  constexpr int kStride = 64;
  std::mt19937 random(3);
  std::vector<float> image(kStride * 32);
  std::vector<float> pattern(15 * 15);
  for (float& v : image) v = static_cast<float>(random() % 256);
  for (float& v : pattern) v = static_cast<float>(random() % 256);
  for (const int size : {5, 7, 11, 15}) {
    for (const Isa isa : levels()) {
      std::vector<float> sums(kPlacesAbreast * kRows), squares(sums), products(sums);
      search_kernels(isa).correlate(image.data(), kStride, pattern.data(), size, kRows, sums.data(),
                                    squares.data(), products.data());
      for (int row = 0; row < kRows; ++row) {
        for (int place = 0; place < kPlacesAbreast; ++place) {
          double sum = 0, square = 0, product = 0;
          for (int y = 0; y < size; ++y) {
            for (int x = 0; x < size; ++x) {
              const double v = static_cast<double>(
                  image[static_cast<std::size_t>((row + y) * kStride + place + x)]);
              sum += v;
              square += v * v;
              product += v * static_cast<double>(pattern[static_cast<std::size_t>(y * size + x)]);
            }
          }
          const auto at = static_cast<std::size_t>(row * kPlacesAbreast + place);
          ASSERT_EQ(static_cast<double>(sums[at]), sum);
          ASSERT_EQ(static_cast<double>(squares[at]), square);
          ASSERT_EQ(static_cast<double>(products[at]), product);
        }
      }
    }
  }
}

}  // namespace
}  // namespace armsreach::mono_slam
