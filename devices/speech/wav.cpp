#include "devices/speech/wav.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace armsreach {
namespace {

constexpr int kBytesPerSample = 2;

std::int64_t first_sample(const PlacedSound& placed, Timestamp origin) {
  const double seconds = seconds_from_timestamp(placed.start - origin);
  return std::max<std::int64_t>(0, std::llround(seconds * placed.sound->rate));
}

template <int kBytes>
void put(std::ostream& out, std::uint32_t value) {
  std::array<char, kBytes> bytes{};
  for (int i = 0; i < kBytes; ++i) bytes[i] = static_cast<char>((value >> (8 * i)) & 0xFF);
  out.write(bytes.data(), kBytes);
}

void put_header(std::ostream& out, int rate, std::int64_t samples) {
  const auto data_size = static_cast<std::uint32_t>(samples * kBytesPerSample);
  out << "RIFF";
  put<4>(out, 36 + data_size);
  out << "WAVEfmt ";
  put<4>(out, 16);  // size of the format that follows
  put<2>(out, 1);   // PCM
  put<2>(out, 1);   // channels
  put<4>(out, static_cast<std::uint32_t>(rate));
  put<4>(out, static_cast<std::uint32_t>(rate * kBytesPerSample));
  put<2>(out, kBytesPerSample);
  put<2>(out, 8 * kBytesPerSample);
  out << "data";
  put<4>(out, data_size);
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
    for (; written < first_sample(placed, origin); ++written) put<2>(out, 0);
    for (const std::int16_t sample : placed.sound->samples) {
      put<2>(out, static_cast<std::uint16_t>(sample));
      ++written;
    }
  }
}

}  // namespace armsreach
