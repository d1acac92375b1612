#include "tracker/tracker_design.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>
#include <variant>

namespace ghtrack {
namespace {

/// The filter of detections that nobody has classified.
FilterConfig default_filter(const std::map<std::string, FilterConfig>& filters) {
  if (filters.empty()) return {};
  if (filters.size() == 1) return filters.begin()->second;
  MultipleModelConfig all;
  for (const auto& [label, config] : filters) {
    std::visit(
        [&all, &label = label](const auto& filter) {
          if constexpr (requires { filter.filters; }) {
            for (const auto& [model, single] : filter.filters) {
              all.filters.emplace(label + " " + model, single);
            }
          } else {
            all.filters.emplace(label, filter);
          }
        },
        config);
  }
  return all;
}

}  // namespace

TrackerDesign::TrackerDesign(TrackerConfig config, std::vector<SensorTraits> sensors)
    : config_(std::move(config)), sensors_(std::move(sensors)) {
  if (config_.association == Association::kKnown) {
    throw std::invalid_argument("a tracker cannot know which object a detection is of");
  }
  std::map<std::string, FilterConfig> by_label = config_.filters;
  by_label.try_emplace(std::string(TrackerConfig::kDefaultFilter), default_filter(config_.filters));
  // Gains that somebody has set are meant for the sensor that tells most in a given time.
  const auto best = std::min_element(
      sensors_.begin(), sensors_.end(), [](const SensorTraits& a, const SensorTraits& b) {
        return a.sigma * a.sigma * a.period < b.sigma * b.sigma * b.period;
      });
  for (const SensorTraits& sensor : sensors_) {
    evidence_.emplace_back(config_.existence, sensor);
    FiltersByLabel& filters = filters_.emplace_back();
    for (const auto& [label, filter] : by_label) {
      filters.emplace(label, make_filter(filter, best->sigma, best->period));
    }
  }
}

const Filter& TrackerDesign::filter_for(std::string_view label, int sensor) const {
  const FiltersByLabel& filters = filters_.at(static_cast<std::size_t>(sensor));
  const auto found = filters.find(label);
  return found != filters.end() ? found->second
                                : filters.find(TrackerConfig::kDefaultFilter)->second;
}

}  // namespace ghtrack
