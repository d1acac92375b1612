#include "tools/render/mp4_file.hpp"

#include <array>
#include <string>

#include "tools/render/errors.hpp"

namespace ghtrack::render {

Mp4File::Mp4File(const std::filesystem::path& path, const AVCodecContext& codec)
    : path_(path), unit_(codec.time_base) {
  const std::string name = "file:" + path.string();
  check(avformat_alloc_output_context2(&file_, nullptr, "mp4", name.c_str()));
  try {
    file_->flags |= AVFMT_FLAG_BITEXACT;
    AVStream* const stream = avformat_new_stream(file_, nullptr);
    check(stream == nullptr ? AVERROR(ENOMEM) : 0);
    check(avcodec_parameters_from_context(stream->codecpar, &codec));
    stream->time_base = unit_;
    stream->avg_frame_rate = codec.framerate;
    check(avio_open(&file_->pb, name.c_str(), AVIO_FLAG_WRITE));
    AVDictionary* settings = nullptr;
    av_dict_set(&settings, "movflags", "+faststart", 0);
    const int written = avformat_write_header(file_, &settings);
    av_dict_free(&settings);
    check(written);
    avio_flush(file_->pb);
    check(file_->pb->error);
  } catch (...) {
    avio_closep(&file_->pb);
    avformat_free_context(file_);
    throw;
  }
}

Mp4File::~Mp4File() {
  avio_closep(&file_->pb);
  avformat_free_context(file_);
}

void Mp4File::add(const libav::Packets& packets) {
  const AVRational ticks = file_->streams[0]->time_base;
  for (const libav::Packet& packet : packets) {
    av_packet_rescale_ts(packet.get(), unit_, ticks);
    check(av_write_frame(file_, packet.get()));
  }
  check(file_->pb->error);
}

void Mp4File::close() {
  check(av_write_trailer(file_));
  check(file_->pb->error);
  check(avio_closep(&file_->pb));
}

void Mp4File::check(int result) const {
  if (result >= 0) return;
  std::array<char, AV_ERROR_MAX_STRING_SIZE> reason{};
  av_strerror(result, reason.data(), reason.size());
  throw OutputError("cannot write '" + path_.string() + "': " + reason.data());
}

}  // namespace ghtrack::render
