#pragma once

#include <memory>

#include "tools/render/footage.hpp"

namespace ghtrack::render {

/// Draws over a background, encodes and verifies; see FootageWriter.
std::unique_ptr<FootageSink> open_footage_file(const FootageOptions& options);

}  // namespace ghtrack::render
