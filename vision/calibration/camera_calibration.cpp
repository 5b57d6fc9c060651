#include "vision/calibration/camera_calibration.hpp"

#include <algorithm>
#include <cmath>

#include <opencv2/calib3d.hpp>

namespace armsreach::calibration {
namespace {

constexpr std::size_t kFewestViews = 3;
constexpr const char* kShowMore =
    "show the board tilted, near and far, and in every corner of the image";
// Of the focal length: a calibration that knows it worse is none.
constexpr double kMostDeviation = 0.03;
constexpr double kSameView = 1;  // px rms between the corners of a view and its repetition
// A view with this many times the median error has a corner in the wrong place (or a bent board).
constexpr double kOutlier = 4;

// What OpenCV's functions take and give.
struct Fit {
  cv::Mat matrix = cv::Mat::eye(3, 3, CV_64F);
  cv::Mat coefficients;
  std::vector<cv::Mat> rotations;
  std::vector<cv::Mat> translations;
  double focal_deviation = 0;
};

void fit_pinhole(const std::vector<std::vector<cv::Point3f>>& points,
                 const std::vector<Corners>& views, cv::Size image, Distortion model, Fit* fit) {
  const int flags = model == Distortion::rational_polynomial ? cv::CALIB_RATIONAL_MODEL : 0;
  cv::Mat deviations;
  cv::calibrateCamera(points, views, image, fit->matrix, fit->coefficients, fit->rotations,
                      fit->translations, deviations, cv::noArray(), cv::noArray(), flags);
  fit->focal_deviation = deviations.at<double>(0);
}

void fit_fisheye(const std::vector<std::vector<cv::Point3f>>& points,
                 const std::vector<Corners>& views, cv::Size image, Fit* fit) {
  fit->coefficients = cv::Mat::zeros(4, 1, CV_64F);
  cv::fisheye::calibrate(points, views, image, fit->matrix, fit->coefficients, fit->rotations,
                         fit->translations,
                         cv::fisheye::CALIB_RECOMPUTE_EXTRINSIC | cv::fisheye::CALIB_FIX_SKEW);
}

Fit fit_views(const std::vector<Corners>& views, cv::Size image, const Chessboard& board,
              Distortion model) {
  const std::vector<std::vector<cv::Point3f>> points(views.size(), points_on_board(board));
  Fit fit;
  if (model == Distortion::fisheye) {
    fit_fisheye(points, views, image, &fit);
  } else {
    fit_pinhole(points, views, image, model, &fit);
  }
  return fit;
}

Camera camera_of(const Fit& fit, cv::Size image, Distortion model) {
  Camera camera =
      pinhole(image.width, image.height, fit.matrix.at<double>(0, 0), fit.matrix.at<double>(1, 1),
              fit.matrix.at<double>(0, 2), fit.matrix.at<double>(1, 2));
  camera.distortion = model;
  for (int i = 0; i < coefficient_count(model); ++i) {
    camera.coefficients[static_cast<std::size_t>(i)] = fit.coefficients.at<double>(i);
  }
  return camera;
}

Corners reproject(const Chessboard& board, const Fit& fit, Distortion model, std::size_t view) {
  Corners corners;
  const auto points = points_on_board(board);
  if (model == Distortion::fisheye) {
    cv::fisheye::projectPoints(points, corners, fit.rotations[view], fit.translations[view],
                               fit.matrix, fit.coefficients);
  } else {
    cv::projectPoints(points, fit.rotations[view], fit.translations[view], fit.matrix,
                      fit.coefficients, corners);
  }
  return corners;
}

double rms_between(const Corners& a, const Corners& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const cv::Point2f d = a[i] - b[i];
    sum += static_cast<double>(d.dot(d));
  }
  return std::sqrt(sum / static_cast<double>(a.size()));
}

// Pictures of one view, however many, are one.
std::size_t distinct(const std::vector<Corners>& views) {
  std::vector<const Corners*> known;
  for (const Corners& view : views) {
    const auto same = [&](const Corners* other) { return rms_between(*other, view) < kSameView; };
    if (std::none_of(known.begin(), known.end(), same)) known.push_back(&view);
  }
  return known.size();
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

std::vector<double> view_errors(const std::vector<Corners>& views, const Chessboard& board,
                                const Fit& fit, Distortion model) {
  std::vector<double> errors;
  for (std::size_t i = 0; i < views.size(); ++i) {
    errors.push_back(rms_between(views[i], reproject(board, fit, model, i)));
  }
  return errors;
}

std::vector<Corners> kept_views(const std::vector<Corners>& views, const std::vector<bool>& kept) {
  std::vector<Corners> chosen;
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (kept[i]) chosen.push_back(views[i]);
  }
  return chosen;
}

// The fit's views are those kept; a view left out is shown where it was found.
CameraCalibration summary(const std::vector<Corners>& views, const Fit& fit, cv::Size image,
                          const Chessboard& board, Distortion model,
                          const std::vector<double>& first_errors, std::vector<bool> kept) {
  CameraCalibration out;
  out.camera = camera_of(fit, image, model);
  out.focal_deviation = fit.focal_deviation;
  out.view_rms = first_errors;
  double sum = 0;
  std::size_t fitted = 0;
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (!kept[i]) {
      out.reprojected.push_back(views[i]);
      continue;
    }
    out.reprojected.push_back(reproject(board, fit, model, fitted++));
    out.view_rms[i] = rms_between(views[i], out.reprojected[i]);
    sum += out.view_rms[i] * out.view_rms[i];
  }
  out.rms = std::sqrt(sum / static_cast<double>(fitted));
  out.kept = std::move(kept);
  return out;
}

}  // namespace

Result<CameraCalibration> calibrate_camera(const std::vector<Corners>& views, cv::Size image,
                                           const Chessboard& board, Distortion model,
                                           const std::string& where) {
  if (model == Distortion::monoslam) {
    return Error{"the monoslam model cannot be calibrated", where,
                 "use plumb_bob, rational_polynomial or fisheye"};
  }
  if (distinct(views) < kFewestViews) {
    return Error{std::to_string(distinct(views)) + " different views of the board are too few",
                 where,
                 "show all of it in at least three, better twelve, from different sides; "
                 "--board COLUMNSxROWS counts inner corners"};
  }
  try {
    Fit fit = fit_views(views, image, board, model);
    const std::vector<double> errors = view_errors(views, board, fit, model);
    const double limit = kOutlier * median(errors);
    std::vector<bool> kept(views.size());
    std::transform(errors.begin(), errors.end(), kept.begin(),
                   [&](double error) { return error <= limit; });
    const std::vector<Corners> good = kept_views(views, kept);
    if (good.size() < kFewestViews) {
      kept.assign(views.size(), true);
    } else if (good.size() < views.size()) {
      fit = fit_views(good, image, board, model);
    }
    if (!(fit.focal_deviation < kMostDeviation * fit.matrix.at<double>(0, 0))) {
      return Error{"the views leave the focal length uncertain by more than 3 %", where, kShowMore};
    }
    return summary(views, fit, image, board, model, errors, std::move(kept));
  } catch (const cv::Exception& e) {
    return Error{"the views do not determine a camera: " + e.err, where, kShowMore};
  }
}

}  // namespace armsreach::calibration
