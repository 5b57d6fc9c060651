#include "vision/alignment/align_kernels.hpp"

#include "vision/core/lanes.hpp"

namespace armsreach::ARMSREACH_ISA {
namespace {

using lanes::Float;
using lanes::Int;
using lanes::kBlock;
using lanes::kWidth;

// A function, since a vector constant could be initialised by instructions the processor lacks.
ARMSREACH_INLINE Float unknown() { return lanes::all(__builtin_nanf("")); }

// Value and derivatives (by pixel) of a plane inside the cell whose upper left corner is `at`.
struct Sample {
  Float value, x, y;
};

ARMSREACH_INLINE Sample sample(const float* plane, int stride, Int at, Float fx, Float fy) {
  const auto [v00, v01] = lanes::gather_pair(plane, at);
  const auto [v10, v11] = lanes::gather_pair(plane + stride, at);
  const Float upper = v01 - v00;
  const Float lower = v11 - v10;
  const Float left = v00 + fy * (v10 - v00);
  const Float x = upper + fy * (lower - upper);
  return {left + fx * x, x, (v10 - v00) + fx * (lower - upper)};
}

struct Ray {
  Float x, y;  // at depth 1
};

// The inverse depth of a plane through the source's pixel, as its gradient says, is rho = n . ray
// with n = (gx, gy, rho - gx x - gy y). After the motion it is n' = R n / (1 + R n . t).
// Returned times its denominator, which saves a division.
struct Gradient {
  Float X, Y, denominator;
};
ARMSREACH_INLINE Gradient moved_gradient(const Warp& warp, Ray ray, Float rho, Float gx, Float gy) {
  const Float gz = rho - gx * ray.x - gy * ray.y;
  const auto& R = warp.rotation;
  const Float nx = R[0][0] * gx + R[0][1] * gy + R[0][2] * gz;
  const Float ny = R[1][0] * gx + R[1][1] * gy + R[1][2] * gz;
  const Float nz = R[2][0] * gx + R[2][1] * gy + R[2][2] * gz;
  const auto& t = warp.translation;
  return {nx, ny, 1.0F + nx * t[0] + ny * t[1] + nz * t[2]};
}

ARMSREACH_INLINE void warp_lanes(const Planes& source, const Planes& target, const Warp& warp,
                                 const Residuals& out, int at, Ray ray) {
  const Float rho = lanes::load(source.inverse_depth + at);
  const auto& R = warp.rotation;
  const auto& t = warp.translation;
  // The point times its inverse depth: no division by a depth that may be unknown.
  const Float qx = R[0][0] * ray.x + R[0][1] * ray.y + R[0][2] + t[0] * rho;
  const Float qy = R[1][0] * ray.x + R[1][1] * ray.y + R[1][2] + t[1] * rho;
  const Float qz = R[2][0] * ray.x + R[2][1] * ray.y + R[2][2] + t[2] * rho;
  const Gradient gradient =
      moved_gradient(warp, ray, rho, source.fx * lanes::load(source.inverse_depth_x + at),
                     source.fy * lanes::load(source.inverse_depth_y + at));
  // The gradient may be unknown where the point is not, and must not spoil it.
  const Float denominator = gradient.denominator > 0.0F ? gradient.denominator : lanes::all(1.0F);
  const Float quotient = 1.0F / (qz * denominator);
  const Float per_z = quotient * denominator;
  const Float per_denominator = quotient * qz;
  const Float X = qx * per_z;
  const Float Y = qy * per_z;
  const Float rho_warped = rho * per_z;
  // Strictly inside the last cells, so that a cell's right and lower samples exist.
  const Float last_u = lanes::all(static_cast<float>(target.width - 1) * 0.999999F);
  const Float last_v = lanes::all(static_cast<float>(target.height - 1) * 0.999999F);
  const Float u = target.fx * X + target.cx;
  const Float v = target.fy * Y + target.cy;
  // An unknown point is NaN in u and v, equal to nothing.
  const Float u_inside = lanes::min(lanes::max(u, Float{}), last_u);
  const Float v_inside = lanes::min(lanes::max(v, Float{}), last_v);
  Float nowhere = u == u_inside ? Float{} : unknown();
  nowhere = v == v_inside ? nowhere : unknown();
  nowhere = qz > 0.0F ? nowhere : unknown();
  const Int col = __builtin_convertvector(u_inside, Int);
  const Int row = __builtin_convertvector(v_inside, Int);
  const Float fx = u - __builtin_convertvector(col, Float);
  const Float fy = v - __builtin_convertvector(row, Float);
  const Int cell = row * target.stride + col;

  const Sample depth = sample(target.inverse_depth, target.stride, cell, fx, fy);
  const Float steepest = lanes::max(lanes::abs(depth.x), lanes::abs(depth.y));
  const Float depth_gX = 0.5F * (target.fx * depth.x + per_denominator * gradient.X);
  const Float depth_gY = 0.5F * (target.fy * depth.y + per_denominator * gradient.Y);
  Float depth_residual = depth.value - rho_warped + nowhere;
  depth_residual = steepest <= target.greatest_step * depth.value ? depth_residual : unknown();
  depth_residual = gradient.denominator > 0.0F ? depth_residual : unknown();

  const Sample grey = sample(target.intensity, target.stride, cell, fx, fy);
  const Float grey_gX =
      0.5F * (target.fx * grey.x + source.fx * lanes::load(source.intensity_x + at));
  const Float grey_gY =
      0.5F * (target.fy * grey.y + source.fy * lanes::load(source.intensity_y + at));
  // Zero times a derivative is NaN where that is.
  const Float grey_residual = grey.value - lanes::load(source.intensity + at) -
                              warp.intensity_offset + nowhere + 0.0F * (grey_gX + grey_gY);

  lanes::store(out.depth + at, depth_residual);
  lanes::store(out.intensity + at, grey_residual);
  lanes::store(out.X + at, X);
  lanes::store(out.Y + at, Y);
  lanes::store(out.inverse_z + at, rho_warped);
  lanes::store(out.depth_gX + at, depth_gX);
  lanes::store(out.depth_gY + at, depth_gY);
  lanes::store(out.intensity_gX + at, grey_gX);
  lanes::store(out.intensity_gY + at, grey_gY);
}

void warp(const Planes& source, const Planes& target, const Warp& target_from_source,
          const Residuals& out) {
  const float per_fx = 1.0F / source.fx;
  const float per_fy = 1.0F / source.fy;
  for (int row = 0; row < source.height; ++row) {
    const Float y = lanes::all((static_cast<float>(row) - source.cy) * per_fy);
    for (int col = 0; col < source.stride; col += kWidth) {
      const Float x = (lanes::counting() + (static_cast<float>(col) - source.cx)) * per_fx;
      warp_lanes(source, target, target_from_source, out, row * source.stride + col, {x, y});
    }
  }
}

// Tukey's biweight; zero for NaN.
ARMSREACH_INLINE Float tukey(Float residual, const Weighting& weighting) {
  const float per_cutoff = 1.0F / weighting.cutoff;
  const Float u = residual * per_cutoff;
  const Float inside = 1.0F - u * u;
  return inside > 0.0F ? inside * inside : Float{};
}

// The intensity's, which counts for nothing where there is another surface.
ARMSREACH_INLINE Float intensity_tukey(Float residual, const Weighting& weighting,
                                       Float depth_residual, Float depth_weight) {
  const Float weight = tukey(residual, weighting);
  const Float on_surface = depth_weight > 0.0F ? weight : Float{};
  return depth_residual == depth_residual ? on_surface : weight;
}

// Derivative of a residual by a motion (translation, rotation) of the warped point q: with a the
// derivative by q, that by the rotation is q x a.
struct Row {
  Float v[6];
};
ARMSREACH_INLINE Row row_by_motion(Float X, Float Y, Float rho, Float gX, Float gY, Float by_rho) {
  const Float ax = gX;
  const Float ay = gY;
  const Float az = by_rho - gX * X - gY * Y;
  // (ax, ay, az) times rho is the derivative by q; q is (X, Y, 1) / rho.
  return {{rho * ax, rho * ay, rho * az, Y * az - ay, ax - X * az, X * ay - Y * ax}};
}

// Sums of kBlock lanes each, so that every level adds the same numbers in the same order.
struct LaneSums {
  Float v[kBlock / kWidth][kSums];
};

ARMSREACH_INLINE void accumulate_lanes(const Residuals& in, int at, const Weighting& depth,
                                       const Weighting& intensity, Float* sums) {
  const Float X = lanes::load(in.X + at);
  const Float Y = lanes::load(in.Y + at);
  const Float rho = lanes::load(in.inverse_z + at);
  const Float depth_r = lanes::load(in.depth + at);
  const Float grey_r = lanes::load(in.intensity + at);
  const Float depth_t = tukey(depth_r, depth);
  const Float grey_t = intensity_tukey(grey_r, intensity, depth_r, depth_t);
  const Float depth_w = depth.gain * depth_t;
  const Float grey_w = intensity.gain * grey_t;

  Row jd =
      row_by_motion(X, Y, rho, lanes::load(in.depth_gX + at), lanes::load(in.depth_gY + at), rho);
  Row jg = row_by_motion(X, Y, rho, lanes::load(in.intensity_gX + at),
                         lanes::load(in.intensity_gY + at), Float{});
  // What is not used may be NaN.
  const Float rd = depth_w > 0.0F ? depth_r : Float{};
  const Float rg = grey_w > 0.0F ? grey_r : Float{};
  for (int i = 0; i < 6; ++i) {
    jd.v[i] = depth_w > 0.0F ? jd.v[i] : Float{};
    jg.v[i] = grey_w > 0.0F ? jg.v[i] : Float{};
  }
  int k = 0;
  for (int i = 0; i < 6; ++i) {
    const Float wd = depth_w * jd.v[i];
    const Float wg = grey_w * jg.v[i];
    for (int j = i; j < 6; ++j) sums[k++] += wd * jd.v[j] + wg * jg.v[j];
    sums[k++] -= wg;
    sums[kTriangle + i] += wd * rd + wg * rg;
  }
  sums[k] += grey_w;
  sums[kTriangle + 6] -= grey_w * rg;
  sums[kSums - 1] += depth_w * rd * rd + grey_w * rg * rg;
}

void accumulate(const Residuals& residuals, int size, const Weighting& depth,
                const Weighting& intensity, double sums[kSums]) {
  LaneSums lane_sums{};
  for (int at = 0; at < size; at += kBlock) {
    for (int part = 0; part < kBlock / kWidth; ++part) {
      accumulate_lanes(residuals, at + part * kWidth, depth, intensity, lane_sums.v[part]);
    }
  }
  for (int k = 0; k < kSums; ++k) {
    double sum = 0;
    for (const auto& part : lane_sums.v) {
      for (int lane = 0; lane < kWidth; ++lane) sum += static_cast<double>(part[k][lane]);
    }
    sums[k] = sum;
  }
}

void weigh(const Residuals& residuals, int size, const Weighting& depth, const Weighting& intensity,
           float* weights) {
  for (int at = 0; at < size; at += kWidth) {
    const Float depth_r = lanes::load(residuals.depth + at);
    const Float grey_r = lanes::load(residuals.intensity + at);
    const Float depth_gain = depth_r == depth_r ? lanes::all(depth.gain) : Float{};
    const Float grey_gain = grey_r == grey_r ? lanes::all(intensity.gain) : Float{};
    const Float gain = depth_gain + grey_gain;
    const Float depth_t = tukey(depth_r, depth);
    const Float weight =
        depth_gain * depth_t + grey_gain * intensity_tukey(grey_r, intensity, depth_r, depth_t);
    lanes::store(weights + at, gain > 0.0F ? weight / gain : unknown());
  }
}

}  // namespace

extern const AlignKernels kAlignKernels;
const AlignKernels kAlignKernels{warp, accumulate, weigh};

}  // namespace armsreach::ARMSREACH_ISA
