#include "devices/tum_lists.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <optional>
#include <sstream>
#include <utility>

namespace armsreach {
namespace {

constexpr Timestamp kPairingTolerance = 20'000'000;  // ns, that of the set's own tools

Result<Timestamp> parse_time(const std::string& text, const std::string& line) {
  double seconds = 0;
  const char* end = text.data() + text.size();
  const auto [parsed, failure] = std::from_chars(text.data(), end, seconds);
  if (failure != std::errc() || parsed != end || !(std::abs(seconds) < kLatestTime)) {
    return Error{"'" + text + "' is not a time", line, "times are numbers of seconds"};
  }
  return timestamp_from_seconds(seconds);
}

// Reads one "time file" from `fields`.
Result<ListedFile> parse_file(std::istream& fields, const std::string& line,
                              const std::string& form) {
  std::string time_text;
  ListedFile listed;
  if (!(fields >> time_text >> listed.file)) {
    return Error{"the line is too short", line, "each line is: " + form};
  }
  auto time = parse_time(time_text, line);
  if (!time) return std::move(time).error();
  listed.time = *time;
  listed.line = line;
  return listed;
}

// Calls `read_line(fields, line)` for every line that is not a comment.
Status for_each_line(std::istream& in, const std::string& where, const std::string& form,
                     const std::function<Status(std::istream&, const std::string&)>& read_line) {
  bool any = false;
  std::string text;
  for (int number = 1; std::getline(in, text); ++number) {
    std::istringstream fields(text);
    if ((fields >> std::ws).eof() || fields.peek() == '#') continue;
    const std::string line = where + ":" + std::to_string(number);
    if (auto status = read_line(fields, line); !status) return status;
    if (!(fields >> std::ws).eof()) {
      return Error{"the line is too long", line, "each line is: " + form};
    }
    any = true;
  }
  if (!any) return Error{"the list is empty", where, "each line is: " + form};
  return ok();
}

Error backwards(const std::string& line) {
  return {"time does not increase", line, "sort the lines by time and remove repeated ones"};
}

const ListedFile& nearest(const std::vector<ListedFile>& sorted, Timestamp time) {
  auto after =
      std::lower_bound(sorted.begin(), sorted.end(), time,
                       [](const ListedFile& listed, Timestamp t) { return listed.time < t; });
  if (after == sorted.end()) return sorted.back();
  if (after == sorted.begin()) return sorted.front();
  return time - (after - 1)->time <= after->time - time ? *(after - 1) : *after;
}

}  // namespace

Result<std::vector<ListedFile>> read_tum_list(std::istream& in, const std::string& where) {
  const std::string form = "time file";
  std::vector<ListedFile> list;
  const auto read_line = [&](std::istream& fields, const std::string& line) -> Status {
    auto listed = parse_file(fields, line, form);
    if (!listed) return std::move(listed).error();
    if (!list.empty() && listed->time <= list.back().time) return backwards(line);
    list.push_back(std::move(*listed));
    return ok();
  };
  if (auto status = for_each_line(in, where, form, read_line); !status) return status.error();
  return list;
}

Result<std::vector<ListedFrame>> read_tum_associations(std::istream& in, const std::string& where) {
  const std::string form = "time colour-file time depth-file";
  std::vector<ListedFrame> frames;
  const auto read_line = [&](std::istream& fields, const std::string& line) -> Status {
    auto color = parse_file(fields, line, form);
    if (!color) return std::move(color).error();
    auto depth = parse_file(fields, line, form);
    if (!depth) return std::move(depth).error();
    if (!frames.empty() &&
        (depth->time <= frames.back().depth.time || color->time < frames.back().color.time)) {
      return backwards(line);
    }
    frames.push_back({std::move(*color), std::move(*depth)});
    return ok();
  };
  if (auto status = for_each_line(in, where, form, read_line); !status) return status.error();
  return frames;
}

std::vector<ListedFrame> associate(const std::vector<ListedFile>& color,
                                   const std::vector<ListedFile>& depth) {
  std::vector<ListedFrame> frames;
  if (color.empty()) return frames;
  for (const ListedFile& d : depth) {
    const ListedFile& c = nearest(color, d.time);
    if (std::abs(c.time - d.time) > kPairingTolerance) continue;
    if (&nearest(depth, c.time) == &d) frames.push_back({c, d});
  }
  return frames;
}

}  // namespace armsreach
