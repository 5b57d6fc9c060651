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
  // CV_8UC1, 255 on skin: as the model sees it that was fitted to the picture, then, where there is
  // any, as the model itself does.
  std::vector<cv::Mat> skins;
  int enlarged = 1;  // times, both of them: a thumbnail's skin is found between its pixels
};

struct SkinSource {
  std::string model;  // file; empty: the program's own
  std::string masks;  // folder of masks that take the place of segmentation; empty: none
};

using Look = std::function<Status(const HandPicture&)>;

// Calls `look` with each in turn, until one cannot be read or `look` returns an error. A folder's
// images and videos go by name; images that stand for a mask (*.mask.png) are left out.
Status for_hand_pictures(const std::vector<std::string>& places, const SkinSource& skin,
                         const Look& look);

// The same, but what cannot be read is left out with a warning, and an error only where nothing
// can.
Status for_readable_hand_pictures(const std::vector<std::string>& places, const SkinSource& skin,
                                  const std::function<void(const HandPicture&)>& look);

}  // namespace armsreach::app
