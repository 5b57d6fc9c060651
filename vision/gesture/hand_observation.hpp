// What is seen of one hand in one image, before anything is made of it over time.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <opencv2/core/types.hpp>

namespace armsreach::gesture {

constexpr double kNoEvidence = -100;

// Pixels are those of the image the hand was found in.
struct HandObservation {
  int hand = 0;                          // within its image, the largest first
  std::optional<std::string> gesture;    // nothing where no gesture can be told
  std::string likeliest;                 // told or not; empty without templates
  double score = 0;                      // g of the likeliest gesture's best template, -1..1
  std::map<std::string, double> scores;  // g of the best template of each gesture
  // Of the hand in the image against its template, and of `point` that of the finger itself: rad, 0
  // upright (fingers up), clockwise positive.
  double angle = 0;
  Eigen::Vector2d center{0, 0};     // px, of the hand without its forearm
  Eigen::Vector2d fingertip{0, 0};  // px, the farthest point along that axis
  double area = 0;                  // px^2, without the forearm
  // Log odds that it is a hand making that gesture, see hand_evidence; kNoEvidence where its size
  // or place speaks against any.
  double evidence = kNoEvidence;
  std::vector<cv::Point> outline;  // px, closed, with the forearm
};
using HandObservations = std::vector<HandObservation>;

}  // namespace armsreach::gesture
