// Codec of key frames, so that a saved map can be entered again another day.
//
// "ARKEYS01", then little-endian values without padding: the number of key frames (u32) and for
// each: frame (i64), world_from_color (qx qy qz qw tx ty tz, f64), pixel_size (f64), camera (width,
// height, distortion as i32; fx fy cx cy and eight coefficients as f64), depth (f32, row by row),
// the number of features (u32), their ray and depth (3 f32 each), their descriptors (128 bytes
// each).
#pragma once

#include <istream>
#include <ostream>
#include <string>

#include "vision/core/result.hpp"
#include "vision/relocalisation/relocaliser.hpp"

namespace armsreach::relocalisation {

// The stream's state tells whether it could be written.
void write_key_frames(std::ostream& out, const KeyFrames& key_frames);

// `where` names the stream in errors. A stream that ends early, or has sizes, poses, cameras or
// depths that cannot be, is an error.
Result<KeyFrames> read_key_frames(std::istream& in, const std::string& where);

}  // namespace armsreach::relocalisation
