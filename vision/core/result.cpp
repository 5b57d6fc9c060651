#include "vision/core/result.hpp"

namespace armsreach {

std::string Error::message() const {
  std::string line = where.empty() ? what : where + ": " + what;
  if (!remedy.empty()) line += " (" + remedy + ")";
  return line;
}

}  // namespace armsreach
