// armsreach calibrate camera: intrinsics from a chessboard, in images or shown to a camera.
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "app/cli/color_files.hpp"
#include "app/cli/commands.hpp"
#include "app/cli/rig_options.hpp"
#include "app/pipelines/presenter.hpp"
#include "app/runtime/interrupt.hpp"
#include "app/runtime/output_file.hpp"
#include "devices/image_file.hpp"
#include "vision/calibration/board_coverage.hpp"
#include "vision/calibration/camera_calibration.hpp"

namespace armsreach::app {
namespace {

namespace fs = std::filesystem;
using calibration::BoardCoverage;
using calibration::Chessboard;
using calibration::Corners;

struct CalibrateOptions {
  std::vector<std::string> images;
  RigOptions rig;
  std::string board = "9x6";
  double square = 0.025;
  std::string model = "plumb_bob";
  std::string out = "camera.yaml";
  std::string plots;
  std::string display = "auto";
};

// A view that is calibrated from, and where it came from.
struct View {
  std::string name;
  cv::Mat image;
  Corners corners;
};

struct Views {
  cv::Size size;
  std::vector<View> views;
};

Result<Chessboard> board_of(const CalibrateOptions& options) {
  Chessboard board;
  board.square = options.square;
  if (!(board.square > 0 && board.square < 10)) {
    return Error{"no side of a square", "--square", "give metres, for example --square 0.025"};
  }
  char end = 0;
  const int read = std::sscanf(options.board.c_str(), "%dx%d%c", &board.columns, &board.rows, &end);
  if (read == 2 && board.columns > 2 && board.rows > 2 && board.corners() < 2500) return board;
  return Error{"'" + options.board + "' is not COLUMNSxROWS of inner corners", "--board",
               "for example --board 9x6"};
}

Distortion model_of(const std::string& text) {
  if (text == "fisheye") return Distortion::fisheye;
  if (text == "rational_polynomial") return Distortion::rational_polynomial;
  return Distortion::plumb_bob;
}

std::string progress_text(const BoardCoverage& coverage) {
  const auto shares = coverage.progress();
  char text[120];
  std::snprintf(text, sizeof text,
                "%d views; across %.0f %%, down %.0f %%, near-far %.0f %%, "
                "tilted %.0f %%",
                coverage.views(), 100 * shares[0], 100 * shares[1], 100 * shares[2],
                100 * shares[3]);
  return text;
}

Result<Views> views_in_images(const CalibrateOptions& options, const Chessboard& board) {
  auto files = list_pictures(options.images);
  if (!files) return files.error();
  Views out;
  for (const fs::path& file : *files) {
    auto image = read_color_image(file);
    if (!image) return image.error();
    if (out.size.empty()) out.size = image->size();
    if (image->size() != out.size) {
      return Error{"differs in size from the images before it", file.string(),
                   "calibrate each size of image alone"};
    }
    auto corners = find_chessboard(*image, board);
    if (corners) {
      out.views.push_back({file.filename().string(), *image, *std::move(corners)});
    } else {
      std::printf("%-24s no whole %s board in it\n", file.filename().c_str(),
                  options.board.c_str());
    }
  }
  return out;
}

render::Scene scene_of(const Frame& frame, const Camera& camera,
                       const std::optional<Corners>& corners, const BoardCoverage& coverage) {
  render::Scene scene;
  scene.frame = frame.index;
  scene.time = seconds_from_timestamp(frame.time);
  scene.background = frame.color;
  scene.camera = camera;
  for (const cv::Point2f& corner : corners.value_or(Corners{})) {
    render::Feature feature;
    feature.pixel = {corner.x, corner.y};
    feature.covariance = Eigen::Matrix2f::Zero();
    scene.features.push_back(feature);
  }
  scene.messages.push_back({render::Severity::info, progress_text(coverage)});
  if (const std::string advice = coverage.advice(); !advice.empty()) {
    scene.messages.push_back({render::Severity::info, advice});
  }
  return scene;
}

Result<std::unique_ptr<Presenter>> make_presenter(const CalibrateOptions& options,
                                                  const Camera& camera) {
  PresenterOptions shown;
  shown.display = options.display;
  shown.width = camera.width;
  shown.height = camera.height;
  return Presenter::make(shown);
}

// Takes what is new until it covers the camera, the source ends or the person has had enough.
Result<Views> views_from_source(const CalibrateOptions& options, const Chessboard& board) {
  auto rig = open_rig(options.rig);
  if (!rig) return rig.error();
  const InterruptGuard guard([&] { (*rig)->stop(); });
  const SensorInfo& sensor = *(*rig)->sensors()[main_sensor(**rig)].source->sensor();
  if (!sensor.color_camera) {
    return Error{"has no colour camera", options.rig.sources.front(), "give one that has"};
  }
  auto presenter = make_presenter(options, *sensor.color_camera);
  if (!presenter) return presenter.error();
  Views out;
  out.size = {sensor.color_camera->width, sensor.color_camera->height};
  BoardCoverage coverage(board, out.size);
  while (!coverage.complete() && !(*presenter)->should_close()) {
    auto frame = (*rig)->next();
    if (!frame) return frame.error();
    if (!*frame) break;
    if ((*frame)->color.empty() || (*frame)->sensor->name != sensor.name) continue;
    const auto corners = find_chessboard((*frame)->color, board);
    if (corners && coverage.adds(*corners)) {
      coverage.take(*corners);
      out.views.push_back(
          {"frame_" + std::to_string((*frame)->index) + ".png", (*frame)->color, *corners});
      std::printf("%s; %s\n", progress_text(coverage).c_str(), coverage.advice().c_str());
    }
    auto user = (*presenter)->present(scene_of(**frame, *sensor.color_camera, corners, coverage));
    if (!user) return user.error();
  }
  return out;
}

// Corners as found (circles) and, twenty times as far as they are, where the model puts them.
Status plot_view(const fs::path& folder, const View& view, const Corners& reprojected) {
  constexpr float kMagnified = 20;
  constexpr int kShift = 4;  // fractional bits of OpenCV's drawing
  cv::Mat picture = view.image.clone();
  if (picture.channels() == 1) cv::cvtColor(picture, picture, cv::COLOR_GRAY2BGR);
  const auto fixed = [](const cv::Point2f& p) { return cv::Point(p * float{1 << kShift}); };
  for (std::size_t i = 0; i < view.corners.size(); ++i) {
    const cv::Point2f end = view.corners[i] + (reprojected[i] - view.corners[i]) * kMagnified;
    cv::circle(picture, fixed(view.corners[i]), 3 << kShift, {80, 220, 80}, 1, cv::LINE_AA, kShift);
    cv::line(picture, fixed(view.corners[i]), fixed(end), {60, 60, 255}, 1, cv::LINE_AA, kShift);
  }
  const fs::path file = folder / fs::path(view.name).replace_extension(".png");
  if (cv::imwrite(file.string(), picture)) return ok();
  return Error{"cannot be written", file.string(), "check the folder given to --plots"};
}

Status plot_views(const std::string& folder, const Views& views,
                  const calibration::CameraCalibration& result) {
  if (folder.empty()) return ok();
  std::error_code failure;
  fs::create_directories(folder, failure);
  if (failure) return Error{failure.message(), folder, "check the folder given to --plots"};
  for (std::size_t i = 0; i < views.views.size(); ++i) {
    if (auto status = plot_view(folder, views.views[i], result.reprojected[i]); !status)
      return status;
  }
  return ok();
}

std::string today() {
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  localtime_r(&now, &local);
  char text[16];
  std::strftime(text, sizeof text, "%Y-%m-%d", &local);
  return text;
}

void print_result(const Views& views, const calibration::CameraCalibration& result,
                  const BoardCoverage& coverage) {
  for (std::size_t i = 0; i < views.views.size(); ++i) {
    std::printf("%-24s %6.3f px%s\n", views.views[i].name.c_str(), result.view_rms[i],
                result.kept[i] ? "" : "  left out: does not fit the others");
  }
  const Camera& camera = result.camera;
  std::printf("fx %.2f fy %.2f cx %.2f cy %.2f, rms %.3f px", camera.fx, camera.fy, camera.cx,
              camera.cy, result.rms);
  if (result.focal_deviation > 0) std::printf(", fx +- %.2f", result.focal_deviation);
  std::printf("\n%s\n", progress_text(coverage).c_str());
  if (const std::string advice = coverage.advice(); !advice.empty()) {
    std::printf("to know the camera better: %s\n", advice.c_str());
  }
}

Status calibrate(const CalibrateOptions& options) {
  if (options.images.empty() == (options.rig.sources.empty() && options.rig.rig.empty())) {
    return Error{"needs either images or a source", "calibrate camera",
                 "for example: calibrate camera --source camera:0"};
  }
  auto board = board_of(options);
  if (!board) return board.error();
  auto views = options.images.empty() ? views_from_source(options, *board)
                                      : views_in_images(options, *board);
  if (!views) return views.error();
  std::vector<Corners> corners;
  BoardCoverage coverage(*board, views->size);
  for (const View& view : views->views) {
    corners.push_back(view.corners);
    coverage.take(view.corners);
  }
  const std::string where = options.images.empty() ? "--source" : options.images.front();
  auto result = calibrate_camera(corners, views->size, *board, model_of(options.model), where);
  if (!result) return result.error();
  print_result(*views, *result, coverage);
  if (auto status = plot_views(options.plots, *views, *result); !status) return status;
  CameraFile file{result->camera, std::nullopt};
  const auto kept = std::count(result->kept.begin(), result->kept.end(), true);
  file.calibration = CalibrationRecord{today(), result->rms, static_cast<int>(kept)};
  auto status = write_file(options.out, [&](std::ostream& out) { write_camera_yaml(out, file); });
  if (status) std::printf("%s\n", options.out.c_str());
  return status;
}

}  // namespace

void add_calibrate_camera(CLI::App& calibrate_verb, Task* task) {
  CLI::App* command =
      calibrate_verb.add_subcommand("camera", "a camera's lens from views of a chessboard");
  auto o = std::make_shared<CalibrateOptions>();
  command->add_option("images", o->images, "image files or folders");
  command->add_option("--source", o->rig.sources, "or a source the board is shown to");
  command->add_option("--rig", o->rig.rig, "or a rig's main sensor");
  command->add_option("--board", o->board, "inner corners")->capture_default_str();
  command->add_option("--square", o->square, "side of a square, m")->capture_default_str();
  command->add_option("--model", o->model, "of the lens")
      ->check(CLI::IsMember({"plumb_bob", "rational_polynomial", "fisheye"}))
      ->capture_default_str();
  command->add_option("--out", o->out, "camera YAML to write")->capture_default_str();
  command->add_option("--plots", o->plots, "folder for pictures of the reprojection");
  command->add_option("--display", o->display, "where to show a source")
      ->check(CLI::IsMember({"auto", "window", "egl", "osmesa", "none"}))
      ->capture_default_str();
  command->callback([task, o] { *task = [o] { return calibrate(*o); }; });
}

}  // namespace armsreach::app
