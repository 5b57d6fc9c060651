#include "devices/image_recording.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "devices/calibration.hpp"
#include "devices/files.hpp"
#include "devices/image_file.hpp"

namespace armsreach {
namespace {

namespace fs = std::filesystem;

class ImageRecording : public Recording {
 public:
  ImageRecording(std::vector<fs::path> files, SensorInfo sensor, Events events)
      : files_(std::move(files)),
        sensor_(std::make_shared<const SensorInfo>(std::move(sensor))),
        events_(std::move(events)) {}

  const std::shared_ptr<const SensorInfo>& sensor() const override { return sensor_; }
  std::optional<std::int64_t> size() const override {
    return static_cast<std::int64_t>(files_.size());
  }
  Timestamp time(std::int64_t index) const override {
    return timestamp_from_seconds(static_cast<double>(index) / sensor_->rate);
  }
  Events take_events() override { return std::exchange(events_, {}); }

  Result<std::optional<Frame>> read(std::int64_t index) override {
    if (index >= *size()) return std::optional<Frame>();
    const fs::path& file = files_[static_cast<std::size_t>(index)];
    auto color = read_color_image(file);
    if (!color) return std::move(color).error();
    if (auto fits = check_size(color->size(), sensor_->camera(), "colour", file); !fits) {
      return fits.error();
    }
    Frame frame;
    frame.index = index;
    frame.time = time(index);
    frame.color = *color;
    frame.sensor = sensor_;
    return std::optional<Frame>(std::move(frame));
  }

 private:
  std::vector<fs::path> files_;
  std::shared_ptr<const SensorInfo> sensor_;
  Events events_;
};

// Of the first image that can be read; the others' errors are for whoever reads them.
Result<cv::Size> first_size(const std::vector<fs::path>& files) {
  for (const fs::path& file : files) {
    if (const auto image = read_color_image(file)) return image->size();
  }
  return Error{"none of the " + std::to_string(files.size()) + " images can be read",
               files.front().parent_path().string(), "copy the images again"};
}

}  // namespace

Result<std::unique_ptr<Recording>> open_image_recording(const fs::path& folder, double rate,
                                                        const OpenOptions& options) {
  const bool has_frames = folder_exists(folder / "frames");
  auto files = images_by_name(has_frames ? folder / "frames" : folder);
  if (!files) return std::move(files).error();
  auto size = first_size(*files);
  if (!size) return std::move(size).error();
  auto calibration = calibration_or_guess(options, folder / "camera.yaml", size->width,
                                          size->height, "images:" + folder.string());
  if (!calibration) return std::move(calibration).error();
  if (auto fits = check_size(*size, calibration->camera, "colour", files->front()); !fits) {
    return fits.error();
  }
  SensorInfo sensor;
  sensor.name = options.sensor;
  sensor.rate = rate;
  sensor.color_camera = calibration->camera;
  return std::make_unique<ImageRecording>(std::move(*files), std::move(sensor),
                                          std::move(calibration->events));
}

}  // namespace armsreach
