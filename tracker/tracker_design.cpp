#include "tracker/tracker_design.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>
#include <variant>

namespace ghtrack {
namespace {

/// The filter of detections that nobody has classified. Where nothing is said of any target, one
/// that suits steady and nimble ones.
FilterConfig default_filter(const std::map<std::string, FilterConfig>& filters) {
  if (filters.empty()) return ImmConfig{};
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

TrackerDesign::TrackerDesign(TrackerConfig config, std::vector<SensorTraits> sensors,
                             const std::vector<double>& areas)
    : config_(std::move(config)), sensors_(std::move(sensors)) {
  if (config_.association == Association::kKnown) {
    throw std::invalid_argument("a tracker cannot know which object a detection is of");
  }
  std::map<std::string, FilterConfig> by_label = config_.filters;
  by_label.try_emplace(std::string(TrackerConfig::kDefaultFilter), default_filter(config_.filters));
  const auto best = std::min_element(
      sensors_.begin(), sensors_.end(), [](const SensorTraits& a, const SensorTraits& b) {
        return a.sigma * a.sigma * a.period < b.sigma * b.sigma * b.period;
      });
  best_ = static_cast<int>(best - sensors_.begin());
  for (const SensorTraits& sensor : sensors_) {
    const std::size_t index = evidence_.size();
    evidence_.emplace_back(
        config_.existence, sensor,
        index < areas.size() ? areas[index] : std::numeric_limits<double>::infinity());
    FiltersByLabel& filters = filters_.emplace_back();
    for (const auto& [label, filter] : by_label) {
      filters.emplace(label, make_filter(filter, best->sigma, best->period));
    }
  }
}

TrackerDesign::TrackerDesign(const TrackerDesign&) = default;
TrackerDesign::TrackerDesign(TrackerDesign&&) noexcept = default;
TrackerDesign& TrackerDesign::operator=(const TrackerDesign&) = default;
TrackerDesign& TrackerDesign::operator=(TrackerDesign&&) noexcept = default;
TrackerDesign::~TrackerDesign() = default;

const Filter& TrackerDesign::filter_for(std::string_view label, int sensor) const {
  const FiltersByLabel& filters = filters_.at(static_cast<std::size_t>(sensor));
  const auto found = filters.find(label);
  return found != filters.end() ? found->second
                                : filters.find(TrackerConfig::kDefaultFilter)->second;
}

std::vector<SingleFilterConfig> filters_of(const TrackerConfig& config, const std::string& label) {
  const auto own = config.filters.find(label);
  const auto by_default = config.filters.find(std::string(TrackerConfig::kDefaultFilter));
  const FilterConfig filter = own != config.filters.end()          ? own->second
                              : by_default != config.filters.end() ? by_default->second
                                                                   : default_filter(config.filters);
  return std::visit(
      [&](const auto& chosen) {
        std::vector<SingleFilterConfig> filters;
        if constexpr (requires { bank_of(chosen); }) {
          for (const auto& [name, single] : bank_of(chosen)) filters.push_back(single);
        } else {
          filters.push_back(chosen);
        }
        return filters;
      },
      filter);
}

}  // namespace ghtrack
