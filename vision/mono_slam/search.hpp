// Where in a region of the image a template is: zero-normalised cross-correlation (ZNCC), in
// [-1, 1], at every pixel of the region, and a parabola through the best one's neighbours.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "vision/mono_slam/patch.hpp"
#include "vision/mono_slam/region.hpp"
#include "vision/mono_slam/search_image.hpp"

namespace armsreach::mono_slam {

struct Match {
  Eigen::Vector2d pixel;  // of the point, below the pixel
  double score = 0;
};

// The best place, if its score reaches `least_score`. Large regions are searched at half size
// first, and only around its best places in full.
std::optional<Match> search(const SearchImage& image, const Template& pattern, const Region& region,
                            double least_score);

// The same at every pixel of the region, however large.
std::optional<Match> search_exhaustively(const SearchImage& image, const Template& pattern,
                                         const Region& region, double least_score);

// Local maxima of the score, the best first, at most `most`.
std::vector<Match> search_all(const SearchImage& image, const Template& pattern,
                              const Region& region, double least_score, int most);

// The same of the whole image, found at half size and then refined: about twenty times faster, and
// blind to what is only distinct in full.
std::vector<Match> search_all_coarsely(const SearchImage& image, const Template& pattern,
                                       double least_score, int most);

}  // namespace armsreach::mono_slam
