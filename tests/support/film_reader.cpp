#include "tests/support/film_reader.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
}

namespace armsreach::test {
namespace {

struct Close {
  void operator()(AVFormatContext* file) const { avformat_close_input(&file); }
  void operator()(AVPacket* packet) const { av_packet_free(&packet); }
  void operator()(AVFrame* frame) const { av_frame_free(&frame); }
  void operator()(AVCodecContext* codec) const { avcodec_free_context(&codec); }
};
using File = std::unique_ptr<AVFormatContext, Close>;

void need(int code) {
  if (code < 0) throw std::runtime_error("libav: error " + std::to_string(code));
}

File open(const std::filesystem::path& film) {
  AVFormatContext* raw = nullptr;
  need(avformat_open_input(&raw, film.c_str(), nullptr, nullptr));
  File file(raw);
  need(avformat_find_stream_info(raw, nullptr));
  return file;
}

int stream_of(const File& file, AVMediaType type) {
  return av_find_best_stream(file.get(), type, -1, -1, nullptr, 0);
}

double seconds(AVRational base) { return static_cast<double>(base.num) / base.den; }

void decode(AVCodecContext* decoder, const AVPacket* packet, double time_base, FilmSound* sound) {
  need(avcodec_send_packet(decoder, packet));
  const std::unique_ptr<AVFrame, Close> frame(av_frame_alloc());
  while (avcodec_receive_frame(decoder, frame.get()) >= 0) {
    const double start = static_cast<double>(frame->pts) * time_base;
    const std::int64_t first = std::llround(start * sound->rate);
    const auto* plane = reinterpret_cast<const float*>(frame->data[0]);
    const auto end = static_cast<std::size_t>(std::max<std::int64_t>(first + frame->nb_samples, 0));
    if (sound->samples.size() < end) sound->samples.resize(end);
    for (int i = 0; i < frame->nb_samples; ++i) {
      if (first + i >= 0) sound->samples[static_cast<std::size_t>(first + i)] = plane[i];
    }
  }
}

}  // namespace

std::vector<VideoPacket> video_packets(const std::filesystem::path& film) {
  const File file = open(film);
  const int video = stream_of(file, AVMEDIA_TYPE_VIDEO);
  std::vector<VideoPacket> packets;
  const std::unique_ptr<AVPacket, Close> packet(av_packet_alloc());
  for (; av_read_frame(file.get(), packet.get()) >= 0; av_packet_unref(packet.get())) {
    if (packet->stream_index != video) continue;
    packets.push_back({packet->pts, packet->dts, seconds(file->streams[video]->time_base),
                       std::string(packet->data, packet->data + packet->size)});
  }
  return packets;
}

FilmSound film_sound(const std::filesystem::path& film) {
  const File file = open(film);
  FilmSound sound;
  for (unsigned i = 0; i < file->nb_streams; ++i) {
    sound.streams += file->streams[i]->codecpar->codec_type == AVMEDIA_TYPE_AUDIO;
  }
  const int index = stream_of(file, AVMEDIA_TYPE_AUDIO);
  if (index < 0) return sound;
  const AVStream* stream = file->streams[index];
  const AVCodec* codec = avcodec_find_decoder(stream->codecpar->codec_id);
  const std::unique_ptr<AVCodecContext, Close> decoder(avcodec_alloc_context3(codec));
  need(avcodec_parameters_to_context(decoder.get(), stream->codecpar));
  decoder->pkt_timebase = stream->time_base;
  need(avcodec_open2(decoder.get(), codec, nullptr));
  sound.rate = stream->codecpar->sample_rate;
  const std::unique_ptr<AVPacket, Close> packet(av_packet_alloc());
  for (; av_read_frame(file.get(), packet.get()) >= 0; av_packet_unref(packet.get())) {
    if (packet->stream_index != index) continue;
    decode(decoder.get(), packet.get(), seconds(stream->time_base), &sound);
  }
  decode(decoder.get(), nullptr, seconds(stream->time_base), &sound);
  return sound;
}

double FilmSound::rms(double from, double to) const {
  double sum = 0;
  const auto first = static_cast<std::size_t>(std::llround(from * rate));
  const auto last = static_cast<std::size_t>(std::llround(to * rate));
  for (std::size_t i = first; i < std::min(last, samples.size()); ++i)
    sum += samples[i] * samples[i];
  return std::sqrt(sum / static_cast<double>(last - first));
}

}  // namespace armsreach::test
