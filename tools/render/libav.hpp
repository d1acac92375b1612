#pragma once

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libswscale/swscale.h>
}

#include <memory>
#include <vector>

namespace ghtrack::render::libav {

/// How what libav hands out is given back.
struct Freeing {
  void operator()(AVCodecContext* codec) const { avcodec_free_context(&codec); }
  void operator()(AVPacket* packet) const { av_packet_free(&packet); }
  void operator()(AVFrame* frame) const { av_frame_free(&frame); }
  void operator()(SwsContext* scaler) const { sws_freeContext(scaler); }
};

using Codec = std::unique_ptr<AVCodecContext, Freeing>;
using Packet = std::unique_ptr<AVPacket, Freeing>;
using Frame = std::unique_ptr<AVFrame, Freeing>;
using Scaler = std::unique_ptr<SwsContext, Freeing>;

/// Encoded images in the order of decoding.
using Packets = std::vector<Packet>;

}  // namespace ghtrack::render::libav
