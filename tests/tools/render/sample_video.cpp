// Draws the synthetic scene, to be looked at: sample_video FILE [panels] [width height] [frames].

#include <cstdlib>
#include <iostream>

#include "tests/tools/render/synthetic_scene.hpp"

int main(int count, char** words) {
  using namespace ghtrack::render;
  const auto number = [&](int index, int otherwise) {
    return index < count ? std::atoi(words[index]) : otherwise;
  };
  VideoOptions options;
  options.path = count > 1 ? words[1] : "sample.mp4";
  const int panels = number(2, 1);
  options.width = number(3, options.width);
  options.height = number(4, options.height);
  try {
    SyntheticScene scene(panels);
    VideoWriter video(options, scene.drawing());
    for (int i = 0; i < number(5, 300); ++i) video.add_frame(scene.next());
    video.finish();
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
