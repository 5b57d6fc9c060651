// Pictures, masks and colour models by name, as the commands on colours and skin take them.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "vision/core/result.hpp"
#include "vision/gesture/color_model.hpp"

namespace armsreach::app {

// Files as they are given, folders as the pictures in them by name (*.mask.png left out). An error
// where there is none.
Result<std::vector<std::filesystem::path>> list_pictures(const std::vector<std::string>& places);

// CV_8UC3; a grey picture is an error, since it has no colours.
Result<cv::Mat> read_picture(const std::filesystem::path& file);

// The mask of a picture: folder/STEM.png or folder/STEM.mask.png, 8 or 16 bits. CV_8UC1 of `size`,
// 255 where it holds `value`, or anything but 0.
Result<cv::Mat> read_mask_of(const std::filesystem::path& picture, const std::string& folder,
                             const cv::Size& size, const std::optional<int>& value);

// Of skin or of things.
Result<gesture::ColorModel> read_model_file(const std::string& path);
// Of things that `learn colour` taught; a model of skin is an error.
Result<gesture::ColorModel> things_model(const std::string& path);
// What could not be read again is not written.
Status write_model_file(const std::string& path, const gesture::ColorModel& model);

// The file's, which must know skin; the program's own of people where `path` is empty, and of
// simulated hands where it is "simulated" (a file of that name is "./simulated").
Result<gesture::ColorModel> skin_model(const std::string& path);

}  // namespace armsreach::app
