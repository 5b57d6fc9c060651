#include "vision/mono_slam/search.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "vision/mono_slam/search_kernels.hpp"

namespace armsreach::mono_slam {
namespace {

using Eigen::Vector2d;
using Level = SearchImage::Level;

constexpr double kLeastDeviation = 2;  // grey levels: flatter windows match nothing
constexpr int kLargeArea = 900;        // pixels: from here on half size first
constexpr int kLinesAtOnce = 64;

const SearchKernels& kernels() {
  static const SearchKernels chosen = search_kernels(best_isa());
  return chosen;
}

struct Peak {
  int x = 0;
  int y = 0;
  double score = -2;
};

// Scores of a template at places of one level.
class Correlation {
 public:
  Correlation(const Level& level, const Template& pattern)
      : level_(level), pattern_(pattern), count_(pattern.size * pattern.size) {
    const auto end = pattern.samples.begin() + count_;
    double squares = 0;
    for (auto p = pattern.samples.begin(); p != end; ++p) {
      const double level_here = *p;
      sum_ += level_here;
      squares += level_here * level_here;
    }
    variance_ = count_ * squares - sum_ * sum_;
  }

  bool flat() const { return variance_ < least_variance(); }

  // Calls visit(x, y, scores, n) for runs of n <= 16 neighbouring places of the region.
  template <class Visit>
  void over(const Region& region, Visit visit) const {
    const Region inside = within(region, level_.width, level_.height, pattern_.half());
    const int lines = static_cast<int>(inside.spans.size());
    for (int first = 0; first < lines; first += kLinesAtOnce) {
      over_lines(inside, first, std::min(lines - first, kLinesAtOnce), visit);
    }
  }

 private:
  double least_variance() const { return kLeastDeviation * kLeastDeviation * count_ * count_; }

  template <class Visit>
  void over_lines(const Region& region, int first, int lines, Visit visit) const {
    int left = level_.width;
    int right = 0;
    for (int i = first; i < first + lines; ++i) {
      const Region::Span& span = region.spans[static_cast<std::size_t>(i)];
      if (span.end <= span.begin) continue;
      left = std::min(left, span.begin);
      right = std::max(right, span.end);
    }
    for (int x = left; x < right; x += kPlacesAbreast) column(region, first, lines, x, visit);
  }

  // The lines' places x .. x + 15, as far as they belong to the region.
  template <class Visit>
  void column(const Region& region, int first, int lines, int x, Visit visit) const {
    const auto begin = [&](int i) {
      return std::max(region.spans[static_cast<std::size_t>(i)].begin, x);
    };
    const auto end = [&](int i) {
      return std::min(region.spans[static_cast<std::size_t>(i)].end, x + kPlacesAbreast);
    };
    int last = first + lines;
    while (first < last && end(first) <= begin(first)) ++first;
    while (last > first && end(last - 1) <= begin(last - 1)) --last;
    if (first == last) return;

    std::array<float, kPlacesAbreast * kLinesAtOnce> sums, squares, products;
    const int y = region.top + first;
    kernels().correlate(level_.at(x - pattern_.half(), y - pattern_.half()), level_.stride,
                        pattern_.samples.data(), pattern_.size, last - first, sums.data(),
                        squares.data(), products.data());
    for (int i = first; i < last; ++i) {
      const int from = begin(i);
      const int n = end(i) - from;
      if (n <= 0) continue;
      std::array<double, kPlacesAbreast> scores;
      for (int k = 0; k < n; ++k) {
        const auto at = static_cast<std::size_t>((i - first) * kPlacesAbreast + from - x + k);
        scores[static_cast<std::size_t>(k)] = score(sums[at], squares[at], products[at]);
      }
      visit(from, region.top + i, scores.data(), n);
    }
  }

  double score(double sum, double squares, double product) const {
    const double variance = count_ * squares - sum * sum;
    const double covariance = count_ * product - sum * sum_;
    if (variance < least_variance()) return -1;
    return covariance / std::sqrt(variance * variance_);
  }

  const Level& level_;
  const Template& pattern_;
  int count_;
  double sum_ = 0;
  double variance_ = 0;  // times the squared number of samples
};

Peak best_in(const Correlation& correlation, const Region& region) {
  Peak best;
  correlation.over(region, [&](int x, int y, const double* scores, int n) {
    for (int k = 0; k < n; ++k) {
      if (scores[k] > best.score) best = {x + k, y, scores[k]};
    }
  });
  return best;
}

// Offset of the maximum of the parabola through three values one apart.
double vertex(double before, double middle, double after) {
  const double curvature = before - 2 * middle + after;
  if (curvature > -1e-9) return 0;
  return std::clamp(0.5 * (before - after) / curvature, -0.5, 0.5);
}

Match refined(const Correlation& correlation, const Template& pattern, const Peak& peak) {
  std::array<std::array<double, 3>, 3> around;
  for (auto& line : around) line.fill(peak.score);
  correlation.over(square(Vector2d(peak.x, peak.y), 1),
                   [&](int x, int y, const double* scores, int n) {
                     for (int k = 0; k < n; ++k) {
                       around[static_cast<std::size_t>(y - peak.y + 1)]
                             [static_cast<std::size_t>(x + k - peak.x + 1)] = scores[k];
                     }
                   });
  const Vector2d offset(vertex(around[1][0], peak.score, around[1][2]),
                        vertex(around[0][1], peak.score, around[2][1]));
  return {Vector2d(peak.x, peak.y) + offset + pattern.pixel_from_centre, peak.score};
}

// Maxima that are above all within two pixels, the highest first.
std::vector<Peak> local_maxima(const Correlation& correlation, const Level& level,
                               const Region& region, double least_score, int most) {
  cv::Mat_<double> scores(level.height, level.width, -2.0);
  correlation.over(region, [&](int x, int y, const double* values, int n) {
    std::copy_n(values, n, scores[y] + x);
  });
  std::vector<Peak> peaks;
  for (int y = 2; y < level.height - 2; ++y) {
    for (int x = 2; x < level.width - 2; ++x) {
      const double score = scores(y, x);
      if (score < least_score) continue;
      bool highest = true;
      for (int dy = -2; dy <= 2 && highest; ++dy) {
        for (int dx = -2; dx <= 2; ++dx) {
          const bool earlier = dy < 0 || (dy == 0 && dx < 0);
          const double other = scores(y + dy, x + dx);
          if (other > score || (earlier && other == score)) highest = false;
        }
      }
      if (highest) peaks.push_back({x, y, score});
    }
  }
  const auto higher = [](const Peak& a, const Peak& b) { return a.score > b.score; };
  std::stable_sort(peaks.begin(), peaks.end(), higher);
  if (peaks.size() > static_cast<std::size_t>(most)) peaks.resize(static_cast<std::size_t>(most));
  return peaks;
}

// A small pattern is less distinct, and blurred: what is right scores lower.
constexpr double kCoarseSlack = 0.2;
constexpr int kCoarsePeaks = 4;

std::optional<Match> search_coarse_to_fine(const SearchImage& image, const Template& pattern,
                                           const Region& region, double least_score) {
  const Template small = halved(pattern);
  const Correlation coarse(image.half(), small);
  if (coarse.flat()) return search_exhaustively(image, pattern, region, least_score);
  const Correlation fine(image.full(), pattern);
  Peak best;
  for (const Peak& peak : local_maxima(coarse, image.half(), halved(region),
                                       least_score - kCoarseSlack, kCoarsePeaks)) {
    const Peak found = best_in(fine, square(Vector2d(2 * peak.x, 2 * peak.y), 2));
    if (found.score > best.score) best = found;
  }
  if (best.score < least_score) return std::nullopt;
  return refined(fine, pattern, best);
}

}  // namespace

SearchKernels search_kernels(Isa isa) {
#ifdef __x86_64__
  if (isa == Isa::v4) return v4::kSearchKernels;
  if (isa == Isa::v3) return v3::kSearchKernels;
#endif
  static_cast<void>(isa);
  return baseline::kSearchKernels;
}

std::optional<Match> search_exhaustively(const SearchImage& image, const Template& pattern,
                                         const Region& region, double least_score) {
  const Correlation correlation(image.full(), pattern);
  if (correlation.flat()) return std::nullopt;
  const Peak best = best_in(correlation, region);
  if (best.score < least_score) return std::nullopt;
  return refined(correlation, pattern, best);
}

std::optional<Match> search(const SearchImage& image, const Template& pattern, const Region& region,
                            double least_score) {
  const Region inside = within(region, image.full().width, image.full().height, pattern.half());
  if (inside.area() > kLargeArea) {
    return search_coarse_to_fine(image, pattern, inside, least_score);
  }
  return search_exhaustively(image, pattern, inside, least_score);
}

std::vector<Match> search_all(const SearchImage& image, const Template& pattern,
                              const Region& region, double least_score, int most) {
  std::vector<Match> out;
  const Correlation correlation(image.full(), pattern);
  if (correlation.flat()) return out;
  for (const Peak& peak : local_maxima(correlation, image.full(), region, least_score, most)) {
    out.push_back(refined(correlation, pattern, peak));
  }
  return out;
}

std::vector<Match> search_all_coarsely(const SearchImage& image, const Template& pattern,
                                       double least_score, int most) {
  std::vector<Match> out;
  const Template small = halved(pattern);
  const Correlation coarse(image.half(), small);
  const Correlation fine(image.full(), pattern);
  if (coarse.flat() || fine.flat()) return out;
  const Region all = everywhere(image.half().width, image.half().height);
  for (const Peak& peak :
       local_maxima(coarse, image.half(), all, least_score - kCoarseSlack, 2 * most)) {
    const Peak found = best_in(fine, square(Vector2d(2 * peak.x, 2 * peak.y), 2));
    if (found.score >= least_score) out.push_back(refined(fine, pattern, found));
  }
  std::stable_sort(out.begin(), out.end(),
                   [](const Match& a, const Match& b) { return a.score > b.score; });
  if (out.size() > static_cast<std::size_t>(most)) out.resize(static_cast<std::size_t>(most));
  return out;
}

}  // namespace armsreach::mono_slam
