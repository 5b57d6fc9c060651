// Reading single image files whole: a file that ends early is an error, never a half-grey image.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "vision/core/camera.hpp"
#include "vision/core/result.hpp"

namespace armsreach {

// CV_8UC3 BGR, or CV_8UC1 of a grey file.
Result<cv::Mat> read_color_image(const std::filesystem::path& file);

// A folder's images in the order of their names; pictures of masks (*.mask.png) are none. An error
// where there are none.
Result<std::vector<std::filesystem::path>> images_by_name(const std::filesystem::path& folder);

// 16-bit single-channel file to CV_32F metres. 0 and the saturated 65535 are unknown: NaN.
Result<cv::Mat> read_depth_image(const std::filesystem::path& file, double units_per_metre);

// 16-bit single-channel file as it is.
Result<cv::Mat> read_mask_image(const std::filesystem::path& file);

// Depths as such a file holds them, CV_16UC1: rounded to whole units; 0 where they are unknown or
// too far for the format.
cv::Mat units_from_depth(const cv::Mat& depth, double units_per_metre);
// And back: what reading such a file gives.
cv::Mat depth_from_units(const cv::Mat& units, double units_per_metre);

// That images have their camera's size; `kind` ("colour", "depth") and `where` are for the error.
Status check_size(const cv::Size& size, const Camera& camera, const std::string& kind,
                  const std::string& where);

}  // namespace armsreach
