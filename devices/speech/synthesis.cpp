#include "devices/speech/synthesis.hpp"

#include <memory>
#include <mutex>

extern "C" {
#include <flite/flite.h>
cst_voice* register_cmu_us_kal16(const char* folder);  // no header declares it
}

namespace armsreach {
namespace {

constexpr std::size_t kLongestText = 200;  // characters, some 15 s

// Flite expands digits and punctuation but knows English letters only.
std::string speakable(const std::string& text) {
  std::string plain = text.substr(0, kLongestText);
  for (char& c : plain) {
    if (c < ' ' || c > '~') c = ' ';
  }
  return plain;
}

}  // namespace

Sound synthesised(const std::string& text) {
  static std::mutex mutex;  // Flite keeps its voices in variables of its own
  const std::lock_guard lock(mutex);
  static cst_voice* const voice = [] {
    flite_init();
    return register_cmu_us_kal16(nullptr);
  }();
  const std::unique_ptr<cst_wave, decltype(&delete_wave)> wave(
      flite_text_to_wave(speakable(text).c_str(), voice), &delete_wave);
  if (!wave || wave->num_samples <= 0) return {};
  return {wave->sample_rate, {wave->samples, wave->samples + wave->num_samples}};
}

}  // namespace armsreach
