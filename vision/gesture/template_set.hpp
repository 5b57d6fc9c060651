// Signatures of known gestures, and their files.
//
// A file holds the templates of one gesture as text:
//   armsreach-rings 1
//   samples 90
//   radii 0.2 0.3 ...
//   weights 2 3 ...
//   upright 0ff 0ff 1ff ...
// one line a template ("upright" or "free"), one hexadecimal number an angle, clockwise from the
// image's x axis, its lowest bit for the innermost ring.
#pragma once

#include <istream>
#include <ostream>
#include <string>
#include <vector>

#include "vision/core/result.hpp"
#include "vision/gesture/ring_layout.hpp"
#include "vision/gesture/ring_signature.hpp"

namespace armsreach::gesture {

struct GestureTemplate {
  std::string gesture;
  RingSignature signature;
  // The forearm of `signature` points down, so that it is compared only with turns a wrist allows
  // of hands whose forearm is seen. Else it may be turned in any way.
  bool upright = false;
};

struct TemplateSet {
  RingLayout layout = fine_rings();
  std::vector<GestureTemplate> templates;
};

// "12 rings of 90 samples, radii 0.2 0.3 ..., weights 2 3 ..."
std::string text_of(const RingLayout& layout);

// Adds the templates of a file to the set. The first file to an empty set brings its layout; any
// other must have the same. `where` names the stream in errors.
Status read_templates(std::istream& in, const std::string& gesture, const std::string& where,
                      TemplateSet* set);

// Those of one gesture.
void write_templates(std::ostream& out, const std::string& gesture, const TemplateSet& set);

}  // namespace armsreach::gesture
