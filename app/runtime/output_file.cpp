#include "app/runtime/output_file.hpp"

namespace armsreach::app {

Status OutputFile::open(const std::string& path) {
  path_ = path;
  if (path.empty()) return ok();
  stream_.open(path, std::ios::binary);
  if (stream_) return ok();
  return Error{"cannot be written", path, "check that its folder exists and is yours"};
}

Status OutputFile::close() {
  if (!stream_.is_open()) return ok();
  stream_.close();
  if (stream_) return ok();
  return Error{"could not be written completely", path_, "is the disk full?", Error::Kind::device};
}

}  // namespace armsreach::app
