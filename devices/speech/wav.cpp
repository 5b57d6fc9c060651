#include "devices/speech/wav.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "vision/core/byte_stream.hpp"

namespace armsreach {
namespace {

constexpr int kBytesPerSample = 2;

std::int64_t first_sample(const PlacedSound& placed, Timestamp origin) {
  const double seconds = seconds_from_timestamp(placed.start - origin);
  return std::max<std::int64_t>(0, std::llround(seconds * placed.sound->rate));
}

void put_header(std::ostream& out, int rate, std::int64_t samples) {
  const auto data_size = static_cast<std::uint32_t>(samples * kBytesPerSample);
  out << "RIFF";
  write_value(out, 36 + data_size);
  out << "WAVEfmt ";
  write_value(out, std::uint32_t{16});  // size of the format that follows
  write_value(out, std::uint16_t{1});   // PCM
  write_value(out, std::uint16_t{1});   // channels
  write_value(out, static_cast<std::uint32_t>(rate));
  write_value(out, static_cast<std::uint32_t>(rate * kBytesPerSample));
  write_value(out, std::uint16_t{kBytesPerSample});
  write_value(out, std::uint16_t{8 * kBytesPerSample});
  out << "data";
  write_value(out, data_size);
}

}  // namespace

void write_wav(std::ostream& out, const SoundTrack& track, Timestamp origin) {
  std::int64_t end = 0;
  for (const PlacedSound& placed : track) {
    end = std::max(end, first_sample(placed, origin) +
                            static_cast<std::int64_t>(placed.sound->samples.size()));
  }
  put_header(out, track.empty() ? Sound{}.rate : track.front().sound->rate, end);
  std::int64_t written = 0;
  for (const PlacedSound& placed : track) {
    for (; written < first_sample(placed, origin); ++written) write_value(out, std::int16_t{0});
    for (const std::int16_t sample : placed.sound->samples) {
      write_value(out, sample);
      ++written;
    }
  }
}

}  // namespace armsreach
