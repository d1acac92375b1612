#include "tools/render/h264_segment.hpp"

#include <stdexcept>
#include <string>
#include <utility>

namespace ghtrack::render {

namespace {

/// x264 decides by its number of threads what it writes, so that number is fixed: the same bytes on
/// every machine. Two let it encode one image while the next is drawn.
constexpr int kThreads = 2;

[[noreturn]] void fail(const std::string& what) {
  throw OutputError("cannot encode a video: libx264 " + what);
}

libav::Codec open_codec(const VideoOptions& options) {
  av_log_set_level(AV_LOG_QUIET);
  const AVCodec* const x264 = avcodec_find_encoder_by_name("libx264");
  libav::Codec codec(avcodec_alloc_context3(x264));
  if (!codec) fail("is not there");
  codec->width = options.width;
  codec->height = options.height;
  codec->pix_fmt = AV_PIX_FMT_YUV420P;
  codec->framerate = av_d2q(options.fps, 1'000'000);
  codec->time_base = av_inv_q(codec->framerate);
  codec->gop_size = static_cast<int>(H264Segment::kImages);
  codec->thread_count = kThreads;
  codec->flags |= AV_CODEC_FLAG_GLOBAL_HEADER | AV_CODEC_FLAG_BITEXACT;
  codec->colorspace = AVCOL_SPC_BT709;
  codec->color_primaries = AVCOL_PRI_BT709;
  codec->color_trc = AVCOL_TRC_BT709;
  codec->color_range = AVCOL_RANGE_MPEG;
  AVDictionary* settings = nullptr;  // as measured: tools/bench/README.md
  av_dict_set(&settings, "preset", "veryfast", 0);
  av_dict_set(&settings, "crf", "18", 0);
  av_dict_set(&settings, "x264-params", "subme=1:me=dia:bframes=2:weightp=0", 0);
  const int opened = avcodec_open2(codec.get(), x264, &settings);
  av_dict_free(&settings);
  if (opened < 0) fail("cannot be started");
  return codec;
}

libav::Scaler open_scaler(int width, int height) {
  libav::Scaler scaler(sws_getContext(width, height, AV_PIX_FMT_BGR24, width, height,
                                      AV_PIX_FMT_YUV420P, SWS_BICUBIC, nullptr, nullptr, nullptr));
  if (!scaler) fail("gets no images");
  const int* const bt709 = sws_getCoefficients(SWS_CS_ITU709);
  constexpr int kOne = 1 << 16;
  sws_setColorspaceDetails(scaler.get(), bt709, 1, bt709, 0, 0, kOne, kOne);
  return scaler;
}

libav::Frame frame_for(const AVCodecContext& codec) {
  libav::Frame frame(av_frame_alloc());
  frame->format = codec.pix_fmt;
  frame->width = codec.width;
  frame->height = codec.height;
  if (av_frame_get_buffer(frame.get(), 0) < 0) throw std::bad_alloc();
  return frame;
}

}  // namespace

bool H264Segment::is_available() { return avcodec_find_encoder_by_name("libx264") != nullptr; }

H264Segment::H264Segment(const VideoOptions& options, std::size_t first)
    : first_(static_cast<std::int64_t>(first)),
      codec_(open_codec(options)),
      scaler_(open_scaler(options.width, options.height)),
      frame_(frame_for(*codec_)) {}

void H264Segment::add(const cv::Mat& image) {
  if (image.cols != codec_->width || image.rows != codec_->height || image.type() != CV_8UC3)
    throw std::logic_error("a video's images must be 8 bit BGR and of one size");
  if (av_frame_make_writable(frame_.get()) < 0) throw std::bad_alloc();
  const std::uint8_t* const rows[] = {image.data};
  const int strides[] = {static_cast<int>(image.step[0])};
  sws_scale(scaler_.get(), rows, strides, 0, image.rows, frame_->data, frame_->linesize);
  frame_->pts = images_++;
  send(frame_.get());
}

libav::Packets H264Segment::finish() {
  send(nullptr);
  return std::move(packets_);
}

/// @param frame  null: no more will come
void H264Segment::send(const AVFrame* frame) {
  if (avcodec_send_frame(codec_.get(), frame) < 0) fail("refuses an image");
  for (;;) {
    libav::Packet packet(av_packet_alloc());
    const int got = avcodec_receive_packet(codec_.get(), packet.get());
    if (got == AVERROR(EAGAIN) || got == AVERROR_EOF) return;
    if (got < 0) fail("loses an image");
    packet->pts += first_;
    packet->dts += first_;
    packet->duration = 1;
    packets_.push_back(std::move(packet));
  }
}

}  // namespace ghtrack::render
