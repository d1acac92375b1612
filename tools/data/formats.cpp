#include "tools/data/formats.hpp"

#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <pugixml.hpp>

#include "tools/data/clock.hpp"
#include "tools/record/errors.hpp"
#include "tools/record/text_file.hpp"
#include "tools/record/text_input.hpp"

namespace ghtrack {
namespace {

constexpr std::string_view kHeader = "time,lat,lon,track_id\n";

std::string ending_of(const std::string& path) {
  return std::filesystem::path(path).extension().string();
}

/// A GPX file: the points of track after track.
std::string gpx_as_csv(const std::string& path) {
  const std::string text = read_text_file(path);
  pugi::xml_document document;
  const pugi::xml_parse_result parsed = document.load_buffer(text.data(), text.size());
  if (!parsed) {
    throw InputError(fmt::format("{}: error: no XML: {} at byte {}", path, parsed.description(),
                                 parsed.offset));
  }
  std::string csv(kHeader);
  int number = 0;
  for (const pugi::xml_node track : document.child("gpx").children("trk")) {
    ++number;
    for (const pugi::xml_node segment : track.children("trkseg")) {
      for (const pugi::xml_node point : segment.children("trkpt")) {
        csv += fmt::format("{},{},{},{}\n", point.child_value("time"),
                           point.attribute("lat").value(), point.attribute("lon").value(), number);
      }
    }
  }
  if (csv.size() == kHeader.size()) {
    throw InputError(path + ": error: there are no trkpt in it, the points of tracks of GPX");
  }
  return csv;
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

void append_point(std::string& csv, const nlohmann::json& time, const nlohmann::json& place,
                  const std::string& id) {
  csv += fmt::format("{},{},{},{}\n", cell(time), cell(place.at(1)), cell(place.at(0)), id);
}

void append_feature(std::string& csv, const nlohmann::json& feature, int number) {
  const nlohmann::json& geometry = feature.at("geometry");
  const nlohmann::json properties = feature.value("properties", nlohmann::json::object());
  std::string id = std::to_string(number);
  for (const char* name : {"track_id", "id", "name"}) {
    if (properties.is_object() && properties.contains(name)) {
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
  if (kind != "LineString") return;
  const nlohmann::json times = times_of(properties);
  const nlohmann::json& places = geometry.at("coordinates");
  if (!times.is_array() || times.size() != places.size()) {
    throw InputError("a LineString has no property times with as many values as coordinates");
  }
  for (std::size_t i = 0; i < places.size(); ++i) append_point(csv, times[i], places[i], id);
}

std::string geojson_as_csv(const std::string& path) {
  try {
    const nlohmann::json json = nlohmann::json::parse(read_text_file(path));
    std::string csv(kHeader);
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

/// Whether a file's first line is a message of BaseStation: `MSG,3,1,1,4CA2D6,…`.
bool is_base_station_file(const std::string& path) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return false;
  std::ifstream file(path, std::ios::binary);
  std::array<char, 4> start{};
  file.read(start.data(), start.size());
  const std::string_view read(start.data(), static_cast<std::size_t>(file.gcount()));
  return read == "MSG," || read == "SEL," || read == "AIR," || read == "STA,";
}

/// Messages of BaseStation (SBS-1), 22 fields between commas: those that have a position, when they
/// were made, and the address of the aircraft.
std::string base_station_as_csv(const std::string& path) {
  constexpr std::size_t kFields = 22, kAddress = 4, kDate = 6, kTime = 7, kLatitude = 14,
                        kLongitude = 15;
  TextInput lines(path);
  Findings findings(path);
  std::string csv(kHeader);
  std::vector<std::string_view> fields;
  std::vector<std::string> owned;
  for (auto line = lines.next(); line && !findings.enough(); line = lines.next()) {
    if (!line->starts_with("MSG,")) continue;
    split_fields(*line, fields, owned);
    if (fields.size() != kFields) {
      findings.add(lines.line_number(), fmt::format("{} fields; a message of BaseStation has {}",
                                                    fields.size(), kFields));
      continue;
    }
    if (fields[kLatitude].empty() || fields[kLongitude].empty()) continue;
    csv += fmt::format("{} {},{},{},{}\n", fields[kDate], fields[kTime], fields[kLatitude],
                       fields[kLongitude], fields[kAddress]);
  }
  findings.throw_if_any();
  if (csv.size() == kHeader.size()) {
    throw InputError(path + ": error: none of the messages of BaseStation has a position");
  }
  return csv;
}

}  // namespace

std::optional<std::string> points_as_csv(const std::string& path) {
  const std::string ending = ending_of(path);
  if (ending == ".gpx") return gpx_as_csv(path);
  if (ending == ".geojson" || ending == ".json") return geojson_as_csv(path);
  if (is_base_station_file(path)) return base_station_as_csv(path);
  return std::nullopt;
}

bool is_geographic_file(const std::string& path) {
  const std::string ending = ending_of(path);
  return ending == ".gpx" || ending == ".geojson";
}

std::string as_geographic_file(const std::string& path, const std::vector<GeoTrack>& tracks) {
  if (ending_of(path) == ".gpx") {
    std::string text =
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<gpx version=\"1.1\" creator=\"ghtrack\" "
        "xmlns=\"http://www.topografix.com/GPX/1/1\">\n";
    for (const GeoTrack& track : tracks) {
      text += fmt::format("<trk><name>{}</name><trkseg>\n", track.id);
      for (const GeographicPoint& point : track.points) {
        text += fmt::format("<trkpt lat=\"{}\" lon=\"{}\"><time>{}</time></trkpt>\n",
                            point.place.latitude, point.place.longitude,
                            format_date_time(point.time));
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
