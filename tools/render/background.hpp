#pragma once

#include <opencv2/core/mat.hpp>

#include <memory>

#include "tools/render/footage.hpp"

namespace ghtrack::render {

/// What tracks are drawn over, picture after picture.
class Background {
 public:
  virtual ~Background() = default;
  virtual const BackgroundInfo& info() const = 0;

  /// The next picture, 8 bit BGR; false after the last.
  virtual bool next(cv::Mat& image) = 0;
};

/// @throws RequestError if it is none
std::unique_ptr<Background> open_background(const FootageOptions& options);

}  // namespace ghtrack::render
