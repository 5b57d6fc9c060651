#include "devices/speech/loudspeaker.hpp"

#include <algorithm>
#include <alsa/asoundlib.h>
#include <chrono>
#include <memory>
#include <mutex>
#include <thread>

namespace armsreach {
namespace {

constexpr unsigned kLatency = 100'000;  // us of sound in the device's buffer
constexpr int kChunk = 50;              // chunks a second: how soon it can be stopped
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

// One chunk at most; how many samples were taken, or ALSA's error.
snd_pcm_sframes_t write_chunk(snd_pcm_t* pcm, const Sound& sound, std::size_t from) {
  const std::size_t chunk =
      std::min(sound.samples.size() - from, static_cast<std::size_t>(sound.rate / kChunk));
  snd_pcm_sframes_t taken = snd_pcm_writei(pcm, sound.samples.data() + from, chunk);
  if (taken == -EAGAIN) {
    const int ready = snd_pcm_wait(pcm, kPatience);
    return ready == 0 ? -ETIMEDOUT : std::min(ready, 0);
  }
  // Late once, because the machine was busy, is not yet failure.
  if (taken == -EPIPE || taken == -ESTRPIPE) {
    return snd_pcm_recover(pcm, static_cast<int>(taken), 1);
  }
  return taken;
}

// Nonblocking devices cannot be drained: the buffer's rest is waited for.
void wait_until_played(snd_pcm_t* pcm, const std::atomic<bool>& stop) {
  snd_pcm_start(pcm);  // a sound shorter than the buffer has not started by itself
  for (unsigned waited = 0; waited < 2 * kLatency && !stop; waited += 1'000'000U / kChunk) {
    snd_pcm_sframes_t left = 0;
    if (snd_pcm_delay(pcm, &left) < 0 || left <= 0) return;
    std::this_thread::sleep_for(std::chrono::microseconds(1'000'000U / kChunk));
  }
}

}  // namespace

Status play(const std::string& device, const Sound& sound, const std::atomic<bool>& stop) {
  if (sound.samples.empty()) return ok();
  Result<Pcm> pcm = open(device, sound.rate);
  if (!pcm) return pcm.error();
  for (std::size_t played = 0; played < sound.samples.size() && !stop;) {
    const snd_pcm_sframes_t taken = write_chunk(pcm->get(), sound, played);
    if (taken < 0) return failure(device, "stopped playing", static_cast<int>(taken));
    played += static_cast<std::size_t>(taken);
  }
  wait_until_played(pcm->get(), stop);
  snd_pcm_drop(pcm->get());
  return ok();
}

}  // namespace armsreach
