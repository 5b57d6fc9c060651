#include "devices/speech/loudspeaker.hpp"

#include <algorithm>
#include <alsa/asoundlib.h>
#include <chrono>
#include <memory>
#include <mutex>
#include <thread>

namespace armsreach {
namespace {

constexpr unsigned kLatency = 300'000;  // us of sound in the device's buffer
constexpr int kChunk = 50;              // chunks a second
constexpr int kNap = 10;                // ms between looks at a busy device
constexpr int kPatience = 1000;         // ms that a device may take no sound before it has failed

using Pcm = std::unique_ptr<snd_pcm_t, decltype(&snd_pcm_close)>;

// ALSA would print its complaints over the program's own words.
void say_nothing(const char*, int, const char*, int, const char*, ...) {}

Error failure(const std::string& device, const std::string& what, int code) {
  return {what + ": " + snd_strerror(code), "sound device '" + device + "'",
          "connect a loudspeaker or start the sound server; or speech: {voice: off} or {voice: "
          "FILE.wav} in the configuration",
          Error::Kind::device};
}

Result<Pcm> open(const std::string& device, int rate) {
  static std::once_flag once;
  std::call_once(once, [] { snd_lib_error_set_handler(say_nothing); });
  snd_pcm_t* raw = nullptr;
  int code = snd_pcm_open(&raw, device.c_str(), SND_PCM_STREAM_PLAYBACK, SND_PCM_NONBLOCK);
  if (code < 0) return failure(device, "cannot be opened", code);
  Pcm pcm(raw, &snd_pcm_close);
  code = snd_pcm_set_params(raw, SND_PCM_FORMAT_S16, SND_PCM_ACCESS_RW_INTERLEAVED, 1,
                            static_cast<unsigned>(rate), 1, kLatency);
  if (code < 0) return failure(device, "takes no 16-bit sound", code);
  return pcm;
}

// One chunk at most; how many samples were taken, 0 while the device is busy, or ALSA's error.
snd_pcm_sframes_t write_chunk(snd_pcm_t* pcm, const Sound& sound, std::size_t from) {
  const std::size_t chunk =
      std::min(sound.samples.size() - from, static_cast<std::size_t>(sound.rate / kChunk));
  const snd_pcm_sframes_t taken = snd_pcm_writei(pcm, sound.samples.data() + from, chunk);
  if (taken == -EAGAIN) {
    // PulseAudio's buffer can be full before it would start by itself.
    if (snd_pcm_state(pcm) == SND_PCM_STATE_PREPARED) snd_pcm_start(pcm);
    return 0;
  }
  // Late once, because the machine was busy, is not yet failure.
  if (taken == -EPIPE || taken == -ESTRPIPE)
    return snd_pcm_recover(pcm, static_cast<int>(taken), 1);
  return taken;
}

// Nonblocking devices cannot be drained: what is still in the buffer is waited for.
void wait_until_played(snd_pcm_t* pcm, int rate, const std::atomic<bool>& stop) {
  snd_pcm_start(pcm);  // a sound shorter than the buffer has not started by itself
  snd_pcm_sframes_t left = 0;
  if (snd_pcm_delay(pcm, &left) < 0) return;
  const auto until_heard = std::min<std::int64_t>(1000 * left / rate, kPatience);  // ms
  for (std::int64_t waited = 0; waited < until_heard && !stop; waited += kNap)
    std::this_thread::sleep_for(std::chrono::milliseconds(kNap));
}

}  // namespace

Status play(const std::string& device, const Sound& sound, const std::atomic<bool>& stop) {
  if (sound.samples.empty()) return ok();
  Result<Pcm> pcm = open(device, sound.rate);
  if (!pcm) return pcm.error();
  int waited = 0;  // ms since the device last took something
  for (std::size_t played = 0; played < sound.samples.size() && !stop;) {
    const snd_pcm_sframes_t taken = write_chunk(pcm->get(), sound, played);
    if (taken < 0) return failure(device, "stopped playing", static_cast<int>(taken));
    if (waited > kPatience) return failure(device, "stopped playing", -ETIMEDOUT);
    played += static_cast<std::size_t>(taken);
    waited = taken > 0 ? 0 : waited + kNap;
    // Polled, because not every plugin of ALSA wakes those who wait.
    if (taken == 0) std::this_thread::sleep_for(std::chrono::milliseconds(kNap));
  }
  wait_until_played(pcm->get(), sound.rate, stop);
  snd_pcm_drop(pcm->get());
  return ok();
}

}  // namespace armsreach
