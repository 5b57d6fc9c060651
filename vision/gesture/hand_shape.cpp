#include "vision/gesture/hand_shape.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include <opencv2/imgproc.hpp>

#include "vision/gesture/wrist_cut.hpp"

namespace armsreach::gesture {
namespace {

constexpr int kWorkingArea = 320 * 240;  // px: shapes are no clearer in larger images
constexpr double kCore = 0.5;          // palm radii: half an arm's breadth; fingers have a quarter
constexpr double kHandReach = 2.4;     // of the core, in palm radii from its middle, without an arm
constexpr double kNearer = 1.3;        // as far from the border: the other end of an arm
constexpr double kLeastContact = 0.9;  // palm radii of border: an arm; less is a fingertip
constexpr double kHoleShare = 0.005;   // of the blob: smaller holes are the mask's

// One blob in its bounding box, with a margin of one pixel.
struct Cutout {
  cv::Mat mask;
  cv::Point origin{0, 0};  // of the crop in the working image
};

int reduction(const cv::Size& size) {
  int factor = 1;
  while (size.area() > 1.5 * kWorkingArea * factor * factor) ++factor;
  return factor;
}

cv::Mat reduced(const cv::Mat& mask, int factor) {
  if (factor == 1) return mask;
  cv::Mat small;
  cv::resize(mask, small, {mask.cols / factor, mask.rows / factor}, 0, 0, cv::INTER_AREA);
  return small > 127;
}

Cutout cutout(const cv::Mat& labels, int label, const cv::Rect& box) {
  Cutout one{cv::Mat(box.height + 2, box.width + 2, CV_8UC1, cv::Scalar(0)),
             box.tl() - cv::Point(1, 1)};
  one.mask(cv::Rect(1, 1, box.width, box.height)).setTo(255, labels(box) == label);
  return one;
}

// Fills the mask's small holes; the outer contour.
std::vector<cv::Point> outline_of(cv::Mat& mask) {
  std::vector<std::vector<cv::Point>> contours;
  std::vector<cv::Vec4i> hierarchy;
  cv::findContours(mask, contours, hierarchy, cv::RETR_CCOMP, cv::CHAIN_APPROX_NONE);
  std::size_t outer = 0;
  double outer_area = 0;
  for (std::size_t i = 0; i < contours.size(); ++i) {
    const double area = cv::contourArea(contours[i]);
    if (hierarchy[i][3] < 0 && area >= outer_area) outer = i, outer_area = area;
  }
  for (std::size_t i = 0; i < contours.size(); ++i) {
    if (hierarchy[i][3] >= 0 && cv::contourArea(contours[i]) < kHoleShare * outer_area)
      cv::drawContours(mask, contours, static_cast<int>(i), 255, cv::FILLED);
  }
  return contours[outer];
}

// Where the outline runs along the image's border.
struct Contact {
  int pixels = 0;                // in all
  int longest = 0;               // of one run
  Eigen::Vector2d middle{0, 0};  // of that run
};
Contact contact_of(const std::vector<cv::Point>& outline, const cv::Point& origin,
                   const cv::Size& image) {
  const auto on_border = [&](const cv::Point& point) {
    const cv::Point at = point + origin;
    return at.x <= 0 || at.y <= 0 || at.x >= image.width - 1 || at.y >= image.height - 1;
  };
  // Begin where no run is cut in two.
  const auto inner = std::find_if_not(outline.begin(), outline.end(), on_border);
  const auto first = static_cast<std::size_t>(inner - outline.begin());
  Contact contact;
  int run = 0;
  Eigen::Vector2d sum(0, 0);
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const cv::Point& point = outline[(first + i) % outline.size()];
    if (!on_border(point)) {
      run = 0;
      sum.setZero();
      continue;
    }
    ++contact.pixels;
    ++run;
    sum += Eigen::Vector2d(point.x, point.y);
    if (run <= contact.longest) continue;
    contact.longest = run;
    contact.middle = sum / run;
  }
  return contact;
}

// Where the blob is broad: without fingers and ragged edges.
std::vector<Eigen::Vector2d> core_of(const cv::Mat& distance, double least) {
  std::vector<Eigen::Vector2d> core;
  for (int y = 0; y < distance.rows; ++y) {
    const float* row = distance.ptr<float>(y);
    for (int x = 0; x < distance.cols; ++x)
      if (row[x] >= static_cast<float>(least)) core.emplace_back(x, y);
  }
  return core;
}

// The two points that are farthest from each other, nearly.
std::array<Eigen::Vector2d, 2> ends_of(const std::vector<Eigen::Vector2d>& points) {
  const auto farthest_from = [&](const Eigen::Vector2d& from) {
    return *std::max_element(points.begin(), points.end(), [&](const auto& a, const auto& b) {
      return (a - from).squaredNorm() < (b - from).squaredNorm();
    });
  };
  const Eigen::Vector2d one = farthest_from(points[0]);
  return {one, farthest_from(one)};
}

HandShape shape_of(const Cutout& one, const cv::Mat& hand, const std::optional<WristCut>& cut,
                   int factor) {
  const cv::Moments moments = cv::moments(hand, true);
  const auto in_image = [&](double x, double y) {
    // Pixels of a reduced image are as many pixels of the image wide.
    return Eigen::Vector2d((one.origin.x + x + 0.5) * factor - 0.5,
                           (one.origin.y + y + 0.5) * factor - 0.5);
  };
  HandShape shape;
  shape.mask = hand;
  shape.mask_origin = in_image(0, 0);
  shape.mask_scale = factor;
  const double count = std::max(1.0, moments.m00);
  shape.center = in_image(moments.m10 / count, moments.m01 / count);
  shape.area = count * factor * factor;
  if (cut) shape.to_arm = cut->to_arm;
  return shape;
}

std::vector<HandShape> readings_of(const Cutout& one, const std::vector<cv::Point>& outline,
                                   const Contact& contact, const cv::Size& image, int factor) {
  cv::Mat filled(one.mask.size(), CV_8UC1, cv::Scalar(0));  // a ring of fingers has a middle, too
  cv::drawContours(filled, std::vector<std::vector<cv::Point>>{outline}, 0, 255, cv::FILLED);
  cv::Mat distance;
  cv::distanceTransform(filled, distance, cv::DIST_L2, 3);
  std::vector<HandShape> readings;
  const auto read_cut = [&](const Eigen::Vector2d& arm_end, const Palm& palm) {
    const auto cut = find_wrist(one.mask, palm, arm_end);
    const cv::Mat hand = cut ? cut_off(one.mask, palm, *cut) : one.mask;
    readings.push_back(shape_of(one, hand, cut, factor));
  };
  const Palm broadest = find_palm(distance, std::nullopt);
  if (contact.longest >= kLeastContact * broadest.radius) {
    read_cut(contact.middle, find_palm(distance, contact.middle));
    return readings;
  }
  // A sleeve ends some arms before the border, and then at the end that is nearer to it.
  auto ends = ends_of(core_of(distance, kCore * broadest.radius));
  const auto to_border = [&](const Eigen::Vector2d& end) {
    return std::min({end.x() + one.origin.x, end.y() + one.origin.y,
                     image.width - 1 - end.x() - one.origin.x,
                     image.height - 1 - end.y() - one.origin.y});
  };
  if (to_border(ends[1]) < to_border(ends[0])) std::swap(ends[0], ends[1]);
  const bool told_apart = to_border(ends[1]) > kNearer * to_border(ends[0]);
  const auto read_arm_at = [&](const Eigen::Vector2d& end) {
    const Palm palm = find_palm(distance, end);
    const Eigen::Vector2d middle(palm.center.x, palm.center.y);
    if ((end - middle).norm() > kHandReach * palm.radius) read_cut(end, palm);
  };
  read_arm_at(ends[0]);
  // Where no arm is at the end that is expected, one at the other may as well be fingers.
  const bool expected = !readings.empty();
  if (!expected) readings.push_back(shape_of(one, one.mask, std::nullopt, factor));
  if (!expected || !told_apart) read_arm_at(ends[1]);
  return readings;
}

}  // namespace

std::vector<HandBlob> HandFinder::find(const cv::Mat& mask) const {
  CV_Assert(mask.type() == CV_8UC1);
  if (mask.empty()) return {};
  const int factor = reduction(mask.size());
  const cv::Mat working = reduced(mask, factor);
  cv::Mat labels, statistics, centroids;
  const int count =
      cv::connectedComponentsWithStats(working, labels, statistics, centroids, 8, CV_32S);
  std::vector<int> order(static_cast<std::size_t>(count) - 1);
  std::iota(order.begin(), order.end(), 1);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    return statistics.at<int>(a, cv::CC_STAT_AREA) > statistics.at<int>(b, cv::CC_STAT_AREA);
  });
  std::vector<HandBlob> blobs;
  for (const int label : order) {
    const double share =
        statistics.at<int>(label, cv::CC_STAT_AREA) / static_cast<double>(working.total());
    if (static_cast<int>(blobs.size()) == options_.most_hands || share < options_.least_area) break;
    const cv::Rect box(statistics.at<int>(label, cv::CC_STAT_LEFT),
                       statistics.at<int>(label, cv::CC_STAT_TOP),
                       statistics.at<int>(label, cv::CC_STAT_WIDTH),
                       statistics.at<int>(label, cv::CC_STAT_HEIGHT));
    Cutout one = cutout(labels, label, box);
    HandBlob blob;
    blob.outline = outline_of(one.mask);
    const Contact contact = contact_of(blob.outline, one.origin, working.size());
    blob.readings = readings_of(one, blob.outline, contact, working.size(), factor);
    blob.contact = contact.pixels * factor;
    const HandShape& first = blob.readings[0];
    const double hand_share = first.area / static_cast<double>(mask.total());
    const double root = std::sqrt(cv::contourArea(blob.outline)) * factor;
    const bool inside = blob.contact < options_.least_contact * root;
    const double most = inside ? options_.most_area_inside : options_.most_area;
    blob.plausible = hand_share >= options_.least_area && hand_share <= most &&
                     blob.contact < options_.most_contact * root;
    for (cv::Point& point : blob.outline)
      point = (point + one.origin) * factor + cv::Point(factor / 2, factor / 2);
    blobs.push_back(std::move(blob));
  }
  return blobs;
}

}  // namespace armsreach::gesture
