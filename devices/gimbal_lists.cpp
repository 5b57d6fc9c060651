#include "devices/gimbal_lists.hpp"

#include <array>
#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>

#include <nlohmann/json.hpp>

namespace armsreach {

Result<std::vector<GimbalState>> read_gimbal_states(std::istream& in, const std::string& where) {
  std::vector<GimbalState> states;
  std::string text;
  for (int number = 1; std::getline(in, text); ++number) {
    std::istringstream fields(text);
    if ((fields >> std::ws).eof() || fields.peek() == '#') continue;
    const std::string line = where + ":" + std::to_string(number);
    std::array<double, 7> values{};
    bool good = true;
    for (double& value : values) good = good && (fields >> value) && std::isfinite(value);
    if (!good || !(fields >> std::ws).eof() || std::abs(values[0]) >= kLatestTime) {
      return Error{"not a gimbal's state", line,
                   "each line is: time pan tilt roll pan-rate tilt-rate roll-rate"};
    }
    const GimbalState state{timestamp_from_seconds(values[0]),
                            {values[1], values[2], values[3]},
                            {values[4], values[5], values[6]}};
    if (!states.empty() && state.time <= states.back().time)
      return Error{"time does not increase", line, "sort the lines by time"};
    states.push_back(state);
  }
  return states;
}

void write_gimbal_state(std::ostream& out, const GimbalState& state) {
  std::ostringstream line;
  line << std::fixed << std::setprecision(9) << seconds_from_timestamp(state.time)
       << std::defaultfloat << std::setprecision(std::numeric_limits<double>::max_digits10);
  for (const double angle : state.angles) line << ' ' << angle;
  for (const double rate : state.rates) line << ' ' << rate;
  out << line.str() << '\n';
}

void write_gimbal_command(std::ostream& out, const GimbalCommand& command) {
  const Eigen::Vector3d& a = command.angles;
  const nlohmann::json json{{"t", seconds_from_timestamp(command.time)},
                            {"angles", {a[0], a[1], a[2]}}};
  out << json.dump() << '\n';
}

}  // namespace armsreach
