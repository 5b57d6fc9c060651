// The Kinect v1's cameras and what its depth numbers mean.
#pragma once

#include <opencv2/core/mat.hpp>

#include "vision/core/camera.hpp"
#include "vision/core/frame.hpp"

namespace armsreach {

// The geometry that a Kinect stores at the factory: a reference image of its dot pattern was taken
// on a plane, and depth is the dots' shift against it. The values here are the usual ones.
struct KinectGeometry {
  double emitter_distance = 0.075;     // m, from the infra-red camera to the projector
  double color_distance = 0.024;       // m, from the infra-red camera to the colour camera
  double reference_distance = 1.2;     // m, of the plane
  double reference_pixel = 0.1042e-2;  // m on that plane, of a pixel 1280 to the image's width
};

// 640x480. Neither camera's distortion is in the geometry; both are nearly free of it.
Camera kinect_depth_camera(const KinectGeometry& geometry);
Camera kinect_color_camera();  // nominal

// Depth in the colour camera's pixels, or in its own.
SensorInfo registered_kinect();
SensorInfo unregistered_kinect(const KinectGeometry& geometry);

// Metres along z of an 11-bit depth number; NaN for unknown (2047) and beyond 10 m.
float kinect_depth(int number, const KinectGeometry& geometry);

// 640x480 images of 16 bits a pixel, as the driver gives them and not always aligned, to CV_32F
// metres, NaN unknown.
cv::Mat depth_from_numbers(const void* numbers, const KinectGeometry& geometry);
cv::Mat depth_from_millimetres(const void* millimetres);

}  // namespace armsreach
