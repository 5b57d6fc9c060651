// A hand's outline with the gesture it makes, on its way into a bank of templates.
#pragma once

#include <string>

#include <opencv2/core/mat.hpp>

namespace armsreach::tools {

struct BankExample {
  std::string gesture;
  cv::Mat mask;          // CV_8UC1, 255 on the hand
  bool upright = false;  // known to be, though perhaps no forearm is seen
};

}  // namespace armsreach::tools
