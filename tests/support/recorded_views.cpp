#include "tests/support/recorded_views.hpp"

#include <fstream>
#include <limits>
#include <sstream>
#include <string>

#include <opencv2/imgcodecs.hpp>

#include "vision/core/camera_yaml.hpp"
#include "vision/core/pyramid.hpp"
#include "vision/core/trajectory.hpp"

namespace armsreach::test {

RecordedViews recorded_views(const std::filesystem::path& folder, int width, int count, int every) {
  std::ifstream camera_file(folder / "camera.yaml");
  const Camera camera = read_camera_yaml(camera_file, "camera.yaml").value().camera;
  std::ifstream truth_file(folder / "groundtruth.txt");
  const Trajectory truth = read_tum_trajectory(truth_file, "groundtruth.txt").value();
  std::ifstream list(folder / "associations.txt");
  const int factor = camera.width / width;
  RecordedViews out{resized(camera, width, camera.height / factor), {}};
  std::string line;
  for (int i = 0; i < every * count && std::getline(list, line); ++i) {
    if (i % every != 0) continue;
    std::istringstream words(line);
    double time = 0;
    std::string color;
    std::string depth;
    words >> time >> color >> time >> depth;
    cv::Mat metres;
    cv::imread(folder / depth, cv::IMREAD_UNCHANGED)
        .convertTo(metres, CV_32F, 1 / camera.depth_units_per_metre);
    metres.setTo(std::numeric_limits<float>::quiet_NaN(), metres == 0);
    out.views.push_back({reduced_depth(metres, factor),
                         reduced_intensity(cv::imread(folder / color), factor),
                         truth[static_cast<std::size_t>(i)].world_from_camera});
  }
  return out;
}

}  // namespace armsreach::test
