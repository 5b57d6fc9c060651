#include "vision/registration/color_search.hpp"

#include <algorithm>
#include <cmath>

#include "vision/registration/simplex.hpp"

namespace armsreach {
namespace {

// Gaussians that edges are seen through, px of an image 640 wide, and contours compared at each.
struct Scale {
  double sigma;
  std::size_t contours;
};
constexpr Scale kCoarse{6, 1000};
constexpr Scale kMiddle{3, 3000};
constexpr Scale kFine{1.6, 8000};
constexpr Scale kFinest{1, 8000};

constexpr double kGridStep = 1.5;           // units of a hypothesis
constexpr int kGridReach[] = {6, 3, 3, 4};  // steps to either side; no roll
constexpr std::size_t kCandidates = 5;      // of the grid that are followed up
constexpr std::size_t kFinalists = 3;       // of those, down to the finest scale
constexpr double kElsewhere = 3;            // units of displacement between rivals
constexpr double kSame = 0.5;               // units of displacement within one valley
constexpr double kPrecision = 0.02;         // units
constexpr double kPriorWeight = 1e-3;       // agreement given up for a standard deviation

struct Candidate {
  ColorHypothesis hypothesis;
  double value;  // agreement less improbability
};

bool better(const Candidate& a, const Candidate& b) { return a.value > b.value; }

// What may have been otherwise.
struct Doubt {
  int left_out = -1;                                         // part of the image
  ColorHypothesis usual_moved_by = ColorHypothesis::Zero();  // where sensors are not what we think
};

// The answer under a doubt, and how much its square counts in a variance.
struct Replicate {
  ColorHypothesis hypothesis;
  double weight;
};

// Standard deviation, px rms, of where `best` puts the points.
double spread(const std::vector<Replicate>& replicates, const ColorHypothesis& best,
              const Camera& assumed, const std::vector<Eigen::Vector3d>& points) {
  double variance = 0;
  for (const Replicate& replicate : replicates) {
    const double moved = displacement(replicate.hypothesis, best, assumed, points);
    variance += replicate.weight * moved * moved;
  }
  return std::sqrt(variance);
}

std::vector<Eigen::Vector3d> all_at_depth(std::vector<Eigen::Vector3d> points, double z) {
  for (Eigen::Vector3d& point : points) point *= z / point.z();
  return points;
}

class Search {
 public:
  Search(const std::vector<ContourView>& views, const Camera& assumed)
      : views_(views), assumed_(assumed) {
    for (const ContourView& view : views) {
      scene_.insert(scene_.end(), view.scene.begin(), view.scene.end());
      for (const ContourPoint& contour : view.contours) {
        depths_.push_back(static_cast<double>(contour.point_in_depth.z()));
      }
    }
    std::sort(depths_.begin(), depths_.end());
  }

  ColorSearchResult run() const;

 private:
  Agreement agreement(const Scale& scale) const {
    return Agreement(views_, assumed_, scale.sigma, scale.contours);
  }
  double apart(const ColorHypothesis& a, const ColorHypothesis& b) const {
    return displacement(a, b, assumed_, scene_);
  }
  std::vector<Candidate> grid() const;
  std::vector<ColorHypothesis> candidates() const;
  Candidate refined(const Agreement& agreement, const ColorHypothesis& start, double size,
                    const Doubt& doubt = {}) const;
  double depth(double share) const {
    return depths_[static_cast<std::size_t>(share * static_cast<double>(depths_.size() - 1))];
  }
  std::vector<Candidate> followed_up(const Agreement& middle) const;
  ColorHypothesis finest(const std::vector<Candidate>& found) const;
  double around(const Agreement& agreement, const ColorHypothesis& best) const;
  std::vector<Replicate> replicates(const Agreement& agreement, const ColorHypothesis& best) const;

  const std::vector<ContourView>& views_;
  const Camera& assumed_;
  std::vector<Eigen::Vector3d> scene_;
  std::vector<double> depths_;  // of the contours, ascending
};

std::vector<Candidate> Search::grid() const {
  const Agreement agreement = this->agreement(kCoarse);
  std::vector<Candidate> all;
  for (int f = -kGridReach[0]; f <= kGridReach[0]; ++f) {
    for (int x = -kGridReach[1]; x <= kGridReach[1]; ++x) {
      for (int y = -kGridReach[2]; y <= kGridReach[2]; ++y) {
        for (int b = -kGridReach[3]; b <= kGridReach[3]; ++b) {
          const ColorHypothesis h = kGridStep * ColorHypothesis(f, x, y, b, 0);
          all.push_back({h, agreement(h) - kPriorWeight * improbability(h)});
        }
      }
    }
  }
  return all;
}

// Coinciding cameras, and the best of the grid that are not near each other.
std::vector<ColorHypothesis> Search::candidates() const {
  std::vector<Candidate> all = grid();
  std::stable_sort(all.begin(), all.end(), better);
  std::vector<ColorHypothesis> chosen = {ColorHypothesis::Zero()};
  for (const Candidate& candidate : all) {
    if (chosen.size() > kCandidates) break;
    const bool apart_from_all =
        std::all_of(chosen.begin(), chosen.end(), [&](const ColorHypothesis& other) {
          return apart(candidate.hypothesis, other) > kElsewhere * hypothesis_unit(assumed_);
        });
    if (apart_from_all) chosen.push_back(candidate.hypothesis);
  }
  return chosen;
}

Candidate Search::refined(const Agreement& agreement, const ColorHypothesis& start, double size,
                          const Doubt& doubt) const {
  // The simplex varies the baseline about the contours' median depth, or baseline and centre would
  // be one narrow diagonal valley.
  const double z = depth(0.5);
  const auto hypothesis_at = [&](const Eigen::VectorXd& at) {
    ColorHypothesis without_baseline = at;
    without_baseline[3] = 0;
    return with_baseline(without_baseline, at[3], assumed_, z);
  };
  const auto cost = [&](const Eigen::VectorXd& at) {
    const ColorHypothesis h = hypothesis_at(at);
    return kPriorWeight * improbability(h - doubt.usual_moved_by) -
           agreement.without(h, doubt.left_out);
  };
  constexpr int kMostSteps = 200;
  ColorHypothesis from = with_baseline(start, 0, assumed_, z);
  from[3] = start[3];
  const SimplexMinimum minimum = minimise(cost, from, size, kPrecision, kMostSteps);
  return {hypothesis_at(minimum.at), -minimum.value};
}

// What agreement comes to by chance: its mean over guesses on all sides of the best.
double Search::around(const Agreement& agreement, const ColorHypothesis& best) const {
  double sum = 0;
  for (int corner = 0; corner < 16; ++corner) {
    const auto side = [&](int bit) { return (corner >> bit & 1) != 0 ? 1.0 : -1.0; };
    sum += agreement(best + ColorHypothesis(4 * side(0), 3 * side(1), 3 * side(2), 3 * side(3), 0));
  }
  return sum / 16;
}

// A jackknife over parts of the image tells what the answer owes to what was seen, and moving what
// is usual by a standard deviation what it owes to that.
std::vector<Replicate> Search::replicates(const Agreement& agreement,
                                          const ColorHypothesis& best) const {
  constexpr int kParts = Agreement::kParts;
  std::vector<Replicate> all;
  for (int part = 0; part < kParts; ++part) {
    const Doubt doubt{part, ColorHypothesis::Zero()};
    all.push_back({refined(agreement, best, 0.5, doubt).hypothesis, (kParts - 1.0) / kParts});
  }
  for (int i = 0; i < usual_deviation().size(); ++i) {
    const Doubt doubt{-1, usual_deviation()[i] * ColorHypothesis::Unit(i)};
    all.push_back({refined(agreement, best, 0.5, doubt).hypothesis, 1});
  }
  return all;
}

// Followed from the coarse to the middle scale, best first.
std::vector<Candidate> Search::followed_up(const Agreement& middle) const {
  const Agreement coarse = agreement(kCoarse);
  std::vector<Candidate> found = {refined(middle, ColorHypothesis::Zero(), 0.5)};
  for (const ColorHypothesis& candidate : candidates()) {
    found.push_back(refined(middle, refined(coarse, candidate, 1).hypothesis, 0.5));
  }
  std::stable_sort(found.begin(), found.end(), better);
  return found;
}

// The middle scale knows which valley is the right one, but not always which end of it: that of a
// baseline to the left or to the right.
ColorHypothesis Search::finest(const std::vector<Candidate>& found) const {
  std::vector<ColorHypothesis> followed;
  std::vector<Candidate> finalists;
  const Agreement fine = agreement(kFine);
  for (const Candidate& candidate : found) {
    if (finalists.size() >= kFinalists) break;
    const bool same = std::any_of(followed.begin(), followed.end(), [&](const ColorHypothesis& h) {
      return apart(candidate.hypothesis, h) < kSame * hypothesis_unit(assumed_);
    });
    if (same) continue;
    followed.push_back(candidate.hypothesis);
    const ColorHypothesis& h = candidate.hypothesis;
    const ColorHypothesis mirrored = with_baseline(h, -h[3], assumed_, depth(0.5));
    finalists.push_back(std::min(refined(fine, h, 0.5), refined(fine, mirrored, 0.5), better));
  }
  const auto best = std::min_element(finalists.begin(), finalists.end(), better);
  return refined(agreement(kFinest), best->hypothesis, 0.5).hypothesis;
}

ColorSearchResult Search::run() const {
  const Agreement middle = agreement(kMiddle);
  const std::vector<Candidate> found = followed_up(middle);
  ColorSearchResult result;
  result.best = finest(found);
  const double chance = around(middle, result.best);
  result.contrast = middle(result.best) - chance;
  const auto share = [&](const ColorHypothesis& h) {
    return (middle(h) - chance) / result.contrast;
  };
  result.registered_share = share(ColorHypothesis::Zero());
  for (const Candidate& rival : found) {
    if (apart(rival.hypothesis, result.best) <= kElsewhere * hypothesis_unit(assumed_)) continue;
    result.rival_share = share(rival.hypothesis);
    break;
  }
  result.displacement = apart(result.best, ColorHypothesis::Zero());
  const std::vector<Replicate> doubted = replicates(agreement(kFinest), result.best);
  result.uncertainty = spread(doubted, result.best, assumed_, scene_);
  for (std::size_t i = 0; i < kUncertaintyDepths.size(); ++i) {
    result.uncertainty_at[i] =
        spread(doubted, result.best, assumed_, all_at_depth(scene_, kUncertaintyDepths[i]));
  }
  result.nearest = depth(0.05);
  result.farthest = depth(0.95);
  return result;
}

}  // namespace

ColorSearchResult search_color_camera(const std::vector<ContourView>& views,
                                      const Camera& assumed) {
  return Search(views, assumed).run();
}

}  // namespace armsreach
