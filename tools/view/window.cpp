#include "tools/view/window.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <list>
#include <opencv2/highgui.hpp>
#include <string>
#include <utility>

#include "tools/render/encoder.hpp"

namespace ghtrack::view {
namespace {

constexpr const char* kTitle = "ghtrack";
constexpr int kSteps = 1000;       // of a slider
constexpr int kSliderHeight = 26;  // [px]

constexpr std::array<std::pair<char, render::Layer>, 20> kLayerKeys{
    {{'g', render::Layer::kGrid},      {'v', render::Layer::kFieldOfView},
     {'f', render::Layer::kGround},    {'b', render::Layer::kWalls},
     {'r', render::Layer::kRails},     {'w', render::Layer::kWind},
     {'t', render::Layer::kTruth},     {'n', render::Layer::kNames},
     {'p', render::Layer::kTrails},    {'o', render::Layer::kGates},
     {'e', render::Layer::kResiduals}, {'d', render::Layer::kDetections},
     {'c', render::Layer::kClutter},   {'y', render::Layer::kTentative},
     {'k', render::Layer::kTracks},    {'s', render::Layer::kEvents},
     {'a', render::Layer::kFans},      {'l', render::Layer::kLabels},
     {'i', render::Layer::kInsets},    {'h', render::Layer::kHud}}};

/// The window and what it listens to. OpenCV calls back with a plain pointer: nothing here moves.
class Window {
 private:
  template <class Action>
  decltype(auto) visit(Action action) {
    return std::visit(action, player_);
  }

 public:
  explicit Window(Player& player) : player_(player) {
    cv::namedWindow(kTitle, cv::WINDOW_NORMAL | cv::WINDOW_KEEPRATIO | cv::WINDOW_GUI_NORMAL);
    const std::vector<Knob> knobs = visit([](auto& p) { return p.knobs(); });
    for (std::size_t i = 0; i < knobs.size(); ++i) {
      Slider& slider = sliders_.emplace_back(Slider{*this, i});
      add_slider(knobs[i].name, kSteps, static_cast<int>(std::lround(knobs[i].place() * kSteps)),
                 on_knob, &slider);
    }
    if (frames() > 1) add_slider("time", static_cast<int>(frames()) - 1, 0, on_time, this);
    const cv::Mat& image = visit([](auto& p) -> const cv::Mat& { return p.image(); });
    const int sliders = static_cast<int>(knobs.size()) + 1;
    cv::resizeWindow(kTitle, image.cols, image.rows + kSliderHeight * sliders);
    is_ready_ = true;
  }
  ~Window() { cv::destroyAllWindows(); }
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  void run() {
    for (int key = 0; key != 'q' && key != kEscape && is_open();) {
      draw();
      const double seconds = visit([](auto& p) { return p.seconds_per_frame(); });
      key = cv::waitKeyEx(std::max(1, static_cast<int>(1000.0 * seconds)));
      obey(key);
      if (is_playing_ && frame() + 1 < frames()) go_to(frame() + 1);
    }
  }

  void draw() {
    cv::imshow(kTitle, visit([](auto& p) -> const cv::Mat& { return p.image(); }));
  }

 private:
  static constexpr int kEscape = 27;
  struct Slider {
    Window& window;
    std::size_t knob;
  };

  std::size_t frames() {
    return visit([](auto& p) { return p.frames(); });
  }
  std::size_t frame() {
    return visit([](auto& p) { return p.frame(); });
  }

  static void add_slider(const std::string& name, int steps, int place,
                         cv::TrackbarCallback changed, void* who) {
    cv::createTrackbar(name, kTitle, nullptr, steps, changed, who);
    cv::setTrackbarPos(name, kTitle, place);
  }

  static void on_knob(int place, void* slider) {
    const auto& [window, knob] = *static_cast<Slider*>(slider);
    if (!window.is_ready_) return;
    window.visit([&, k = knob](auto& player) {
      player.turn(k, player.knobs()[k].value_at(static_cast<double>(place) / kSteps));
    });
    window.draw();
  }

  static void on_time(int place, void* window) {
    auto& self = *static_cast<Window*>(window);
    if (self.is_ready_ && static_cast<std::size_t>(place) != self.frame())
      self.visit([place](auto& player) { player.seek(static_cast<std::size_t>(place)); });
  }

  void go_to(std::size_t frame) {
    visit([frame](auto& player) { player.seek(frame); });
    cv::setTrackbarPos("time", kTitle, static_cast<int>(frame));
  }

  void step(int frames) {
    is_playing_ = false;
    const auto last = static_cast<std::ptrdiff_t>(this->frames()) - 1;
    const auto wanted = static_cast<std::ptrdiff_t>(frame()) + frames;
    go_to(static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(wanted, 0, last)));
  }

  void obey(int key) {
    if (key == ' ') is_playing_ = !is_playing_;
    if (key == '.') step(1);
    if (key == ',') step(-1);
    if (key == '0') step(-static_cast<int>(frames()));
    for (const auto& [letter, layer] : kLayerKeys)
      if (key == letter) visit([shown = layer](auto& player) { player.toggle(shown); });
  }

  static bool is_open() { return cv::getWindowProperty(kTitle, cv::WND_PROP_VISIBLE) >= 1.0; }

  Player& player_;
  std::list<Slider> sliders_;
  bool is_ready_ = false;  // sliders call back while they are being made
  bool is_playing_ = true;
};

}  // namespace

void show(Player& player, const std::optional<std::filesystem::path>& screenshot) {
  Window window(player);
  if (!screenshot) return window.run();
  window.draw();
  cv::waitKey(1);
  std::visit([&](const auto& p) { render::write_png(*screenshot, p.image()); }, player);
}

std::string_view explain_keys() {
  return "space  play or pause      . ,  step forwards, backwards      0  to the start      q  "
         "quit\n"
         "layers: g grid, v field of view, f ground, b walls, r rails, w wind, t truth, n names,\n"
         "        p trails, o gates, e residuals, d detections, c clutter, y tentative, k tracks,\n"
         "        s events, a fans, l labels, i insets, h hud\n";
}

}  // namespace ghtrack::view
