#include "vision/alignment/registration_kernels.hpp"

#include "vision/core/lanes.hpp"

namespace armsreach::ARMSREACH_ISA {
namespace {

using lanes::Float;
using lanes::Int;
using lanes::kWidth;

ARMSREACH_INLINE Float look_up(const RegistrationRow& row, const RegistrationImage& image,
                               int col) {
  const Float z = lanes::load(row.depth + col);
  const Float x = row.first_x + row.x_per_pixel * (lanes::counting() + static_cast<float>(col));
  const auto& R = row.rotation;
  const auto& t = row.translation;
  const Float qx = z * (R[0][0] * x + (R[0][1] * row.y + R[0][2])) + t[0];
  const Float qy = z * (R[1][0] * x + (R[1][1] * row.y + R[1][2])) + t[1];
  const Float qz = z * (R[2][0] * x + (R[2][1] * row.y + R[2][2])) + t[2];
  const Float per_z = 1.0F / qz;
  const Float u = image.fx * qx * per_z + image.cx;
  const Float v = image.fy * qy * per_z + image.cy;
  const Float last_u = lanes::all(static_cast<float>(image.width - 1) * 0.999999F);
  const Float last_v = lanes::all(static_cast<float>(image.height - 1) * 0.999999F);
  const Float u_inside = lanes::min(lanes::max(u, Float{}), last_u);
  const Float v_inside = lanes::min(lanes::max(v, Float{}), last_v);
  const Int left = __builtin_convertvector(u_inside, Int);
  const Int top = __builtin_convertvector(v_inside, Int);
  const Float fx = u_inside - __builtin_convertvector(left, Float);
  const Float fy = v_inside - __builtin_convertvector(top, Float);
  const Int cell = top * image.step + left;
  const auto [v00, v01] = lanes::gather_pair(image.pixels, cell);
  const auto [v10, v11] = lanes::gather_pair(image.pixels + image.step, cell);
  const Float upper = v00 + fx * (v01 - v00);
  const Float lower = v10 + fx * (v11 - v10);
  const Float unknown = lanes::all(__builtin_nanf(""));
  Float value = upper + fy * (lower - upper);
  value = u == u_inside ? value : unknown;
  value = v == v_inside ? value : unknown;
  return qz > 0.0F ? value : unknown;
}

void look_up_row(const RegistrationRow& row, const RegistrationImage& image, float* out) {
  for (int col = 0; col + kWidth <= row.width; col += kWidth) {
    lanes::store(out + col, look_up(row, image, col));
  }
  const int last = row.width - kWidth;
  lanes::store(out + last, look_up(row, image, last));
}

}  // namespace

extern const RegistrationKernels kRegistrationKernels;
const RegistrationKernels kRegistrationKernels{look_up_row};

}  // namespace armsreach::ARMSREACH_ISA
