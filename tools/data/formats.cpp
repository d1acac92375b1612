#include "tools/data/formats.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <pugixml.hpp>
#include <utility>

#include "tools/data/clock.hpp"
#include "tools/data/nmea.hpp"
#include "tools/record/errors.hpp"
#include "tools/record/output_name.hpp"
#include "tools/record/text_file.hpp"
#include "tools/record/text_input.hpp"

namespace ghtrack {
namespace {

constexpr std::string_view kHeader = "time,lat,lon,track_id\n";

/// Rows of a table that was another format, each in the line in which it was found there where that
/// can be, so that messages name it.
class Rows {
 public:
  void add(std::size_t line, const std::string& row) {
    for (; line_ < line; ++line_) text_ += '\n';
    text_ += row;
    line_ += 1;
    is_empty_ = false;
  }
  bool is_empty() const { return is_empty_; }
  std::string take() { return std::move(text_); }

 private:
  std::string text_ = std::string(kHeader);
  std::size_t line_ = 1;  // the next one; the header is not counted
  bool is_empty_ = true;
};

/// The name of an element without the prefix of its namespace.
std::string_view local_name(const pugi::xml_node& node) {
  const std::string_view name = node.name();
  const std::size_t colon = name.find(':');
  return colon == std::string_view::npos ? name : name.substr(colon + 1);
}

template <class Visit>
void for_each_child(const pugi::xml_node& parent, std::string_view name, const Visit& visit) {
  for (const pugi::xml_node child : parent.children()) {
    if (local_name(child) == name) visit(child);
  }
}

/// A GPX file: the points of track after track.
std::string gpx_as_csv(const std::string& path) {
  const std::string text = read_text_file(path);
  pugi::xml_document document;
  const pugi::xml_parse_result parsed = document.load_buffer(text.data(), text.size());
  if (!parsed) {
    throw InputError(
        fmt::format("{}: error: no XML: {} at byte {}", path, parsed.description(), parsed.offset));
  }
  Rows rows;
  int number = 0;
  std::size_t line = 1;
  std::ptrdiff_t counted = 0;  // bytes whose lines are
  const auto add = [&](const pugi::xml_node& point) {
    const std::ptrdiff_t at = point.offset_debug();
    line += static_cast<std::size_t>(
        std::count(text.begin() + counted, text.begin() + std::max(counted, at), '\n'));
    counted = std::max(counted, at);
    std::string_view time;
    for_each_child(point, "time", [&](const pugi::xml_node& node) { time = node.child_value(); });
    rows.add(line, fmt::format("{},{},{},{}\n", time, point.attribute("lat").value(),
                               point.attribute("lon").value(), number));
  };
  for_each_child(document, "gpx", [&](const pugi::xml_node& gpx) {
    for_each_child(gpx, "trk", [&](const pugi::xml_node& track) {
      ++number;
      for_each_child(track, "trkseg",
                     [&](const pugi::xml_node& segment) { for_each_child(segment, "trkpt", add); });
    });
  });
  if (rows.is_empty()) {
    throw InputError(path + ": error: there are no trkpt in it, the points of tracks of GPX");
  }
  return rows.take();
}

/// The times of a feature: the property `times` (or coordTimes), one per coordinate.
nlohmann::json times_of(const nlohmann::json& properties) {
  for (const char* name : {"times", "coordTimes", "coordinateProperties"}) {
    const auto found = properties.find(name);
    if (found == properties.end()) continue;
    if (found->is_array()) return *found;
    if (found->is_object() && found->contains("times")) return (*found)["times"];
  }
  return nullptr;
}

std::string cell(const nlohmann::json& value) {
  return value.is_string() ? value.get<std::string>() : value.dump();
}

/// As a cell that may hold separators and quotes.
std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) result += c == '"' ? "\"\"" : std::string(1, c == '\n' ? ' ' : c);
  return result + '"';
}

void append_point(std::string& csv, const nlohmann::json& time, const nlohmann::json& place,
                  const std::string& id) {
  csv += fmt::format("{},{},{},{}\n", cell(time), cell(place.at(1)), cell(place.at(0)), quoted(id));
}

/// The values of an array of arrays, one after the other; of a plain one, itself.
nlohmann::json joined(const nlohmann::json& parts) {
  nlohmann::json all = nlohmann::json::array();
  for (const nlohmann::json& part : parts) {
    if (!part.is_array()) return parts;
    all.insert(all.end(), part.begin(), part.end());
  }
  return all;
}

void append_feature(std::string& csv, const nlohmann::json& feature, int number) {
  const nlohmann::json& geometry = feature.at("geometry");
  if (geometry.is_null()) return;  // a feature without a place
  const auto said = feature.find("properties");
  const nlohmann::json properties =
      said != feature.end() && said->is_object() ? *said : nlohmann::json::object();
  std::string id = std::to_string(number);
  for (const char* name : {"track_id", "id", "name"}) {
    if (properties.contains(name)) {
      id = cell(properties.at(name));
      break;
    }
  }
  const std::string kind = geometry.at("type");
  if (kind == "Point") {
    for (const char* name : {"time", "timestamp", "t", "datetime"}) {
      if (!properties.contains(name)) continue;
      return append_point(csv, properties.at(name), geometry.at("coordinates"), id);
    }
    throw InputError("a point has no property time");
  }
  if (kind != "LineString" && kind != "MultiLineString") return;
  nlohmann::json times = times_of(properties);
  nlohmann::json places = geometry.at("coordinates");
  if (kind == "MultiLineString") {
    places = joined(places);
    times = joined(times);
  }
  if (!times.is_array() || times.size() != places.size()) {
    throw InputError("a " + kind + " has no property times with as many values as coordinates");
  }
  for (std::size_t i = 0; i < places.size(); ++i) append_point(csv, times[i], places[i], id);
}

std::string geojson_as_csv(const std::string& path) {
  try {
    const nlohmann::json json = nlohmann::json::parse(read_text_file(path));
    std::string csv(kHeader);
    if (!json.is_object() || !(json.contains("features") || json.value("type", "") == "Feature")) {
      throw InputError(path +
                       ": error: no GeoJSON: neither a Feature nor a FeatureCollection; other JSON "
                       "is to be converted to CSV");
    }
    if (json.value("type", "") == "Feature") {
      append_feature(csv, json, 1);
    } else {
      int number = 0;
      for (const nlohmann::json& feature : json.at("features")) {
        append_feature(csv, feature, ++number);
      }
    }
    return csv;
  } catch (const nlohmann::json::exception& error) {
    throw InputError(fmt::format("{}: error: no GeoJSON: {}", path, error.what()));
  } catch (const InputError& error) {
    const std::string what = error.what();
    throw InputError(what.starts_with(path) ? what : path + ": error: " + what);
  }
}

/// The first characters of a file; empty if there is none.
std::string start_of(const std::string& path) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return {};
  std::ifstream file(path, std::ios::binary);
  std::array<char, 8> start{};
  file.read(start.data(), start.size());
  return {start.data(), static_cast<std::size_t>(file.gcount())};
}

/// Whether a file's first line is a message of BaseStation: `MSG,3,1,1,4CA2D6,…`.
bool is_base_station(std::string_view start) {
  return start.starts_with("MSG,") || start.starts_with("SEL,") || start.starts_with("AIR,") ||
         start.starts_with("STA,");
}

/// Messages of BaseStation (SBS-1), 22 fields between commas: those that have a position, when they
/// were made, and the address of the aircraft.
std::string base_station_as_csv(const std::string& path) {
  constexpr std::size_t kFields = 22, kAddress = 4, kDate = 6, kTime = 7, kLatitude = 14,
                        kLongitude = 15;
  TextInput lines(path);
  Rows rows;
  std::vector<std::string_view> fields;
  std::vector<std::string> owned;
  for (auto line = lines.next(); line; line = lines.next()) {
    if (!line->starts_with("MSG,")) continue;
    const auto number = static_cast<std::size_t>(lines.line_number());
    split_fields(*line, fields, owned);
    if (fields.size() != kFields) {  // a row that is none, for the reader of tables to say so
      rows.add(number, fmt::format("a message with {} of {} fields,,,\n", fields.size(), kFields));
    } else if (!fields[kLatitude].empty() && !fields[kLongitude].empty()) {
      rows.add(number, fmt::format("{} {},{},{},{}\n", fields[kDate], fields[kTime],
                                   fields[kLatitude], fields[kLongitude], fields[kAddress]));
    }
  }
  if (rows.is_empty()) {
    throw InputError(path + ": error: none of the messages of BaseStation has a position");
  }
  return rows.take();
}

/// Sentences of NMEA 0183: those of one kind, RMC if there are any since they have the date, else
/// GGA or GLL. A sentence of a receiver that does not know its place is a row without one.
std::string nmea_as_csv(const std::string& path) {
  std::array<Rows, 3> rows;
  constexpr std::array<std::string_view, 3> kKinds = {"RMC", "GGA", "GLL"};
  std::array<bool, 3> has_places{};
  TextInput lines(path);
  for (auto line = lines.next(); line; line = lines.next()) {
    const auto fix = parse_nmea(*line);
    if (!fix) continue;
    const auto kind = static_cast<std::size_t>(std::find(kKinds.begin(), kKinds.end(), fix->kind) -
                                               kKinds.begin());
    std::string place = ",";
    if (fix->place) place = fmt::format("{},{}", fix->place->latitude, fix->place->longitude);
    has_places[kind] = has_places[kind] || fix->place;
    rows[kind].add(static_cast<std::size_t>(lines.line_number()),
                   fmt::format("{},{},1\n", fix->fault.value_or(fix->time), place));
  }
  const auto found = std::find(has_places.begin(), has_places.end(), true);
  if (found != has_places.end()) {
    return rows[static_cast<std::size_t>(found - has_places.begin())].take();
  }
  throw InputError(
      path +
      ": error: none of the sentences RMC, GGA and GLL of NMEA 0183 has a place; those "
      "of AIS (!AIVDM) are for gpsdecode of gpsd to turn into JSON");
}

}  // namespace

std::optional<std::string> points_as_csv(const std::string& path) {
  const std::string ending = lower_extension(path);
  if (ending == ".gpx") return gpx_as_csv(path);
  if (ending == ".geojson" || ending == ".json") return geojson_as_csv(path);
  const std::string start = start_of(path);
  if (is_base_station(start)) return base_station_as_csv(path);
  if (is_nmea(start)) return nmea_as_csv(path);
  return std::nullopt;
}

bool is_geographic_file(const std::string& path) {
  const std::string ending = lower_extension(path);
  return ending == ".gpx" || ending == ".geojson";
}

std::string as_geographic_file(const std::string& path, const std::vector<GeoTrack>& tracks) {
  if (lower_extension(path) == ".gpx") {
    std::string text =
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<gpx version=\"1.1\" creator=\"ghtrack\" "
        "xmlns=\"http://www.topografix.com/GPX/1/1\">\n";
    for (const GeoTrack& track : tracks) {
      text += fmt::format("<trk><name>{}</name><trkseg>\n", track.id);
      for (const GeographicPoint& point : track.points) {
        text +=
            fmt::format("<trkpt lat=\"{}\" lon=\"{}\"><time>{}</time></trkpt>\n",
                        point.place.latitude, point.place.longitude, format_date_time(point.time));
      }
      text += "</trkseg></trk>\n";
    }
    return text + "</gpx>\n";
  }
  nlohmann::ordered_json json = {{"type", "FeatureCollection"},
                                 {"features", nlohmann::ordered_json::array()}};
  for (const GeoTrack& track : tracks) {
    nlohmann::ordered_json places = nlohmann::ordered_json::array();
    nlohmann::ordered_json times = nlohmann::ordered_json::array();
    for (const GeographicPoint& point : track.points) {
      places.push_back({point.place.longitude, point.place.latitude});
      times.push_back(point.time);
    }
    json["features"].push_back(
        {{"type", "Feature"},
         {"properties", {{"track_id", track.id}, {"times", std::move(times)}}},
         {"geometry", {{"type", "LineString"}, {"coordinates", std::move(places)}}}});
  }
  return json.dump() + "\n";
}

}  // namespace ghtrack
