#include "tools/plot/track_table.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "tools/data/fix_columns.hpp"
#include "tools/record/mot_file.hpp"

namespace ghtrack::plot {
namespace {

constexpr std::array<std::string_view, kQuantities> kColumns = {
    "vx", "vy", "rx", "ry", "sigma_x", "sigma_y", "s_x", "s_y", "existence"};

std::vector<TrackCurves> read_boxes(const std::string& path) {
  std::map<std::int64_t, TrackCurves> by_id;
  for (const MotRow& row : read_mot_file(path, MotKind::kDetections)) {
    TrackCurves& curves = by_id[row.id];
    curves.name = std::to_string(row.id);
    curves.t.push_back(row.frame);
    curves.x.push_back(row.left + row.width / 2.0);
    curves.y.push_back(row.top + row.height / 2.0);
  }
  std::vector<TrackCurves> all;
  for (auto& [id, curves] : by_id) all.push_back(std::move(curves));
  return all;
}

std::optional<std::size_t> identity_of(const Table& table) {
  for (const char* name : {"track_id", "truth_id"}) {
    if (const auto own = table.column(name)) return own;
  }
  return table.columns().find(Role::kIdentity);
}

/// Puts the rows of a curve in the order of time.
void sort_by_time(TrackCurves& curves) {
  if (std::is_sorted(curves.t.begin(), curves.t.end())) return;
  std::vector<std::size_t> order(curves.t.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return curves.t[a] < curves.t[b]; });
  const auto arrange = [&](std::vector<double>& values) {
    if (values.empty()) return;
    std::vector<double> sorted;
    for (const std::size_t i : order) sorted.push_back(values[i]);
    values = std::move(sorted);
  };
  arrange(curves.x);
  arrange(curves.y);
  for (std::vector<double>& values : curves.more) arrange(values);
  arrange(curves.t);
}

}  // namespace

std::size_t TrackCurves::nearest(double time) const {
  const auto after = std::lower_bound(t.begin(), t.end(), time);
  const auto at = static_cast<std::size_t>(after - t.begin());
  if (at == t.size()) return at - 1;
  return at > 0 && time - t[at - 1] < t[at] - time ? at - 1 : at;
}

CurveFile read_curves(const std::string& path, const ReadOptions& options,
                      std::optional<GeoPoint> origin) {
  if (options.columns.empty() && looks_like_mot_file(path)) {
    return {.curves = read_boxes(path), .boxes = true, .origin = {}};
  }
  Table table(path, options);
  FixColumns fixes(table, options, origin);
  const auto identity = identity_of(table);
  const auto status = table.column("status");
  std::array<std::optional<std::size_t>, kQuantities> columns;
  for (std::size_t i = 0; i < kQuantities; ++i) columns[i] = table.column(kColumns[i]);
  std::map<std::string, std::size_t, std::less<>> index;
  std::vector<TrackCurves> all;
  while (table.next()) {
    if (status && table.cell(*status) == "tentative") continue;
    const auto fix = fixes.read(table);
    if (!fix) continue;
    const std::string_view name = identity ? table.cell(*identity) : std::string_view{};
    const auto [at, is_new] = index.try_emplace(std::string(name), all.size());
    if (is_new) all.push_back({.name = std::string(name), .t = {}, .x = {}, .y = {}, .more = {}});
    TrackCurves& curves = all[at->second];
    curves.t.push_back(fix->time);
    curves.x.push_back(fix->position ? fix->position->x() : kNothing);
    curves.y.push_back(fix->position ? fix->position->y() : kNothing);
    for (std::size_t i = 0; i < kQuantities; ++i) {
      if (columns[i]) curves.more[i].push_back(table.number(*columns[i]).value_or(kNothing));
    }
  }
  table.throw_findings();
  for (TrackCurves& curves : all) sort_by_time(curves);
  return {.curves = std::move(all),
          .boxes = false,
          .origin = fixes.origin() ? fixes.origin() : origin_in_columns(table)};
}

}  // namespace ghtrack::plot
