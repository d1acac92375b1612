#include "tools/run/series_file.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <utility>
#include <variant>

#include "tools/data/series_reader.hpp"
#include "tools/record/errors.hpp"

namespace ghtrack {
namespace {

constexpr double kMissed = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kMostRows = 1'000'000;  // as many as a series can be asked to generate

/// What was read, and what was left out of it.
std::vector<std::string> remarks_of(SeriesReader& reader) {
  std::vector<std::string> remarks = {reader.understood()};
  for (const std::string& warning : reader.take_warnings()) remarks.push_back(warning);
  if (reader.left_out() > 0) {
    remarks.push_back(fmt::format("warning: left out {} bad rows", reader.left_out()));
    remarks.insert(remarks.end(), reader.remarks().begin(), reader.remarks().end());
  }
  return remarks;
}

}  // namespace

std::vector<std::string> read_measurements(SeriesScene& scene, const std::filesystem::path& folder,
                                           const std::function<void()>& pause) {
  auto* const given = std::get_if<GivenSeries>(&scene.data);
  if (given == nullptr || given->file.empty()) return {};
  const bool is_stream = given->file == "-";
  const std::string path = is_stream ? given->file : (folder / given->file).string();
  SeriesReader reader(path, {.columns = given->columns,
                             .frame_rate = given->frame_rate,
                             .skip_bad_rows = given->skip_bad_rows,
                             .pause = pause});
  if (reader.axes() > 1) {
    throw InputError(
        fmt::format("{}: error: a series has one value a row, and this table has {}; columns: "
                    "z=NAME says which",
                    path, reader.axes()));
  }
  if (const auto step = reader.typical_step()) scene.dt = *step;
  bool knows_truth = true;
  while (const auto row = reader.next()) {
    if (given->measurements.size() == kMostRows) {
      throw InputError(
          fmt::format("{}: error: more than {} rows are too many for a scene; `ghtrack "
                      "filter` takes any number",
                      path, kMostRows));
    }
    given->measurements.push_back(row->z ? (*row->z)[0] : kMissed);
    if (row->time) given->times.push_back(*row->time);
    knows_truth = knows_truth && row->truth.has_value();
    if (knows_truth) given->truth.push_back((*row->truth)[0]);
  }
  if (!knows_truth) given->truth.clear();
  return remarks_of(reader);
}

SeriesScene with_own_measurements(SeriesScene scene) {
  auto* const given = std::get_if<GivenSeries>(&scene.data);
  if (given == nullptr || given->file.empty()) return scene;
  GivenSeries own;
  const double first = scene.initial_guess == GuessAt::kStepBefore ? 1.0 : 0.0;
  for (std::size_t i = 0; i < given->measurements.size(); ++i) {
    if (std::isnan(given->measurements[i])) continue;
    own.measurements.push_back(given->measurements[i]);
    if (!given->truth.empty()) own.truth.push_back(given->truth[i]);
    own.times.push_back(given->times.empty() ? scene.dt * (first + static_cast<double>(i))
                                             : given->times[i]);
  }
  const bool is_whole = own.measurements.size() == given->measurements.size();
  if (given->times.empty() && is_whole) own.times.clear();
  *given = std::move(own);
  return scene;
}

}  // namespace ghtrack
