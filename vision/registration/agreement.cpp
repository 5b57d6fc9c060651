#include "vision/registration/agreement.hpp"

#include <algorithm>

namespace armsreach {
namespace {

int part_of(const Eigen::Vector2f& pixel, const cv::Size& size) {
  const auto cell = [](float position, int length, int cells) {
    const int index =
        static_cast<int>(position * static_cast<float>(cells) / static_cast<float>(length));
    return std::clamp(index, 0, cells - 1);
  };
  return 4 * cell(pixel.y(), size.height, Agreement::kParts / 4) + cell(pixel.x(), size.width, 4);
}

}  // namespace

Agreement::Agreement(const std::vector<ContourView>& views, const Camera& assumed, double sigma,
                     std::size_t most)
    : assumed_(assumed) {
  std::size_t all = 0;
  for (const ContourView& view : views) all += view.contours.size();
  const std::size_t stride = std::max<std::size_t>(1, all / most);
  fields_.reserve(views.size());  // points_ holds addresses
  std::size_t index = 0;
  for (const ContourView& view : views) {
    fields_.emplace_back(view.edges, sigma * assumed.width / 640);
    for (const ContourPoint& contour : view.contours) {
      if (index++ % stride != 0) continue;
      points_.push_back({contour.point_in_depth.cast<double>(), contour.across,
                         part_of(contour.pixel, view.depth_size), &fields_.back()});
    }
  }
}

Agreement::Parts Agreement::parts(const ColorHypothesis& hypothesis) const {
  const ColorCamera color = color_camera(hypothesis, assumed_);
  const Eigen::Matrix3d rotation = color.camera_from_depth.rotation_matrix();
  const Eigen::Vector3d& translation = color.camera_from_depth.translation();
  Parts parts;
  for (const Placed& placed : points_) {
    const auto pixel = project(color.camera, rotation * placed.point_in_depth + translation);
    const Eigen::Vector2d at = pixel.value_or(Eigen::Vector2d(-1, -1));
    Part& part = parts[static_cast<std::size_t>(placed.part)];
    part.sum += static_cast<double>(
        placed.field->at(static_cast<float>(at.x()), static_cast<float>(at.y()), placed.across));
    ++part.count;
  }
  return parts;
}

double Agreement::without(const ColorHypothesis& hypothesis, int left_out) const {
  const Parts all = parts(hypothesis);
  double sum = 0;
  int count = 0;
  for (int part = 0; part < kParts; ++part) {
    if (part == left_out) continue;
    sum += all[static_cast<std::size_t>(part)].sum;
    count += all[static_cast<std::size_t>(part)].count;
  }
  return count > 0 ? sum / count : 0;
}

}  // namespace armsreach
