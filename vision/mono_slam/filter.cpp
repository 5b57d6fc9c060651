#include "vision/mono_slam/filter.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include <Eigen/Cholesky>

#include "vision/mono_slam/filter_kernels.hpp"

namespace armsreach::mono_slam {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr int rounded_up(int n, int step) { return (n + step - 1) / step * step; }

// A multiple of 16, but an odd one: rows a power of two apart would share their cache lines.
constexpr int stride_for(int rows) {
  const int blocks = rounded_up(rows, 16) / 16;
  return 16 * (blocks % 2 == 0 ? blocks + 1 : blocks);
}

const FilterKernels& kernels() {
  static const FilterKernels chosen = filter_kernels(best_isa());
  return chosen;
}

}  // namespace

FilterKernels filter_kernels(Isa isa) {
#ifdef __x86_64__
  if (isa == Isa::v4) return v4::kFilterKernels;
  if (isa == Isa::v3) return v3::kFilterKernels;
#endif
  static_cast<void>(isa);
  return baseline::kFilterKernels;
}

Filter::Filter(const Camera& camera, int most_points, double pixel_sigma)
    : camera_(camera), pixel_sigma_(pixel_sigma), capacity_(kCameraRows + 3 * most_points) {
  const int stride = stride_for(capacity_);
  p_ = RowMajor::Zero(stride, stride);
  scratch_ = RowMajor::Zero(kCameraRows, stride);
  stacked_ = RowMajor::Zero(2 * kMostMeasurements, stride);
  weighted_ = RowMajor::Zero(2 * kMostMeasurements, stride);
  slots_.reserve(static_cast<std::size_t>(most_points));
}

void Filter::start(const CameraState& state, const CameraCovariance& covariance) {
  slots_.clear();
  rows_ = kCameraRows;
  state_ = state;
  p_.setZero();
  p_.topLeftCorner<kCameraRows, kCameraRows>() = covariance;
}

void Filter::predict(double seconds, const MotionNoise& noise,
                     const std::optional<CameraControl>& control) {
  CameraCovariance by_state;
  state_ = moved(state_, seconds, control, &by_state);
  const double impulse = noise.acceleration * seconds;
  const double angular_impulse = noise.angular_acceleration * seconds;
  p_.diagonal().segment<3>(6).array() += impulse * impulse;
  p_.diagonal().segment<3>(9).array() += angular_impulse * angular_impulse;
  const double wander = noise.point_wander * noise.point_wander * seconds;
  for (const Slot& slot : slots_) p_.diagonal().segment<3>(slot.row).array() += wander;
  scratch_.leftCols(rows_).noalias() = by_state * p_.topLeftCorner(kCameraRows, rows_);
  const CameraCovariance own = scratch_.leftCols<kCameraRows>() * by_state.transpose();
  p_.topLeftCorner(kCameraRows, rows_) = scratch_.leftCols(rows_);
  p_.topLeftCorner<kCameraRows, kCameraRows>() = 0.5 * (own + own.transpose());
  if (control) {
    p_.diagonal().segment<3>(0).array() += control->translation_sigma * control->translation_sigma;
    p_.diagonal().segment<3>(3).array() += control->rotation_sigma * control->rotation_sigma;
  }
  mirror_rows(0, kCameraRows);
}

// Columns of these rows from the rows themselves.
void Filter::mirror_rows(int first, int count) {
  const int below = first + count;
  p_.block(below, first, rows_ - below, count) =
      p_.block(first, below, count, rows_ - below).transpose();
  p_.block(0, first, first, count) = p_.block(first, 0, count, first).transpose();
}

PointId Filter::append(const Point& point) {
  slots_.push_back({next_id_++, rows_, point});
  rows_ += rows_of(point.kind);
  return slots_.back().id;
}

// The new rows follow the camera's; `own` is what they have for themselves.
PointId Filter::append_from_camera(const Point& point,
                                   const Eigen::Matrix<double, -1, kCameraRows>& by_camera,
                                   const MatrixXd& own) {
  const int first = rows_;
  const int count = rows_of(point.kind);
  const MatrixXd with_camera = by_camera * p_.topLeftCorner<kCameraRows, kCameraRows>();
  p_.block(first, 0, count, first).noalias() = by_camera * p_.topLeftCorner(kCameraRows, first);
  const MatrixXd block = with_camera * by_camera.transpose() + own;
  p_.block(first, first, count, count) = 0.5 * (block + block.transpose());
  const PointId id = append(point);
  mirror_rows(first, count);
  return id;
}

std::optional<PointId> Filter::add_known(const Vector3d& point_in_world, double sigma) {
  if (!has_room(3)) return std::nullopt;
  Point point;
  point.values = point_in_world;
  return append_from_camera(point, Eigen::Matrix<double, 3, kCameraRows>::Zero(),
                            sigma * sigma * Matrix3d::Identity());
}

std::optional<PointId> Filter::add_ray(const Vector2d& pixel) {
  if (!has_room(5)) return std::nullopt;
  const NewRay ray = ray_through(camera_, state_, pixel);
  MatrixXd own = pixel_sigma_ * pixel_sigma_ * ray.by_pixel * ray.by_pixel.transpose();
  // The origin follows the camera exactly; a tenth of a millimetre keeps the covariance regular.
  own.topLeftCorner<3, 3>().diagonal().array() += 1e-8;
  return append_from_camera(ray.point, ray.by_camera, own);
}

std::optional<PointId> Filter::add_point(const Vector2d& pixel, double distance, double sigma) {
  if (!has_room(3)) return std::nullopt;
  const NewRay ray = ray_through(camera_, state_, pixel);
  Eigen::Matrix<double, 3, 5> by_ray;
  by_ray << Matrix3d::Identity(), distance * ray.point.axes.rightCols<2>();
  const Eigen::Matrix<double, 3, 2> by_pixel = by_ray * ray.by_pixel;
  const Vector3d along = ray.point.axes.col(0);
  Point point;
  point.values = ray.point.at(distance);
  return append_from_camera(point, by_ray * ray.by_camera,
                            pixel_sigma_ * pixel_sigma_ * by_pixel * by_pixel.transpose() +
                                sigma * sigma * along * along.transpose());
}

std::optional<PointId> Filter::add_inverse_depth(const Vector2d& pixel, double inverse_distance,
                                                 double sigma) {
  if (!has_room(6)) return std::nullopt;
  const NewRay ray = ray_through(camera_, state_, pixel);
  Point point = ray.point;
  point.kind = PointKind::inverse_depth;
  point.values.conservativeResize(6);
  point.values[5] = inverse_distance;
  Eigen::Matrix<double, 6, kCameraRows> by_camera = Eigen::Matrix<double, 6, kCameraRows>::Zero();
  by_camera.topRows<5>() = ray.by_camera;
  MatrixXd own = MatrixXd::Zero(6, 6);
  own.topLeftCorner<5, 5>() = pixel_sigma_ * pixel_sigma_ * ray.by_pixel * ray.by_pixel.transpose();
  own.topLeftCorner<3, 3>().diagonal().array() += 1e-8;
  own(5, 5) = sigma * sigma;
  return append_from_camera(point, by_camera, own);
}

std::vector<PointId> Filter::add_map(const std::vector<Vector3d>& points_in_world,
                                     const MatrixXd& covariance) {
  const int first = rows_;
  std::vector<PointId> ids;
  for (const Vector3d& position : points_in_world) {
    const auto id = add_known(position, 0);
    if (!id) break;
    ids.push_back(*id);
  }
  const int count = rows_ - first;
  p_.block(first, first, count, count) = covariance.topLeftCorner(count, count);
  return ids;
}

// The new position depends on the slot's old rows by `by_old`.
void Filter::reduce_to_position(Slot& slot, const Eigen::Matrix<double, 3, -1>& by_old,
                                const Vector3d& position, const Matrix3d& added) {
  const int first = slot.row;
  const int old_count = rows_of(slot.point.kind);
  scratch_.topLeftCorner(3, rows_).noalias() = by_old * rows_of_p(first, old_count);
  const Matrix3d own = scratch_.block(0, first, 3, old_count) * by_old.transpose() + added;
  rows_of_p(first, 3) = scratch_.topLeftCorner(3, rows_);
  p_.block<3, 3>(first, first) = 0.5 * (own + own.transpose());
  mirror_rows(first, 3);
  slot.point.kind = PointKind::position;
  slot.point.values = position;
  erase_rows(first + 3, old_count - 3);
}

void Filter::erase_rows(int first, int count) {
  const int after = first + count;
  for (int row = after; row < rows_; ++row) {
    std::copy_n(p_.row(row).data(), rows_, p_.row(row - count).data());
  }
  for (int row = 0; row < rows_ - count; ++row) {
    double* const line = p_.row(row).data();
    std::copy(line + after, line + rows_, line + first);
  }
  rows_ -= count;
  for (Slot& slot : slots_) {
    if (slot.row >= after) slot.row -= count;
  }
}

void Filter::remove(PointId id) {
  const auto found =
      std::find_if(slots_.begin(), slots_.end(), [&](const Slot& s) { return s.id == id; });
  assert(found != slots_.end());
  const int first = found->row;
  const int count = rows_of(found->point.kind);
  slots_.erase(found);
  erase_rows(first, count);
}

void Filter::fix_distance(PointId id, double distance, double sigma) {
  Slot& ray = slot(id);
  assert(ray.point.kind == PointKind::ray);
  Eigen::Matrix<double, 3, 5> by_ray;
  by_ray << Matrix3d::Identity(), distance * ray.point.axes.rightCols<2>();
  const Vector3d along = ray.point.direction();
  reduce_to_position(ray, by_ray, ray.point.at(distance),
                     sigma * sigma * along * along.transpose());
}

void Filter::make_position(PointId id) {
  Slot& point = slot(id);
  assert(point.point.kind == PointKind::inverse_depth);
  const double distance = 1 / point.point.values[5];
  Eigen::Matrix<double, 3, 6> by_old;
  by_old << Matrix3d::Identity(), distance * point.point.axes.rightCols<2>(),
      -distance * distance * point.point.direction();
  reduce_to_position(point, by_old, point.point.position(), Matrix3d::Zero());
}

std::optional<Prediction> Filter::predicted(const Slot& slot,
                                            const std::optional<Sighting>& sighting) const {
  if (!sighting) return std::nullopt;
  Prediction out;
  out.id = slot.id;
  out.sighting = *sighting;
  const auto count = sighting->by_point.cols();
  const auto own = p_.block(slot.row, slot.row, count, count);
  const auto with_camera = p_.block(0, slot.row, kCameraRows, count);
  const auto& by_camera = sighting->by_camera;
  const Eigen::Matrix2d cross = by_camera * with_camera * sighting->by_point.transpose();
  out.covariance =
      by_camera * p_.topLeftCorner<kCameraRows, kCameraRows>() * by_camera.transpose() + cross +
      cross.transpose() + sighting->by_point * own * sighting->by_point.transpose();
  out.covariance(1, 0) = out.covariance(0, 1);
  out.covariance.diagonal().array() += pixel_sigma_ * pixel_sigma_;
  return out;
}

std::optional<Prediction> Filter::predict(PointId id) const {
  const Slot& s = slot(id);
  return predicted(s, sighting(camera_, state_, s.point));
}

std::optional<Prediction> Filter::predict_along(PointId ray, double distance) const {
  const Slot& s = slot(ray);
  return predicted(s, sighting_along(camera_, state_, s.point, distance));
}

const JointInnovation& Filter::innovation(const std::vector<Measurement>& measurements) {
  const int count = static_cast<int>(measurements.size());
  assert(count <= kMostMeasurements);
  stacked_rows_ = 2 * count;
  joint_.ids.clear();
  joint_.value.resize(stacked_rows_);
  joint_.covariance.resize(stacked_rows_, stacked_rows_);
  for (int i = 0; i < count; ++i) {
    const Measurement& m = measurements[static_cast<std::size_t>(i)];
    const Sighting& s = m.prediction.sighting;
    const int row = slot(m.prediction.id).row;
    auto line = stacked_.block(2 * i, 0, 2, rows_);
    line.noalias() = s.by_camera * p_.topLeftCorner(kCameraRows, rows_);
    line.noalias() += s.by_point * p_.block(row, 0, s.by_point.cols(), rows_);
    joint_.ids.push_back(m.prediction.id);
    joint_.value.segment<2>(2 * i) = m.innovation();
  }
  const auto stacked = stacked_.topLeftCorner(stacked_rows_, rows_);
  for (int i = 0; i < count; ++i) {
    const Measurement& m = measurements[static_cast<std::size_t>(i)];
    const Sighting& s = m.prediction.sighting;
    const int row = slot(m.prediction.id).row;
    auto column = joint_.covariance.middleCols(2 * i, 2);
    column.noalias() = stacked.leftCols<kCameraRows>() * s.by_camera.transpose();
    column.noalias() += stacked.middleCols(row, s.by_point.cols()) * s.by_point.transpose();
  }
  for (int i = 0; i < count; ++i) {
    const double sigma = measurements[static_cast<std::size_t>(i)].noise * pixel_sigma_;
    joint_.covariance.diagonal().segment<2>(2 * i).array() += sigma * sigma;
  }
  return joint_;
}

void Filter::update(const std::vector<int>& chosen) {
  const int rank = 2 * static_cast<int>(chosen.size());
  if (rank == 0) return;
  MatrixXd s(rank, rank);
  VectorXd value(rank);
  for (int i = 0; i < rank; i += 2) {
    const int from = 2 * chosen[static_cast<std::size_t>(i / 2)];
    weighted_.block(i, 0, 2, rows_) = stacked_.block(from, 0, 2, rows_);
    value.segment<2>(i) = joint_.value.segment<2>(from);
    for (int j = 0; j < rank; j += 2) {
      const int other = 2 * chosen[static_cast<std::size_t>(j / 2)];
      s.block<2, 2>(i, j) = joint_.covariance.block<2, 2>(from, other);
    }
  }
  const Eigen::LLT<MatrixXd> factor(s);
  auto weighted = weighted_.topLeftCorner(rank, rows_);
  factor.matrixL().solveInPlace(weighted);
  factor.matrixL().solveInPlace(value);
  correct_state(weighted.transpose() * value);
  const int stride = static_cast<int>(p_.outerStride());
  kernels().subtract_square(p_.data(), weighted_.data(), rank, rows_, stride);
}

void Filter::observe_turning(const Turning& turning) {
  const Matrix3d camera_from_world = state_.rotation.conjugate().toRotationMatrix();
  const Matrix3d parallax = turning.inverse_distance * skew(turning.axis);
  const Vector3d velocity = camera_from_world * state_.velocity;
  Eigen::Matrix<double, 3, kCameraRows> by_camera = Eigen::Matrix<double, 3, kCameraRows>::Zero();
  by_camera.middleCols<3>(3) = parallax * skew(velocity);
  by_camera.middleCols<3>(6) = parallax * camera_from_world;
  by_camera.middleCols<3>(9) = Matrix3d::Identity();
  auto weighted = weighted_.topLeftCorner(3, rows_);
  weighted.noalias() = by_camera * p_.topLeftCorner(kCameraRows, rows_);
  const Matrix3d s = weighted.leftCols<kCameraRows>() * by_camera.transpose() + turning.covariance;
  Vector3d value = turning.rate - state_.angular_velocity - parallax * velocity;
  const Eigen::LLT<Matrix3d> factor(s);
  factor.matrixL().solveInPlace(weighted);
  factor.matrixL().solveInPlace(value);
  correct_state(weighted.transpose() * value);
  kernels().subtract_square(p_.data(), weighted_.data(), 3, rows_,
                            static_cast<int>(p_.outerStride()));
}

void Filter::correct_state(const VectorXd& correction) {
  state_ = corrected(state_, correction.head<kCameraRows>());
  for (Slot& slot : slots_) {
    slot.point.values += correction.segment(slot.row, rows_of(slot.point.kind));
  }
}

void Filter::replace_camera(const CameraState& state, const CameraCovariance& covariance) {
  state_ = state;
  p_.topLeftCorner(kCameraRows, rows_).setZero();
  p_.topLeftCorner<kCameraRows, kCameraRows>() = covariance;
  mirror_rows(0, kCameraRows);
}

const Filter::Slot& Filter::slot(PointId id) const {
  const auto found = std::lower_bound(slots_.begin(), slots_.end(), id,
                                      [](const Slot& s, PointId wanted) { return s.id < wanted; });
  assert(found != slots_.end() && found->id == id);
  return *found;
}
Filter::Slot& Filter::slot(PointId id) {
  return const_cast<Slot&>(static_cast<const Filter*>(this)->slot(id));
}

CameraCovariance Filter::camera_covariance() const {
  return p_.topLeftCorner<kCameraRows, kCameraRows>();
}

std::vector<PointId> Filter::ids() const {
  std::vector<PointId> out;
  for (const Slot& slot : slots_) out.push_back(slot.id);
  return out;
}

MatrixXd Filter::covariance() const { return p_.topLeftCorner(rows_, rows_); }

Matrix3d Filter::position_covariance(PointId id) const {
  const Slot& s = slot(id);
  if (s.point.kind != PointKind::inverse_depth) return p_.block<3, 3>(s.row, s.row);
  const double distance = 1 / s.point.values[5];
  Eigen::Matrix<double, 3, 6> by_values;
  by_values << Matrix3d::Identity(), distance * s.point.axes.rightCols<2>(),
      -distance * distance * s.point.direction();
  return by_values * p_.block<6, 6>(s.row, s.row) * by_values.transpose();
}

MatrixXd Filter::joint_covariance(const std::vector<PointId>& ids) const {
  const auto count = static_cast<Eigen::Index>(ids.size());
  MatrixXd out(3 * count, 3 * count);
  for (Eigen::Index i = 0; i < count; ++i) {
    for (Eigen::Index j = 0; j < count; ++j) {
      out.block<3, 3>(3 * i, 3 * j) = p_.block<3, 3>(slot(ids[static_cast<std::size_t>(i)]).row,
                                                     slot(ids[static_cast<std::size_t>(j)]).row);
    }
  }
  return out;
}

double Filter::inverse_depth_sigma(PointId id) const {
  const Slot& s = slot(id);
  assert(s.point.kind == PointKind::inverse_depth);
  return std::sqrt(p_(s.row + 5, s.row + 5));
}

double Filter::trace() const { return p_.diagonal().head(rows_).sum(); }

}  // namespace armsreach::mono_slam
