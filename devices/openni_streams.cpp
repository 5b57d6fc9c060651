#include "devices/openni_streams.hpp"

#include <PS1080.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "devices/calibration.hpp"

namespace armsreach {
namespace {

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
constexpr double kUsualBaseline = 2.5;  // cm, of colour and depth in PrimeSense's sensors

// Seen from behind, the colour camera sits to the right of the infra-red one.
Pose color_from_depth(const openni::VideoStream& depth) {
  double baseline = 0;  // cm
  if (depth.getProperty(XN_STREAM_PROPERTY_DCMOS_RCMOS_DISTANCE, &baseline) != openni::STATUS_OK ||
      !(baseline > 0 && baseline < 50)) {
    baseline = kUsualBaseline;
  }
  return {Eigen::Quaterniond::Identity(), Eigen::Vector3d(-0.01 * baseline, 0, 0)};
}

Result<cv::Mat> refused(const std::string& what) {
  return Error{what, "OpenNI2 stream", "record or stream uncropped images of millimetres and RGB",
               Error::Kind::device};
}

// The library's memory as an image of `type`; empty where the frame is smaller than it says.
cv::Mat view_of(const openni::VideoFrameRef& frame, int type) {
  const int stride = frame.getStrideInBytes();
  const int width = frame.getWidth();
  const int height = frame.getHeight();
  if (width <= 0 || height <= 0 || stride < width * static_cast<int>(CV_ELEM_SIZE(type)) ||
      frame.getDataSize() < stride * height) {
    return {};
  }
  return cv::Mat(height, width, type, const_cast<void*>(frame.getData()),
                 static_cast<std::size_t>(stride));
}

cv::Mat turned_back(cv::Mat image, bool mirrored) {
  if (mirrored) cv::flip(image, image, 1);
  return image;
}

}  // namespace

Result<std::shared_ptr<OpenNiLibrary>> OpenNiLibrary::start() {
  if (openni::OpenNI::initialize() == openni::STATUS_OK) {
    return std::shared_ptr<OpenNiLibrary>(new OpenNiLibrary);
  }
  const std::string what = openni_complaint("OpenNI2 does not start");
  openni::OpenNI::shutdown();
  return Error{what, "OpenNI2", "sudo apt-get install --reinstall libopenni2-0",
               Error::Kind::device};
}

OpenNiLibrary::~OpenNiLibrary() { openni::OpenNI::shutdown(); }

std::string openni_complaint(const std::string& otherwise) {
  std::string text = openni::OpenNI::getExtendedError();
  for (char& c : text) {
    if (c == '\n' || c == '\t' || c == '\r') c = ' ';
  }
  const auto first = text.find_first_not_of(' ');
  if (first == std::string::npos) return otherwise;
  return text.substr(first, text.find_last_not_of(' ') - first + 1);
}

std::optional<Camera> stream_camera(const openni::VideoStream& stream) {
  const openni::VideoMode mode = stream.getVideoMode();
  const int width = mode.getResolutionX();
  const int height = mode.getResolutionY();
  const auto horizontal = static_cast<double>(stream.getHorizontalFieldOfView());  // rad
  const auto vertical = static_cast<double>(stream.getVerticalFieldOfView());
  const auto is_angle = [](double angle) { return angle > 0.01 && angle < 3.1; };
  if (!is_angle(horizontal) || !is_angle(vertical)) return std::nullopt;
  return pinhole(width, height, 0.5 * width / std::tan(0.5 * horizontal),
                 0.5 * height / std::tan(0.5 * vertical), 0.5 * (width - 1), 0.5 * (height - 1));
}

StreamsSensor sensor_of_streams(const openni::VideoStream& depth, const openni::VideoStream& color,
                                bool registered) {
  StreamsSensor result;
  SensorInfo& sensor = result.sensor;
  const auto camera_of = [&result](const openni::VideoStream& stream) {
    if (auto camera = stream_camera(stream)) return *camera;
    result.nominal = true;
    return guessed_camera(stream.getVideoMode().getResolutionX(),
                          stream.getVideoMode().getResolutionY());
  };
  sensor.depth_camera = camera_of(depth);
  const int rate = depth.getVideoMode().getFps();
  if (rate > 0) sensor.rate = rate;
  if (!color.isValid()) return result;

  sensor.color_camera = camera_of(color);
  if (!registered) {
    sensor.registered = false;
    sensor.color_from_depth = color_from_depth(depth);
    return result;
  }
  const int width = sensor.depth_camera->width;
  const int height = sensor.depth_camera->height;
  sensor.depth_camera = resized(*sensor.color_camera, width, height);
  sensor.registered = width == sensor.color_camera->width && height == sensor.color_camera->height;
  return result;
}

Result<cv::Mat> depth_image(const openni::VideoFrameRef& frame, bool mirrored) {
  const openni::PixelFormat format = frame.getVideoMode().getPixelFormat();
  const bool fine = format == openni::PIXEL_FORMAT_DEPTH_100_UM;
  if (!fine && format != openni::PIXEL_FORMAT_DEPTH_1_MM) return refused("depth has no unit");
  const cv::Mat numbers = view_of(frame, CV_16U);
  if (numbers.empty() || frame.getCroppingEnabled()) return refused("a depth image is cut off");
  cv::Mat depth;
  numbers.convertTo(depth, CV_32F, fine ? 1e-4 : 1e-3);
  depth.setTo(kUnknown, numbers == 0);
  return turned_back(std::move(depth), mirrored);
}

Result<cv::Mat> color_image(const openni::VideoFrameRef& frame, bool mirrored) {
  const openni::PixelFormat format = frame.getVideoMode().getPixelFormat();
  int type = CV_8UC3;
  int conversion = cv::COLOR_RGB2BGR;
  if (format == openni::PIXEL_FORMAT_YUV422 || format == openni::PIXEL_FORMAT_YUYV) {
    type = CV_8UC2;
    conversion =
        format == openni::PIXEL_FORMAT_YUYV ? cv::COLOR_YUV2BGR_YUYV : cv::COLOR_YUV2BGR_UYVY;
  } else if (format == openni::PIXEL_FORMAT_GRAY8) {
    type = CV_8U;
  } else if (format != openni::PIXEL_FORMAT_RGB888) {
    return refused("colour comes in an unknown format");
  }
  const cv::Mat view = view_of(frame, type);
  if (view.empty() || frame.getCroppingEnabled()) return refused("a colour image is cut off");
  if (type == CV_8U) return turned_back(view.clone(), mirrored);
  cv::Mat color;
  cv::cvtColor(view, color, conversion);
  return turned_back(std::move(color), mirrored);
}

Timestamp frame_time(const openni::VideoFrameRef& frame) {
  constexpr std::uint64_t kLatest = 4'000'000'000'000'000;  // us, kLatestTime
  const std::uint64_t microseconds = std::min<std::uint64_t>(frame.getTimestamp(), kLatest);
  return static_cast<Timestamp>(microseconds) * 1000;
}

}  // namespace armsreach
