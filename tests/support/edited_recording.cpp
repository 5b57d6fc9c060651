#include "tests/support/edited_recording.hpp"

#include <fstream>
#include <sstream>
#include <string>

#include <opencv2/imgcodecs.hpp>

namespace armsreach::test {

namespace fs = std::filesystem;

void edit_recording(const fs::path& recording, const fs::path& folder,
                    const std::function<FrameEdit(int)>& edit) {
  fs::create_directories(folder);
  for (const char* name : {"rgb", "depth", "camera.yaml", "camera_color.yaml", "groundtruth.txt"}) {
    if (fs::exists(recording / name)) fs::create_symlink(recording / name, folder / name);
  }
  std::ifstream in(recording / "associations.txt");
  std::ofstream out(folder / "associations.txt");
  bool blanks_written = false;
  int frame = 0;
  for (std::string line; std::getline(in, line);) {
    std::string color_time, color, depth_time, depth;
    if (!(std::istringstream(line) >> color_time >> color >> depth_time >> depth)) continue;
    if (!blanks_written) {
      const cv::Size size = cv::imread(recording / color).size();
      cv::imwrite(folder / "black.png", cv::Mat(size, CV_8UC3, cv::Scalar::all(0)));
      cv::imwrite(folder / "blind.png", cv::Mat(size, CV_16U, cv::Scalar::all(0)));
      blanks_written = true;
    }
    const FrameEdit what = edit(frame++);
    if (what == FrameEdit::leave_out) continue;
    if (what == FrameEdit::cover) color = "black.png";
    if (what != FrameEdit::keep) depth = "blind.png";
    out << color_time << ' ' << color << ' ' << depth_time << ' ' << depth << '\n';
  }
}

}  // namespace armsreach::test
