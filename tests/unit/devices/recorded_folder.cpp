#include "tests/unit/devices/recorded_folder.hpp"

#include <cstdint>
#include <fstream>
#include <iterator>
#include <sstream>

#include <opencv2/imgcodecs.hpp>

namespace armsreach::test {

namespace fs = std::filesystem;

void RecordedFolder::write(const std::string& name, const std::string& text) const {
  fs::create_directories((path() / name).parent_path());
  std::ofstream(path() / name, std::ios::binary) << text;
}

std::string RecordedFolder::read(const std::string& name) const {
  std::ifstream in(path() / name, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void RecordedFolder::replace(const std::string& name, const std::string& from,
                             const std::string& to) const {
  std::string text = read(name);
  text.replace(text.find(from), from.size(), to);  // throws when it is not there
  write(name, text);
}

void RecordedFolder::truncate(const std::string& name, double kept_fraction) const {
  const auto size = static_cast<double>(fs::file_size(path() / name));
  fs::resize_file(path() / name, static_cast<std::uintmax_t>(size * kept_fraction));
}

std::string camera_yaml(int width, int height) {
  std::ostringstream text;
  text << "image_width: " << width << "\nimage_height: " << height
       << "\ncamera_matrix: {data: [30.0, 0, 15.5, 0, 30.0, 11.5, 0, 0, 1]}\n"
       << "distortion_model: plumb_bob\ndistortion_coefficients: {data: [0, 0, 0, 0, 0]}\n"
       << "depth_units_per_metre: 5000\n";
  return text.str();
}

cv::Mat color_image(int width, int height, int seed) {
  cv::Mat image(height, width, CV_8UC3);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const int texture = (x * 7919 + y * 104729 + seed * 31) % 251;
      image.at<cv::Vec3b>(y, x) = {cv::saturate_cast<uchar>(texture), cv::saturate_cast<uchar>(x),
                                   cv::saturate_cast<uchar>(y + 100)};
    }
  }
  return image;
}

void write_small_recording(const RecordedFolder& folder) {
  fs::create_directories(folder / "rgb");
  fs::create_directories(folder / "depth");
  std::string rgb = "# color images\n";
  std::string depth = "# depth maps\n";
  std::string truth = "# truth\n";
  for (int i = 0; i < 3; ++i) {
    const std::string number = std::to_string(i);
    const std::string time = "0." + number;
    cv::imwrite(folder / ("rgb/" + number + ".png"), color_image(kWidth, kHeight, i));
    cv::Mat raw(kHeight, kWidth, CV_16UC1, cv::Scalar(5000 * (i + 1)));
    raw.at<std::uint16_t>(0, 0) = 0;
    raw.at<std::uint16_t>(0, 1) = 65535;
    raw.at<std::uint16_t>(0, 2) = 1;
    cv::imwrite(folder / ("depth/" + number + ".png"), raw);
    rgb += time + " rgb/" + number + ".png\n";
    depth += time + " depth/" + number + ".png\n";
    truth += time + " " + number + " 0 0 0 0 0 1\n";
  }
  folder.write("rgb.txt", rgb);
  folder.write("depth.txt", depth);
  folder.write("groundtruth.txt", truth);
  folder.write("camera.yaml", camera_yaml(kWidth, kHeight));
}

}  // namespace armsreach::test
