#include "render/film_sound.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <system_error>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
}

namespace armsreach::render {
namespace {

constexpr std::int64_t kBitRate = 64000;  // bit/s, ample for one voice
constexpr double kFullScale = 32768;

struct Free {
  void operator()(AVPacket* packet) const { av_packet_free(&packet); }
  void operator()(AVFrame* frame) const { av_frame_free(&frame); }
  void operator()(AVCodecContext* codec) const { avcodec_free_context(&codec); }
};
struct CloseInput {
  void operator()(AVFormatContext* file) const { avformat_close_input(&file); }
};
struct CloseOutput {
  void operator()(AVFormatContext* file) const {
    avio_closep(&file->pb);
    avformat_free_context(file);
  }
};

// libav's own codes: what failed, told by check().
struct Failure {
  std::string step;
  int code;
};

int check(int code, const char* step) {
  if (code < 0) throw Failure{step, code};
  return code;
}

std::string words(int code) {
  std::array<char, AV_ERROR_MAX_STRING_SIZE> text{};
  av_strerror(code, text.data(), text.size());
  return text.data();
}

// The samples of a track, asked for from the start on; silence between the sounds.
class Samples {
 public:
  explicit Samples(const SoundTrack& track) : track_(track) {}

  int rate() const { return track_.front().sound->rate; }
  std::int64_t count() const {
    const PlacedSound& last = track_.back();
    return first(last) + static_cast<std::int64_t>(last.sound->samples.size());
  }
  float at(std::int64_t index) {
    while (next_ < track_.size() && index >= end(track_[next_])) ++next_;
    if (next_ == track_.size() || index < first(track_[next_])) return 0;
    const auto offset = static_cast<std::size_t>(index - first(track_[next_]));
    return static_cast<float>(track_[next_].sound->samples[offset] / kFullScale);
  }

 private:
  static std::int64_t first(const PlacedSound& placed) {
    return std::llround(seconds_from_timestamp(placed.start) * placed.sound->rate);
  }
  static std::int64_t end(const PlacedSound& placed) {
    return first(placed) + static_cast<std::int64_t>(placed.sound->samples.size());
  }

  const SoundTrack& track_;
  std::size_t next_ = 0;
};

class SoundedFilm {
 public:
  SoundedFilm(const std::string& film, const std::string& sounded, const SoundTrack& track);
  void write();

 private:
  void copy_video_stream();
  void open_encoder();
  void encode_until(std::int64_t sample);
  void encode(const AVFrame* frame);

  std::unique_ptr<AVFormatContext, CloseInput> in_;
  std::unique_ptr<AVFormatContext, CloseOutput> out_;
  std::unique_ptr<AVCodecContext, Free> encoder_;
  std::unique_ptr<AVPacket, Free> packet_{av_packet_alloc()};
  AVStream* video_ = nullptr;  // of the silent film
  AVStream* video_out_ = nullptr;
  AVStream* sound_out_ = nullptr;
  Samples samples_;
  std::int64_t encoded_ = 0;  // samples
};

SoundedFilm::SoundedFilm(const std::string& film, const std::string& sounded,
                         const SoundTrack& track)
    : samples_(track) {
  AVFormatContext* in = nullptr;
  check(avformat_open_input(&in, film.c_str(), nullptr, nullptr), "reading the film");
  in_.reset(in);
  check(avformat_find_stream_info(in, nullptr), "reading the film");
  AVFormatContext* out = nullptr;
  check(avformat_alloc_output_context2(&out, nullptr, "mp4", sounded.c_str()), "starting an mp4");
  out_.reset(out);
  out->flags |= AVFMT_FLAG_BITEXACT;  // no version numbers, no dates
  copy_video_stream();
  open_encoder();
  check(avio_open(&out->pb, sounded.c_str(), AVIO_FLAG_WRITE), "writing beside the film");
  check(avformat_write_header(out, nullptr), "writing the header");
}

void SoundedFilm::copy_video_stream() {
  const int index = check(av_find_best_stream(in_.get(), AVMEDIA_TYPE_VIDEO, -1, -1, nullptr, 0),
                          "looking for the pictures");
  video_ = in_->streams[index];
  video_out_ = avformat_new_stream(out_.get(), nullptr);
  check(avcodec_parameters_copy(video_out_->codecpar, video_->codecpar), "copying the pictures");
  video_out_->codecpar->codec_tag = 0;
  video_out_->time_base = video_->time_base;
  video_out_->avg_frame_rate = video_->avg_frame_rate;
}

void SoundedFilm::open_encoder() {
  const AVCodec* codec = avcodec_find_encoder(AV_CODEC_ID_AAC);
  if (!codec) throw Failure{"looking for an AAC encoder", AVERROR_ENCODER_NOT_FOUND};
  encoder_.reset(avcodec_alloc_context3(codec));
  encoder_->sample_fmt = AV_SAMPLE_FMT_FLTP;
  encoder_->sample_rate = samples_.rate();
  encoder_->bit_rate = kBitRate;
  encoder_->time_base = {1, samples_.rate()};
  encoder_->thread_count = 1;
  encoder_->flags |= AV_CODEC_FLAG_GLOBAL_HEADER | AV_CODEC_FLAG_BITEXACT;
  av_channel_layout_default(&encoder_->ch_layout, 1);
  check(avcodec_open2(encoder_.get(), codec, nullptr), "opening the AAC encoder");
  sound_out_ = avformat_new_stream(out_.get(), nullptr);
  check(avcodec_parameters_from_context(sound_out_->codecpar, encoder_.get()),
        "describing the sound");
  sound_out_->time_base = encoder_->time_base;
}

// Sound and pictures alternate in the file, so that players need not seek.
void SoundedFilm::write() {
  std::int64_t end = samples_.count();
  for (;;) {
    const int code = av_read_frame(in_.get(), packet_.get());
    if (code == AVERROR_EOF) break;
    check(code, "reading the pictures");
    if (packet_->stream_index != video_->index) {
      av_packet_unref(packet_.get());
      continue;
    }
    const std::int64_t shown_until =
        av_rescale_q(packet_->pts + packet_->duration, video_->time_base, encoder_->time_base);
    end = std::max(end, shown_until);
    av_packet_rescale_ts(packet_.get(), video_->time_base, video_out_->time_base);
    packet_->stream_index = video_out_->index;
    packet_->pos = -1;
    check(av_interleaved_write_frame(out_.get(), packet_.get()), "writing the pictures");
    encode_until(shown_until);
  }
  encode_until(end);
  encode(nullptr);
  check(av_write_trailer(out_.get()), "finishing the film");
  avio_flush(out_->pb);
  check(out_->pb->error, "finishing the film");
}

void SoundedFilm::encode_until(std::int64_t sample) {
  while (encoded_ < sample) {
    const std::unique_ptr<AVFrame, Free> frame(av_frame_alloc());
    frame->format = encoder_->sample_fmt;
    frame->sample_rate = encoder_->sample_rate;
    frame->nb_samples = encoder_->frame_size;
    frame->pts = encoded_;
    check(av_channel_layout_copy(&frame->ch_layout, &encoder_->ch_layout), "encoding sound");
    check(av_frame_get_buffer(frame.get(), 0), "encoding sound");
    auto* plane = reinterpret_cast<float*>(frame->data[0]);
    for (int i = 0; i < frame->nb_samples; ++i) plane[i] = samples_.at(encoded_++);
    encode(frame.get());
  }
}

// Null: no more to come.
void SoundedFilm::encode(const AVFrame* frame) {
  check(avcodec_send_frame(encoder_.get(), frame), "encoding sound");
  const std::unique_ptr<AVPacket, Free> packet(av_packet_alloc());
  for (;;) {
    const int code = avcodec_receive_packet(encoder_.get(), packet.get());
    if (code == AVERROR(EAGAIN) || code == AVERROR_EOF) return;
    check(code, "encoding sound");
    av_packet_rescale_ts(packet.get(), encoder_->time_base, sound_out_->time_base);
    packet->stream_index = sound_out_->index;
    check(av_interleaved_write_frame(out_.get(), packet.get()), "writing the sound");
  }
}

}  // namespace

Status add_sound(const std::filesystem::path& film, const SoundTrack& track) {
  if (track.empty()) return ok();
  std::filesystem::path sounded = film;
  sounded.replace_extension(".sounded.mp4");
  std::error_code error;
  try {
    SoundedFilm(film.string(), sounded.string(), track).write();
    std::filesystem::rename(sounded, film, error);
    if (!error) return ok();
  } catch (const Failure& failure) {
    error = {};
    std::filesystem::remove(sounded, error);
    return Error{"the film got no sound track, " + failure.step + ": " + words(failure.code),
                 film.string(), "it is kept without sound; look whether the disk is full",
                 Error::Kind::device};
  }
  return Error{"the film got no sound track: " + error.message(), film.string(),
               "it is kept without sound", Error::Kind::device};
}

}  // namespace armsreach::render
