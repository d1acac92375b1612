#include "tools/render/footage.hpp"

#include <fstream>

#include "tools/render/module.hpp"
#include "tools/render/output_path.hpp"

namespace ghtrack::render {

FootageWriter::FootageWriter(const FootageOptions& options) {
  VideoOptions request;
  request.path = options.path;
  request.width = options.width;
  request.height = options.height;
  request.fps = options.fps.value_or(request.fps);
  check_request(request);
  std::error_code problem;
  const auto status = std::filesystem::status(options.background, problem);
  const bool is_there =
      std::filesystem::is_regular_file(status) || std::filesystem::is_directory(status);
  if (!options.background.empty() && !is_there) {
    throw RequestError("the background '" + options.background.string() +
                       "' is no file and no folder");
  }
  sink_ = render_module().open_footage(options);
}

}  // namespace ghtrack::render
