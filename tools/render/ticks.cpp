#include "tools/render/ticks.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace ghtrack::render {

double round_step(double least) {
  const double power = std::pow(10.0, std::floor(std::log10(least)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= least * (1.0 - 1e-9)) return factor * power;
  return 10.0 * power;
}

std::vector<double> round_ticks(double low, double high, int count) {
  if (!(high > low) || !std::isfinite(high - low)) return {};
  const double step = round_step((high - low) / std::max(1, count));
  const double first = std::ceil(low / step - 1e-9);
  const double last = std::floor(high / step + 1e-9);
  std::vector<double> ticks;
  for (double k = first; k <= last && ticks.size() < 1000; k += 1.0) ticks.push_back(k * step);
  return ticks;
}

std::u32string tick_label(double value, double step) {
  const int decimals = std::clamp(static_cast<int>(std::ceil(-std::log10(step) - 1e-9)), 0, 9);
  char text[64];
  const double shown = std::abs(value) < 1e-9 * step ? 0.0 : value;
  std::snprintf(text, sizeof text, "%.*f", decimals, std::abs(shown));
  std::u32string label = shown < 0.0 ? U"−" : U"";
  for (const char* c = text; *c != '\0'; ++c) label += static_cast<char32_t>(*c);
  return label;
}

}  // namespace ghtrack::render
