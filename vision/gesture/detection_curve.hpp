// How well scores tell what is there from what is not: the receiver operating characteristic.
#pragma once

#include <vector>

namespace armsreach::gesture {

struct CurvePoint {
  double threshold = 0;
  double false_rate = 0;  // of what is not there that reaches the threshold
  double true_rate = 0;   // of what is there
};

// One point for each threshold that changes anything, from the highest down; both rates rise from
// 0 to 1. Empty where either list is.
std::vector<CurvePoint> detection_curve(std::vector<double> there, std::vector<double> not_there);

// The area below it: 1 is perfect, 0.5 chance.
double area_under(const std::vector<CurvePoint>& curve);

// Where as many are missed as are falsely found, the rate of those missed.
double equal_error(const std::vector<CurvePoint>& curve);

}  // namespace armsreach::gesture
