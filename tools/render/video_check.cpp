// Reads a video back by libavformat, which loads in a tenth of the time that OpenCV's reader takes.

#include <memory>
#include <string>

#include "tools/render/encoder.hpp"
#include "tools/render/libav.hpp"
#include "tools/render/output_path.hpp"

namespace ghtrack::render {

namespace fs = std::filesystem;

namespace {

struct Closing {
  void operator()(AVFormatContext* file) const { avformat_close_input(&file); }
};

/// The images that can be decoded of packets that begin with a key frame.
std::size_t decoded(const AVCodecParameters& parameters, const libav::Packets& packets) {
  const AVCodec* const codec = avcodec_find_decoder(parameters.codec_id);
  const libav::Codec decoder(avcodec_alloc_context3(codec));
  if (!decoder || avcodec_parameters_to_context(decoder.get(), &parameters) < 0) return 0;
  decoder->thread_count = 1;
  decoder->skip_loop_filter = AVDISCARD_ALL;  // nobody looks at them
  if (avcodec_open2(decoder.get(), codec, nullptr) < 0) return 0;
  const libav::Frame frame(av_frame_alloc());
  std::size_t count = 0;
  const auto take = [&] {
    while (avcodec_receive_frame(decoder.get(), frame.get()) == 0) ++count;
  };
  for (const libav::Packet& packet : packets) {
    if (avcodec_send_packet(decoder.get(), packet.get()) < 0) return 0;
    take();
  }
  avcodec_send_packet(decoder.get(), nullptr);
  take();
  return count;
}

/// How many images a video holds, as far as its last ones can be decoded; 0: they cannot.
std::size_t readable_images(const fs::path& path) {
  av_log_set_level(AV_LOG_QUIET);
  AVFormatContext* opened = nullptr;
  const std::string name = "file:" + path.string();
  if (avformat_open_input(&opened, name.c_str(), nullptr, nullptr) < 0) return 0;
  const std::unique_ptr<AVFormatContext, Closing> file(opened);
  const int stream = av_find_best_stream(file.get(), AVMEDIA_TYPE_VIDEO, -1, -1, nullptr, 0);
  if (stream < 0) return 0;
  std::size_t count = 0;
  libav::Packets last;  // from the last key frame on
  for (;;) {
    libav::Packet packet(av_packet_alloc());
    if (av_read_frame(file.get(), packet.get()) < 0) break;
    if (packet->stream_index != stream) continue;
    ++count;
    if ((packet->flags & AV_PKT_FLAG_KEY) != 0) last.clear();
    last.push_back(std::move(packet));
  }
  return decoded(*file->streams[stream]->codecpar, last) == last.size() ? count : 0;
}

}  // namespace

void verify_video(const fs::path& file, std::size_t frames) {
  const std::size_t found = readable_images(file);
  if (found == frames) return;
  const std::string_view reason = space_problem(file.parent_path());
  throw OutputError("cannot write '" + file.string() + "': " +
                    (reason.empty() ? "of " + std::to_string(frames) + " frames only " +
                                          std::to_string(found) + " can be read back"
                                    : std::string(reason)));
}

}  // namespace ghtrack::render
