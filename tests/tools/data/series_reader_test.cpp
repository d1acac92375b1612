#include "tools/data/series_reader.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <random>

#include "tests/tools/record/message_of.hpp"
#include "tests/tools/record/scratch_folder.hpp"
#include "tools/data/scan_reader.hpp"
#include "tools/data/time_order.hpp"
#include "tools/record/errors.hpp"

namespace ghtrack {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// Rows as "t:z t:z …"; "-" where there is none.
std::string rows_of(SeriesReader& reader) {
  std::string text;
  while (const auto row = reader.next()) {
    text += row->time ? fmt::format("{:g}:", *row->time) : "";
    if (!row->z) text += "-";
    for (Eigen::Index i = 0; row->z && i < row->z->size(); ++i) {
      text += fmt::format("{}{:g}", i == 0 ? "" : ",", (*row->z)[i]);
    }
    text += " ";
  }
  return text;
}

std::string rows_of(const std::string& content, const ReadOptions& options = {},
                    SeriesTimes times = SeriesTimes::kIfThere) {
  const ScratchFolder folder;
  SeriesReader reader(folder.write("in.csv", content).string(), options, times);
  return rows_of(reader);
}

// Derived: the names that ghtrack promises come first, then those that people give.
TEST(SeriesReader, FindsWhatIsMeasured) {
  EXPECT_EQ(rows_of("1\n2\n3\n"), "1 2 3 ");
  EXPECT_EQ(rows_of("z\n1\n\n3\n"), "1 - 3 ");
  EXPECT_EQ(rows_of("weight\n1\nNA\n3\n"), "1 - 3 ");
  EXPECT_EQ(rows_of("x,z,y0\n9,1,9\n9,2,9\n"), "1 2 ");
  EXPECT_EQ(rows_of("zx,zy\n1,2\n3,4\n"), "1,2 3,4 ");
  EXPECT_EQ(rows_of("x,y,z\n1,2,3\n"), "1,2,3 ");
  EXPECT_EQ(rows_of("east,north\n1,2\n3,\n"), "1,2 - ");
  EXPECT_EQ(rows_of("t,height\n0,5\n1,6\n"), "0:5 1:6 ");
  EXPECT_EQ(rows_of("sensor,t,bearing (deg)\na,0,350\na,1,355\n"), "0:350 1:355 ");
  EXPECT_EQ(rows_of("t,a,b\n0,5,7\n1,6,8\n", {.columns = "z=b"}), "0:7 1:8 ");
  EXPECT_EQ(rows_of("t,a_x,a_y,b_x,b_y\n0,5,7,1,1\n1,6,8,1,1\n", {.columns = "x=2,y=3"}),
            "0:5,7 1:6,8 ");
  EXPECT_EQ(rows_of("scorer,n,n,n,n\nbodyparts,a,a,b,b\ncoords,x,y,x,y\n0,5,7,1,1\n1,6,8,1,1\n",
                    {.columns = "x=a x,y=a y", .frame_rate = 1.0}),
            "0:5,7 1:6,8 ");
  EXPECT_EQ(rows_of("date,steps\n1970-01-01,5\n1970-01-02,6\n"), "0:5 86400:6 ");
}

// Property: a number with a decimal comma is no place on earth, a velocity no coordinate, and a
// column that is called like a unit of time counts in it.
TEST(SeriesReader, TakesColumnsForWhatTheyAre) {
  EXPECT_EQ(rows_of("Zeit (s);Position (m)\n0,0;1,00\n0,5;1,25\n"), "0:1 0.5:1.25 ");
  EXPECT_EQ(rows_of("Zeit;Position\n0,0;1,00\n0,5;1,25\n"), "0:1 0.5:1.25 ");
  EXPECT_EQ(rows_of("t,x,v\n0,1,9\n1,2,9\n"), "0:1 1:2 ");
  EXPECT_EQ(rows_of("t,u,v\n0,1,9\n1,2,9\n"), "0:1,9 1:2,9 ");
  EXPECT_EQ(rows_of("millis,height_mm\n0,1000\n500,1500\n"), "0:1 0.5:1.5 ");
  EXPECT_EQ(rows_of("seconds_elapsed,z\n0,1\n0.5,2\n"), "0:1 0.5:2 ");
  EXPECT_EQ(rows_of("z,min,h\n1,5,6\n2,5,6\n"), "1 2 ");
}

// Derived: hhmmss beside a date are times of one clock, over an hour's end and over midnight.
TEST(SeriesReader, ReadsTimesOfDigitsBesideDates) {
  const ScratchFolder folder;
  SeriesReader reader(
      folder.write("in.csv", "DATE,TIME,z\n240611,95959,1\n240611,100000,2\n240612,1,3\n")
          .string());
  std::vector<double> times;
  while (const auto row = reader.next()) times.push_back(row->time.value());
  ASSERT_EQ(times.size(), 3U);
  EXPECT_EQ(times[0], 19885.0 * 86400.0 + 35999.0);
  EXPECT_EQ(times[1] - times[0], 1.0);
  EXPECT_EQ(times[2], 19886.0 * 86400.0 + 1.0);
  SeriesReader other(
      folder.write("b.csv", "date,t,z\n2024-06-11,0.5,1\n2024-06-11,1,2\n").string());
  EXPECT_THAT(other.understood(), HasSubstr("('date' is not used)"));
}

// Property: units and capitals change no column's meaning.
TEST(SeriesReader, KnowsColumnsWithUnits) {
  EXPECT_EQ(rows_of("t (s),x (mm),y (mm),z (mm)\n0,1000,2000,3000\n1,2000,3000,4000\n"),
            "0:1,2,3 1:2,3,4 ");
  EXPECT_EQ(rows_of("t,X,Y,Z\n0,1,2,3\n1,2,3,4\n"), "0:1,2,3 1:2,3,4 ");
  EXPECT_EQ(rows_of("time (h),x (km)\n0,1\n1,2\n"), "0:1000 3600:2000 ");
  const ScratchFolder folder;
  SeriesReader steps(folder.write("in.csv", "z (mm),dt (ms),truth (mm)\n1000,10,1500\n").string());
  const auto row = steps.next();
  ASSERT_TRUE(row && row->dt && row->truth);
  EXPECT_EQ(*row->dt, 0.01);
  EXPECT_EQ((*row->truth)[0], 1.5);
  SeriesReader unknown(folder.write("b.csv", "t,height (furlongs)\n0,1\n1,2\n").string());
  EXPECT_THAT(unknown.understood(), HasSubstr("'height (furlongs)' (no unit is 'furlongs')"));
}

// Property: titles, headers that come again and rows of several objects do not go unnoticed.
TEST(SeriesReader, PassesOverTitlesAndRepeatedHeaders) {
  EXPECT_EQ(rows_of("My experiment\nt,z\n0,1\n1,2\n"), "0:1 1:2 ");
  EXPECT_EQ(rows_of("sep=;\nt;z\n0;1\n1;1,5\n"), "0:1 1:1.5 ");
  EXPECT_EQ(rows_of("t,z\nt,z\n0,1\nt,z\n1,2\n"), "0:1 1:2 ");
  const ScratchFolder folder;
  SeriesReader named(folder.write("b.csv", "t,mmsi,z\n0,a,1\n1,b,2\n").string());
  EXPECT_THAT(named.understood(), HasSubstr("rows of several objects by 'mmsi'"));
}

// Property: times of day go on after midnight, also when they are read again; dates go by the order
// that the first one shows, and whoever is wrong is named.
TEST(SeriesReader, GoesOnAfterMidnight) {
  EXPECT_EQ(rows_of("time,z\n23:59:58,0\n23:59:59,1\n00:00:00,2\n00:00:01,3\n"),
            "86398:0 86399:1 86400:2 86401:3 ");
  const std::string american = "date,time,z\n06/13/1970,23:59:59,1\n06/14/1970,00:00:00,2\n";
  EXPECT_EQ(rows_of(american), "1.41696e+07:1 1.41696e+07:2 ");
  EXPECT_EQ(message_of(american + "13/06/1970,00:00:01,3\n",
                       [](const auto& path) { SeriesReader(path.string()); }),
            "in.csv:4:1: error: '13/06/1970' in column 'date' is not a date such as 2024-06-11");
}

// Derived: times that are not asked for are used only where nothing else says how rows are spaced.
TEST(SeriesReader, TakesTimesWhereTheyAreWanted) {
  EXPECT_EQ(rows_of("t,z\n0,1\n2,2\n"), "0:1 2:2 ");
  EXPECT_EQ(rows_of("t,z\n0,1\n2,2\n", {}, SeriesTimes::kIfAsked), "1 2 ");
  EXPECT_EQ(rows_of("s,z\n0,1\n2,2\n", {.columns = "", .time_column = "s"}, SeriesTimes::kIfAsked),
            "0:1 2:2 ");
  EXPECT_EQ(rows_of("dt,t,z\n1,0,1\n1,2,2\n"), "1 2 ");
  EXPECT_EQ(rows_of("frame,z\n0,1\n15,2\n"), "1 2 ");
  EXPECT_EQ(rows_of("frame,z\n0,1\n15,2\n", {.columns = "", .frame_rate = 30.0}), "0:1 0.5:2 ");
}

/// One way of writing the same three rows 0 s, 0.25 s and 0.5 s with 1.5, nothing and −2.75 m.
struct Writing {
  std::string separator;
  bool decimal_comma;
  std::string header_time, header_place;
  double time_scale, place_scale;  // in one second, in one metre
  std::string time_format;         // number, epoch, iso, blank-iso
  bool quoted, byte_order_mark, carriage_return, comments;
};

std::string number(double value, bool comma) {
  std::string text = fmt::format("{}", value);
  if (comma) std::replace(text.begin(), text.end(), '.', ',');
  return text;
}

std::string written(const Writing& w, bool two_axes) {
  const std::string end = w.carriage_return ? "\r\n" : "\n";
  const auto cell = [&](const std::string& text) { return w.quoted ? "\"" + text + "\"" : text; };
  std::string text = w.byte_order_mark ? "\xef\xbb\xbf" : "";
  if (w.comments) text += "# made by a logger" + end;
  text += cell(w.header_time) + w.separator + cell(w.header_place);
  if (two_axes) text += w.separator + cell("y" + w.header_place.substr(1));
  text += end;
  for (const auto& [t, z] : std::vector<std::pair<double, std::optional<double>>>{
           {0.0, 1.5}, {0.25, std::nullopt}, {0.5, -2.75}}) {
    const std::string stamp =
        w.time_format == "iso"         ? fmt::format("2024-06-11T07:30:{:05.2f}Z", 15 + t)
        : w.time_format == "blank-iso" ? fmt::format("2024-06-11 09:30:{:05.2f}+02:00", 15 + t)
        : w.time_format == "epoch"     ? number((1718091015 + t) * w.time_scale, w.decimal_comma)
                                       : number(t * w.time_scale, w.decimal_comma);
    const std::string place = z ? number(*z * w.place_scale, w.decimal_comma)
                                : std::string(w.separator == " " ? "NaN"
                                              : w.comments       ? "NA"
                                                                 : "");
    text += cell(stamp) + w.separator + cell(place);
    if (two_axes) text += w.separator + cell(place);
    text += end;
    if (w.comments) text += end + "// a remark" + end;
  }
  return text;
}

std::vector<Writing> writings() {
  std::vector<Writing> all;
  int number = 0;
  for (const std::string separator : {",", ";", "\t", " ", "|"}) {
    for (const bool comma : {false, true}) {
      for (const auto& [time, time_scale] : std::vector<std::pair<std::string, double>>{
               {"t", 1.0}, {"Time (ms)", 1e3}, {"time_us", 1e6}, {"timestamp [s]", 1.0}}) {
        for (const auto& [place, place_scale] : std::vector<std::pair<std::string, double>>{
                 {"x", 1.0}, {"x (mm)", 1e3}, {"x[cm]", 1e2}, {"x_km", 1e-3}, {"x / m", 1.0}}) {
          for (const std::string format : {"number", "epoch", "iso", "blank-iso"}) {
            ++number;
            const bool quoted = number % 3 == 0;
            // A comma cannot be both, unless quotes tell the two apart.
            if (separator == "," && comma && !quoted) continue;
            all.push_back({separator, comma, time, place, time_scale, place_scale, format, quoted,
                           number % 2 == 0, number % 5 < 2, number % 7 < 3});
          }
        }
      }
    }
  }
  return all;
}

// Property: however a table is written, it says the same to every reader.
TEST(SeriesReader, UnderstandsEveryWayOfWritingATable) {
  const ScratchFolder folder;
  for (const Writing& writing : writings()) {
    const double start = writing.time_format == "number" ? 0.0 : 1718091015.0;
    for (const bool two_axes : {false, true}) {
      const std::string text = written(writing, two_axes);
      const std::string path = folder.write("in.txt", text).string();
      try {
        SeriesReader series(path);
        ASSERT_EQ(series.axes(), two_axes ? 2U : 1U) << text;
        std::vector<MeasuredRow> rows;
        while (auto row = series.next()) rows.push_back(*row);
        ASSERT_EQ(rows.size(), 3U) << text;
        for (int i = 0; i < 3; ++i) EXPECT_NEAR(*rows[i].time - start, 0.25 * i, 1e-6) << text;
        EXPECT_NEAR((*rows[0].z)[0], 1.5, 1e-12) << text;
        EXPECT_FALSE(rows[1].z) << text;
        EXPECT_NEAR((*rows[2].z)[0], -2.75, 1e-12) << text;
        if (!two_axes) continue;
        ScanReader scans(path);
        std::vector<Scan> seen;
        for (Scan scan; scans.next(scan);) seen.push_back(scan);
        ASSERT_EQ(seen.size(), 3U) << text;
        EXPECT_EQ(seen[0].time, *rows[0].time) << text;
        EXPECT_EQ(seen[0].detections.at(0).position, Eigen::Vector2d(*rows[0].z)) << text;
        EXPECT_TRUE(seen[1].detections.empty()) << text;
      } catch (const InputError& error) {
        ADD_FAILURE() << error.what() << "\n" << text;
      }
    }
  }
}

// Property: any order of the rows gives the same series; rows of one time keep theirs.
TEST(SeriesReader, PutsRowsInOrder) {
  std::vector<std::string> rows;
  for (int i = 0; i < 200; ++i) rows.push_back(fmt::format("{},{}\n", i / 2 * 0.5, i));
  std::string sorted = "t,z\n";
  for (const std::string& row : rows) sorted += row;
  std::vector<int> pairs(100);
  for (int i = 0; i < 100; ++i) pairs[i] = i;
  for (unsigned seed = 0; seed < 20; ++seed) {
    std::mt19937 random(seed);
    std::shuffle(pairs.begin(), pairs.end(), random);
    std::string shuffled = "t,z\n";
    for (const int pair : pairs) shuffled += rows[2 * pair] + rows[2 * pair + 1];
    EXPECT_EQ(rows_of(shuffled), rows_of(sorted));
  }
  EXPECT_EQ(rows_of("t,z\n0,1\n2,3\n1,2\n3,4\n4,5\n5,6\n6,7\n7,8\n8,9\n9,10\n"),
            "0:1 1:2 2:3 3:4 4:5 5:6 6:7 7:8 8:9 9:10 ");
}

// Derived: a false time is left out with its line; those around it stay.
TEST(TimeOrder, TellsFalseTimesFromRowsOutOfOrder) {
  using enum Placing;
  EXPECT_THAT(placings({0, 1, 5000, 3, 4, 5}),
              ElementsAre(kKeep, kKeep, kBelied, kKeep, kKeep, kKeep));
  EXPECT_THAT(placings({0, 1, 2, 3, -700, 5}),
              ElementsAre(kKeep, kKeep, kKeep, kKeep, kLate, kKeep));
  EXPECT_THAT(placings({0, 1, 2, 3, 1, 5}), ElementsAre(kKeep, kKeep, kKeep, kKeep, kLate, kKeep));
  EXPECT_THAT(placings({0, 1, 3, 2, 4, 5}), ::testing::Each(kKeep));
  EXPECT_THAT(placings({5, 4, 3, 2, 1, 0}), ::testing::Each(kKeep));
  EXPECT_THAT(placings({0, 1, 2, 0, 1, 2}), ::testing::Each(kKeep));
  EXPECT_THAT(placings({0, 0, 0}), ::testing::Each(kKeep));
  EXPECT_TRUE(placings({}).empty());
}

// Property: all that is wrong is said at once, with line and column, or left out and counted.
TEST(SeriesReader, RefusesOrLeavesOutWhatIsNoNumber) {
  const ScratchFolder folder;
  const std::string path =
      folder.write("in.csv", "t,z\n0,1\n1,oops\n2,3\nx,4\n4,inf\n5,6,7\n6,7\n").string();
  try {
    SeriesReader reader(path);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    for (const char* place : {":3:3: error: 'oops'", ":5:1: error: 'x'", ":6:3: error: 'inf'",
                              ":7: error: this row has 3 fields"}) {
      EXPECT_THAT(error.what(), HasSubstr(place));
    }
  }
  SeriesReader reader(path, {.skip_bad_rows = true});
  EXPECT_EQ(rows_of(reader), "0:1 2:3 6:7 ");
  EXPECT_EQ(reader.left_out(), 4);
  EXPECT_EQ(reader.remarks().size(), 4U);
}

// Derived: a place is read however it is written: 0.001° of a meridian at 50° are 111.23 m.
TEST(SeriesReader, ReadsPlacesAsTracksAreRead) {
  for (const char* content :
       {"time,lat,lon\n0,50,8\n1,,\n2,50.001,8\n",
        "time,lat,lon\n0,50°0'0\"N,8°E\n1,,\n2,50°0'3.6\"N,8°E\n",
        "time,lat,lon\n0,500000000,80000000\n1,,\n2,500010000,80000000\n",
        "time,position_lat,position_long\n0,596523236,95443718\n1,,\n2,596535166,95443718\n",
        "time;Position\n0;50,8\n1;\n2;50.001,8\n",
        "time,Position\n1,\n0,\"50,8\"\n2,\"50.001,8\"\n",
        "time,wkt\n0,POINT (8 50)\n1,NA\n2,POINT (8 50.001)\n",
        "time,lat,lon\n0,50,8\n1,91,181\n2,50.001,8\n"}) {
    const ScratchFolder folder;
    SeriesReader reader(folder.write("in.csv", content).string());
    ASSERT_EQ(reader.axes(), 2U) << content;
    const auto first = reader.next(), second = reader.next(), third = reader.next();
    ASSERT_TRUE(first && first->z && second && !second->z && third && third->z) << content;
    EXPECT_NEAR((*third->z - *first->z)[0], 0.0, 1e-3) << content;
    EXPECT_NEAR((*third->z - *first->z)[1], 111.23, 0.02) << content;
  }
}

// Property: a row with several faults is one row left out, with all that is said of it.
TEST(SeriesReader, CountsRowsLeftOut) {
  const ScratchFolder folder;
  SeriesReader reader(folder.write("in.csv", "t,x,y\n0,1,2\n1,oops,no\n2,3,4\n").string(),
                      {.skip_bad_rows = true});
  EXPECT_EQ(rows_of(reader), "0:1,2 2:3,4 ");
  EXPECT_EQ(reader.left_out(), 1);
  EXPECT_EQ(reader.remarks().size(), 2U);
}

// Derived: degrees become metres; lengths too.
TEST(SeriesReader, SaysWhatItUnderstood) {
  const ScratchFolder folder;
  SeriesReader walk(folder
                        .write("in.csv",
                               "time,lat,lon\n2024-06-11T07:30:00Z,50,8\n"
                               "2024-06-11T07:30:01Z,,\n2024-06-11T07:30:02Z,50.001,8\n")
                        .string());
  EXPECT_THAT(walk.understood(),
              HasSubstr("3 rows (commas), t (ISO 8601, as s since 1970) from 'time', zx and zy in "
                        "m from degrees in 'lon' and 'lat' around latitude 50, longitude 8; 1 rows "
                        "without a measurement"));
  EXPECT_FALSE(walk.is_plain());
  const auto last = [&] {
    std::optional<MeasuredRow> row, now;
    while ((now = walk.next())) row = now;
    return *row->z;
  }();
  EXPECT_NEAR(last[1], 111.2, 0.1);
  EXPECT_TRUE(SeriesReader(folder.write("a.csv", "z\n1\n").string()).is_plain());
}

}  // namespace
}  // namespace ghtrack
