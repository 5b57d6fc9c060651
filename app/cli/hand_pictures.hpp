// What the gesture commands look at: images, folders of them and videos, each with its skin.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "vision/core/result.hpp"

namespace armsreach::app {

struct HandPicture {
  std::string file;
  std::int64_t frame = 0;  // of a video; 0 for images
  cv::Mat bgr;             // CV_8UC3
  cv::Mat skin;            // CV_8UC1, 255 on it
  int enlarged = 1;        // times, both of them: a thumbnail's skin is found between its pixels
};

struct SkinSource {
  std::string model;  // file; empty: the program's own
  std::string masks;  // folder of masks that take the place of segmentation; empty: none
};

// Calls `look` with each in turn, until one returns an error. A folder's images go by name; images
// that stand for a mask (*.mask.png) are left out.
Status for_hand_pictures(const std::vector<std::string>& places, const SkinSource& skin,
                         const std::function<Status(const HandPicture&)>& look);

}  // namespace armsreach::app
