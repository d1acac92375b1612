#include "tools/data/header.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <span>

#include "scenes/schema/diagnostic.hpp"
#include "tools/record/text_file.hpp"

namespace ghtrack {
namespace {

struct RoleName {
  Role role;
  std::string_view name;
};
constexpr std::array<RoleName, 19> kRoles = {{{Role::kTime, "t"},
                                              {Role::kDate, "date"},
                                              {Role::kFrame, "frame"},
                                              {Role::kX, "x"},
                                              {Role::kY, "y"},
                                              {Role::kZ, "z"},
                                              {Role::kLatitude, "lat"},
                                              {Role::kLongitude, "lon"},
                                              {Role::kPlace, "place"},
                                              {Role::kRange, "range"},
                                              {Role::kBearing, "bearing"},
                                              {Role::kCompass, "compass"},
                                              {Role::kIdentity, "id"},
                                              {Role::kSensor, "sensor"},
                                              {Role::kClass, "class"},
                                              {Role::kSigma, "sigma"},
                                              {Role::kSigmaX, "sigma_x"},
                                              {Role::kSigmaY, "sigma_y"},
                                              {Role::kStatus, "status"}}};

/// Other names of the roles, the likelier ones first.
struct Alias {
  Role role;
  std::string_view names;  // separated by blanks
};
constexpr std::array<Alias, 18> kAliases = {{
    {Role::kTime,
     "t time timestamp time_stamp datetime date_time date/time basedatetime base_date_time utc "
     "time_utc utc_time gps_time gpstime unix_time unixtime epoch posixtime time_position elapsed "
     "elapsed_time seconds_elapsed elapsed_seconds time_since_start datetime_utc tow gps_tow "
     "itow seconds sec ts zeit uhrzeit zeitpunkt zeitstempel temps heure horodatage tiempo "
     "hora tijd t_s"},
    {Role::kDate, "date day datum jour fecha dia"},
    {Role::kFrame,
     "frame frame_number frame_no frame_id frame_index frame_idx framenumber image image_id "
     "img_id slice slice_n°"},
    {Role::kX,
     "x x_pos xpos pos_x posx position_x x_position px point_x x_coord coord_x east easting "
     "utm_x utm_east x_east cx center_x centre_x x_center x_centre xc u tx local_x"},
    {Role::kY,
     "y y_pos ypos pos_y posy position_y y_position py point_y y_coord coord_y north northing "
     "utm_y utm_north y_north cy center_y centre_y y_center y_centre yc v ty local_y"},
    {Role::kZ,
     "z value measurement measured reading position pos distance range height altitude "
     "data signal x"},
    {Role::kLatitude,
     "lat latitude lat_deg latitude_deg gps_lat location_lat position_lat gps_latitude latitud "
     "latitudine breite breitengrad geographische_breite latitude_n/s lat_n/s latitude_e7 lat_e7 "
     "late7 latitude_e6 "
     "lat_e6 "
     "late6"},
    {Role::kLongitude,
     "lon long lng longitude lon_deg longitude_deg gps_lon gps_long location_long location_lon "
     "position_long gps_longitude longitud longitudine laenge länge längengrad laengengrad "
     "geographische_länge longitude_e/w lon_e/w longitude_e7 lon_e7 lng_e7 lone7 lnge7 "
     "longitude_e6 lon_e6 lng_e6 lone6 "
     "lnge6"},
    {Role::kPlace,
     "place position location coordinates coords latlng latlon lat_lng lat_lon lat_long lat/lon "
     "lat,lon geo geometry geom the_geom wkt point koordinaten"},
    {Role::kRange, "range distance dist rng slant_range ground_range rho r entfernung"},
    {Role::kBearing, "bearing azimuth azimut theta angle brg peilung"},
    {Role::kIdentity,
     "id truth_id track_id object_id target_id trackid objectid mmsi icao24 icao hex vehicle_id "
     "name"},
    {Role::kSensor, "sensor sensor_id sensor_name sensorid source radar camera station receiver"},
    {Role::kClass, "class label category class_name object_class object_type type"},
    {Role::kSigma,
     "sigma std stddev std_dev accuracy horizontal_accuracy accuracy_horizontal h_accuracy hacc "
     "uncertainty sigma_pos position_error"},
    {Role::kSigmaX, "sigma_x std_x sigma_east x_std x_sigma sx"},
    {Role::kSigmaY, "sigma_y std_y sigma_north y_std y_sigma sy"},
    {Role::kStatus, "status"},
}};

struct UnitName {
  std::string_view names;  // separated by blanks
  double scale;
  bool is_time;
};
constexpr std::array<UnitName, 20> kUnits = {{
    {"s sec secs second seconds sekunde sekunden", 1.0, true},
    {"ms msec millis millisecond milliseconds", 1e-3, true},
    {"us µs μs usec micros microsecond microseconds", 1e-6, true},
    {"ns nsec nanos nanosecond nanoseconds", 1e-9, true},
    {"min minute minutes", 60.0, true},
    {"h hr hrs hour hours", 3600.0, true},
    {"d day days", 86400.0, true},
    {"m meter meters metre metres", 1.0, false},
    {"mm millimeter millimeters millimetre millimetres", 1e-3, false},
    {"um µm μm micron microns micrometer micrometre", 1e-6, false},
    {"cm centimeter centimeters centimetre centimetres", 1e-2, false},
    {"km kilometer kilometers kilometre kilometres", 1e3, false},
    {"ft foot feet", 0.3048, false},
    {"in inch inches", 0.0254, false},
    {"yd yard yards", 0.9144, false},
    {"mi mile miles", 1609.344, false},
    {"nmi", 1852.0, false},
    {"px pixel pixels pix", 1.0, false},
    {"deg ° degree degrees", 1.0, false},
    {"rad radian radians", 1.0, false},
}};

std::string_view unquoted(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\"'";
  const auto first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

/// Calls visit(word) for the words of a list until it returns true. @returns whether one did
template <class Visit>
bool any_word(std::string_view words, Visit visit) {
  while (!words.empty()) {
    const std::size_t end = words.find(' ');
    if (visit(words.substr(0, end))) return true;
    if (end == std::string_view::npos) break;
    words.remove_prefix(end + 1);
  }
  return false;
}

std::optional<Unit> unit_named(std::string_view text) {
  const std::string name = lower(unquoted(text));
  for (const UnitName& unit : kUnits) {
    if (any_word(unit.names, [&](std::string_view word) { return word == name; })) {
      return Unit{name, unit.scale, unit.is_time};
    }
  }
  return std::nullopt;
}

/// Whether a column that is called like the unit counts time: "millis", but not "h" or "min".
bool counts_time(const Unit& unit) {
  return unit.is_time && unit.name.size() > 1 && unit.name != "min";
}

bool is_alias(std::string_view base) {
  return std::any_of(kAliases.begin(), kAliases.end(), [&](const Alias& alias) {
    return any_word(alias.names, [&](std::string_view name) { return name == base; });
  });
}

/// "Pos X " → "pos_x"
std::string words_joined(std::string_view text) {
  std::string result;
  for (const char c : lower(text)) {
    const bool joins = c == ' ' || c == '-' || c == '.' || c == '_';
    if (!joins) {
      result += c;
    } else if (!result.empty() && result.back() != '_') {
      result += '_';
    }
  }
  while (result.ends_with('_')) result.pop_back();
  return result;
}

/// "xCenter" → "x Center", "TimeUS" → "Time US"
std::string words_apart(std::string_view text) {
  const auto is_upper = [](char c) { return std::isupper(static_cast<unsigned char>(c)) != 0; };
  const auto is_lower = [](char c) { return std::islower(static_cast<unsigned char>(c)) != 0; };
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (i > 0 && is_upper(text[i]) && is_lower(text[i - 1])) result += ' ';
    result += text[i];
  }
  return result;
}

/// The words of a heading in lower case, joined by '_'.
std::string base_of(std::string_view text) {
  std::string as_written = words_joined(unquoted(text));
  return is_alias(as_written) ? as_written : words_joined(words_apart(unquoted(text)));
}

/// Splits "y(mm)", "Time [ms]", "x / m", "t in s" into name and unit.
bool split_unit(std::string_view text, Heading& heading) {
  for (const auto& [open, close] : {std::pair{'(', ')'}, std::pair{'[', ']'}}) {
    const std::size_t at = text.rfind(open);
    if (at == std::string_view::npos || text.back() != close) continue;
    const std::string_view inside = text.substr(at + 1, text.size() - at - 2);
    heading.unit = unit_named(inside);
    if (!heading.unit) heading.unread = inside;
    heading.base = base_of(text.substr(0, at));
    return true;
  }
  for (const std::string_view joint : {" in ", " / ", "/"}) {
    const std::size_t at = text.rfind(joint);
    if (at == std::string_view::npos) continue;
    heading.unit = unit_named(text.substr(at + joint.size()));
    if (!heading.unit) continue;
    heading.base = base_of(text.substr(0, at));
    return true;
  }
  return false;
}

std::optional<std::size_t> column_named(std::string_view name,
                                        const std::vector<Heading>& headings) {
  const auto find = [&](auto matches) -> std::optional<std::size_t> {
    const auto found = std::find_if(headings.begin(), headings.end(), matches);
    if (found == headings.end()) return std::nullopt;
    return static_cast<std::size_t>(found - headings.begin());
  };
  if (const auto exact = find([&](const Heading& h) { return h.text == name; })) return exact;
  const std::string base = base_of(name);
  if (const auto alike =
          find([&](const Heading& h) { return lower(h.text) == lower(name) || h.base == base; })) {
    return alike;
  }
  const auto number = parse_whole(name);
  if (number && *number >= 1 && *number <= std::ssize(headings)) {
    return static_cast<std::size_t>(*number - 1);
  }
  return std::nullopt;
}

}  // namespace

std::string_view to_string(Role role) {
  const auto found =
      std::find_if(kRoles.begin(), kRoles.end(), [&](const RoleName& r) { return r.role == role; });
  return found == kRoles.end() ? std::string_view{} : found->name;
}

Heading parse_heading(std::string_view cell) {
  const std::string_view text = unquoted(cell);
  if (const std::size_t at = text.rfind(" Run #"); at != text.npos) {  // as PASCO writes them
    Heading heading = parse_heading(text.substr(0, at));
    heading.text = text;
    heading.run = text.substr(at + 1);
    return heading;
  }
  Heading heading{.text = std::string(text), .base = base_of(text)};
  if (text.empty() || is_alias(heading.base) || split_unit(text, heading)) return heading;
  if (auto unit = unit_named(heading.base); unit && counts_time(*unit)) {
    heading.unit = std::move(unit);
    return heading;
  }
  const std::size_t joint = heading.base.rfind('_');  // time_ms, x_mm
  if (joint == std::string::npos || joint == 0) return heading;
  const std::string stem = heading.base.substr(0, joint);
  if (auto unit = unit_named(heading.base.substr(joint + 1)); unit && is_alias(stem)) {
    heading.unit = std::move(unit);
    heading.base = stem;
  }
  return heading;
}

bool is_in_radians(const Heading& heading) {
  return heading.unit && heading.unit->name.starts_with("rad");
}

Scale length_scale(const Heading& heading) {
  return heading.unit && !heading.unit->is_time ? Scale(heading.unit->scale) : Scale();
}

std::vector<ColumnChoice> parse_column_choices(std::string_view text) {
  std::vector<ColumnChoice> choices;
  while (!text.empty()) {
    const std::size_t end = text.find(',');
    const std::string_view item = unquoted(text.substr(0, end));
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    const std::size_t equals = item.find('=');
    const std::string name = lower(unquoted(item.substr(0, equals)));
    const auto role = std::find_if(kRoles.begin(), kRoles.end(),
                                   [&](const RoleName& r) { return r.name == name; });
    if (equals == std::string_view::npos || role == kRoles.end()) {
      std::vector<std::string_view> names;
      for (const RoleName& known : kRoles) names.push_back(known.name);
      throw ColumnError(
          fmt::format("--columns: {} is not NAME=COLUMN{}", in_quotes(item),
                      role == kRoles.end() ? hint(name, "names", names) : std::string()));
    }
    for (const ColumnChoice& known : choices) {
      if (known.role != role->role) continue;
      throw ColumnError(fmt::format("--columns: {} is given twice: {} and {}", in_quotes(name),
                                    in_quotes(known.column),
                                    in_quotes(unquoted(item.substr(equals + 1)))));
    }
    choices.push_back({role->role, std::string(unquoted(item.substr(equals + 1)))});
  }
  return choices;
}

namespace {

constexpr std::string_view kJoints = "_:/";

/// Whether one of the words of a heading is in a list.
bool has_word(std::string_view base, std::string_view list) {
  while (!base.empty()) {
    const std::size_t end = base.find_first_of(kJoints);
    const std::string_view word = base.substr(0, end);
    if (any_word(list, [&](std::string_view listed) { return listed == word; })) return true;
    base.remove_prefix(end == std::string_view::npos ? base.size() : end + 1);
  }
  return false;
}

/// Words before "x" that make it something else than a place that was measured.
constexpr std::string_view kOthers =
    "v vel velocity speed twist linear geschwindigkeit acc accel acceleration beschleunigung "
    "gyro gyr omega angular rotation rot orientation quaternion quat covariance force kraft "
    "mag gravity grav bias size sigma std error err residual offset delta";

/// Words that do so unless they are known to be part of a name, as the end of a tail.
constexpr std::string_view kPerhapsOthers = "a d end home max min q start w";

/// Whether words before "x" make it something else than a place; of "mass a" the letter is a name.
bool is_other(std::string_view words) {
  constexpr std::string_view kThings =
      "mass masse masa massa object body particle point ball cart car animal player";
  const std::size_t last = words.find_last_of(kJoints);
  const bool is_letter = last != std::string_view::npos && last + 2 == words.size();
  if (is_letter && has_word(words.substr(0, last), kThings)) words = words.substr(0, last);
  return has_word(words, kOthers) || has_word(words, kPerhapsOthers);
}

/// The last word of a heading, where it says what "Ort x" and "Latest: Time" are; empty where words
/// before it say that it is something else, such as a velocity.
std::string_view telling_word(std::string_view base) {
  const std::size_t last = base.find_last_of(kJoints);
  if (last == std::string_view::npos || is_other(base.substr(0, last))) return {};
  return base.substr(last + 1);
}

/// Whether a heading ends with a unit that is neither a time nor a length, as "p x (m/s²)".
bool has_other_unit(const Heading& heading) {
  return !heading.unit && (heading.text.ends_with(')') || heading.text.ends_with(']'));
}

/// The only column whose last word is one of these; of several, the only one with a unit.
std::optional<std::size_t> column_telling(std::string_view words,
                                          const std::vector<Heading>& headings) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < headings.size(); ++i) {
    const std::string_view told = telling_word(headings[i].base);
    if (told.empty() || is_alias(headings[i].base) || has_other_unit(headings[i])) continue;
    if (any_word(words, [&](std::string_view word) { return word == told; })) found.push_back(i);
  }
  if (found.size() > 1) {
    std::erase_if(found, [&](std::size_t column) { return !headings[column].unit; });
  }
  return found.size() == 1 ? std::optional(found.front()) : std::nullopt;
}

/// Without what other runs of an experiment call their columns.
std::vector<Heading> of_one_run(std::vector<Heading> headings,
                                const std::vector<std::pair<Role, std::size_t>>& chosen) {
  std::string run;
  for (const auto& [role, column] : chosen) {
    if (run.empty()) run = headings[column].run;
  }
  const bool is_chosen = !run.empty();
  for (Heading& heading : headings) {
    if (run.empty()) run = heading.run;
    if (heading.run.empty() || heading.run == run) continue;
    if (!is_chosen) {
      throw ColumnError(
          fmt::format("there are '{}' and '{}': choose one by a column of its own, "
                      "such as --columns 't={}'",
                      run, heading.run, heading.text));
    }
    heading.base.clear();
  }
  return headings;
}

}  // namespace

std::optional<Belonging> belonging_of(const Heading& heading, NamesOfObjects names) {
  // Several columns of the same thing are no several things.
  constexpr std::string_view kVersions =
      "true truth gt real actual est estimate estimated pred predicted meas measured raw smooth "
      "smoothed filt filtered target setpoint desired reference ref cmd command goal prev previous "
      "last next init initial center centre pos position east north";
  const auto is_none = [&](std::string_view object) {
    const bool is_something_else =
        names == NamesOfObjects::kAny ? has_word(object, kOthers) : is_other(object);
    return is_something_else || has_word(object, kVersions);
  };
  const std::string& base = heading.base;
  if (is_alias(base) || has_other_unit(heading)) return std::nullopt;
  const auto named = [&](std::string_view object, std::string_view quantity) {
    const std::size_t at = base.find(object);
    std::string name(std::string_view(heading.text).substr(at, object.size()));
    if (words_joined(name) != object) name = object;  // as it is written if it can be told
    return std::optional<Belonging>({std::move(name), std::string(quantity)});
  };
  const std::size_t last = base.find_last_of(kJoints), first = base.find_first_of(kJoints);
  const bool is_digit_last =
      base.size() > 1 && base.find_first_not_of("0123456789", 1) == base.npos;
  if (is_digit_last && (base[0] == 'x' || base[0] == 'y')) {
    return named(std::string_view(base).substr(1), std::string_view(base).substr(0, 1));
  }
  if (last == std::string::npos || last == 0) return std::nullopt;
  const auto either = [&](std::string_view word, std::string_view a, std::string_view b) {
    return word == a || word == b;
  };
  const std::string_view front = std::string_view(base).substr(0, last);
  std::string_view back = std::string_view(base).substr(last + 1);
  if (is_none(front)) return std::nullopt;
  const std::string_view start = std::string_view(base).substr(0, first);
  if (either(start, "x", "y") && !either(back, "x", "y")) {  // x_nose, x_{mass_A}
    std::string_view object = std::string_view(base).substr(first + 1);
    if (is_none(object)) return std::nullopt;
    if (object.starts_with('{') && object.ends_with('}')) {
      object = object.substr(1, object.size() - 2);
    }
    return named(object, start);
  }
  if (back == "latitude") back = "lat";
  if (either(back, "longitude", "long")) back = "lon";
  if (either(back, "time", "timestamp")) back = "t";
  return named(front, back);
}

ColumnMap::ColumnMap(const std::vector<Heading>& all_headings,
                     const std::vector<ColumnChoice>& choices) {
  for (const ColumnChoice& choice : choices) {
    const auto column = column_named(choice.column, all_headings);
    if (!column) {
      std::vector<std::string_view> names;
      for (const Heading& heading : all_headings) names.push_back(heading.text);
      throw ColumnError(fmt::format("--columns {}: there is no column {}{}", to_string(choice.role),
                                    in_quotes(choice.column),
                                    hint(choice.column, "columns", names)));
    }
    columns_.emplace_back(choice.role, *column);
  }
  chosen_ = columns_.size();
  const std::vector<Heading> headings = of_one_run(all_headings, columns_);
  for (const Alias& alias : kAliases) {
    if (has(alias.role)) continue;
    any_word(alias.names, [&](std::string_view name) {
      for (std::size_t i = 0; i < headings.size(); ++i) {
        if (headings[i].base != name) continue;
        for (std::size_t j = i + 1; j < headings.size(); ++j) {
          const bool are_told_apart = has_role(i) || has_role(j);
          if (headings[j].text != headings[i].text || are_told_apart) continue;
          throw ColumnError(fmt::format("column {} is there twice", in_quotes(headings[i].text)));
        }
        columns_.emplace_back(alias.role, i);
        return true;
      }
      return false;
    });
  }
  const auto is_called = [&](Role role, std::string_view name) {
    const auto column = find(role);
    return column && headings[*column].base == name && !is_chosen(role);
  };
  // Across a picture, u and v; beside an x, v is a velocity.
  if (const bool has_u = is_called(Role::kX, "u"); has_u != is_called(Role::kY, "v")) {
    const Role alone = has_u ? Role::kX : Role::kY;
    std::erase_if(columns_, [alone](const auto& column) { return column.first == alone; });
  }
  // Of a distance and a bearing, one alone is no place.
  std::erase_if(columns_, [&, is_place = has_polar()](const auto& column) {
    const bool is_polar = column.first == Role::kRange || column.first == Role::kBearing;
    return is_polar && !is_place && !is_chosen(column.first);
  });
  if (!has(Role::kTime)) {
    std::vector<std::size_t> counting;  // of "secs" and "nsecs" neither is the time
    for (std::size_t i = 0; i < headings.size(); ++i) {
      const auto unit = unit_named(headings[i].base);
      if (unit && counts_time(*unit)) counting.push_back(i);
    }
    if (counting.size() == 1) columns_.emplace_back(Role::kTime, counting.front());
  }
  for (const auto& [role, words] :
       {std::pair(Role::kTime, "t time stamp timestamp zeit"), std::pair(Role::kX, "x"),
        std::pair(Role::kY, "y"), std::pair(Role::kLatitude, "lat latitude"),
        std::pair(Role::kLongitude, "lon long longitude")}) {
    if (has(role)) continue;
    if (const auto column = column_telling(words, headings)) columns_.emplace_back(role, *column);
  }
}

bool ColumnMap::has_role(std::size_t column) const {
  return std::any_of(columns_.begin(), columns_.end(),
                     [&](const auto& known) { return known.second == column; });
}

bool ColumnMap::is_chosen(Role role) const {
  return std::any_of(columns_.begin(), columns_.begin() + static_cast<std::ptrdiff_t>(chosen_),
                     [&](const auto& column) { return column.first == role; });
}

void ColumnMap::add(Role role, std::size_t column) {
  if (!has(role)) columns_.emplace_back(role, column);
}

std::optional<std::size_t> ColumnMap::find(Role role) const {
  const auto found = std::find_if(columns_.begin(), columns_.end(),
                                  [&](const auto& column) { return column.first == role; });
  if (found == columns_.end()) return std::nullopt;
  return found->second;
}

}  // namespace ghtrack
