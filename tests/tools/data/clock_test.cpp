#include "tools/data/clock.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tools/data/place.hpp"

namespace ghtrack {
namespace {

// Derived: 2024-06-11T07:30:15 UTC is 19 885 days and 27 015 seconds after the start of 1970.
TEST(DateTime, MeansTheSameInEveryDialect) {
  constexpr double kSeconds = 19885.0 * 86400.0 + 7.0 * 3600.0 + 30.0 * 60.0 + 15.0;
  for (const char* text : {"2024-06-11T07:30:15Z",
                           "2024-06-11 07:30:15",
                           "2024-06-11T09:30:15+02:00",
                           "2024-06-11T02:00:15-0530",
                           "2024/06/11 07:30:15.000",
                           "20240611T073015Z",
                           "2024-06-11T07:30:15,0UTC",
                           "2024-06-11T16:30:15+09",
                           "11.06.2024 07:30:15",
                           "11/06/2024 07:30:15",
                           "11.6.2024 7:30:15 AM",
                           "11-Jun-2024 07:30:15.000",
                           "Tue Jun 11 09:30:15 GMT+02:00 2024",
                           "Jun 11 07:30:15 2024",
                           "20240611073015",
                           "2024.06.11 07:30:15",
                           "11.06.24 07:30:15",
                           "11/6/24 7:30:15",
                           "2024-06-11T09:30:15+2",
                           "2024-06-11 09:30:15 UTC+02:00"}) {
    SCOPED_TRACE(text);
    ASSERT_TRUE(parse_date_time(text).has_value());
    EXPECT_EQ(*parse_date_time(text), kSeconds);
  }
  EXPECT_EQ(parse_date_time("6/11/2024 7:30:15 AM", DateOrder::kMonthFirst), kSeconds);
  EXPECT_EQ(parse_date_time("11/06/2024 7:30:15 PM"), kSeconds + 12 * 3600.0);
  EXPECT_EQ(parse_date_time("2024-06-11T07:30:15.25Z"), kSeconds + 0.25);
  EXPECT_EQ(parse_date_time("2024-06-11 07:30:15:250"), kSeconds + 0.25);
  EXPECT_EQ(parse_date_time("1970-01-01"), 0.0);
  EXPECT_EQ(parse_date_time("1969-12-31T23:59:59Z"), -1.0);
  EXPECT_EQ(
      parse_date_time("2000-03-01T00:00Z").value() - parse_date_time("2000-02-28T00:00Z").value(),
      2 * 86400.0);
}

// Property: what is no date is none.
TEST(DateTime, RefusesWhatIsNone) {
  for (const char* text :
       {"", "2024", "2024-13-01T00:00", "2024-06-11T25:00:00", "2024-06-11T07:61",
        "2024-06-11T07:30:15X", "2024-06-11T07:30:15+", "31.06.2024 07:30", "11.6/2024", "1-6-2024",
        "Tue Foo 11 07:30:15 2024", "13:00 PM", "2024-06/11", "2024-06-11T07:30:15+02:00 ",
        "2024-06-11T07:30:"}) {
    EXPECT_FALSE(parse_date_time(text).has_value()) << text;
  }
}

double read(const char* unit, const char* time, std::optional<double> rate = {}) {
  std::optional<Unit> of_column;
  if (*unit != '\0') of_column = parse_heading("t (" + std::string(unit) + ")").unit;
  return Clock({.unit = of_column, .frame_rate = rate}, time).seconds(time).value();
}

// Derived: by the unit, or by a size that no other unit could have.
TEST(Clock, TurnsEveryUnitIntoSeconds) {
  EXPECT_EQ(read("ms", "33"), 0.033);
  EXPECT_EQ(read("us", "1500000"), 1.5);
  EXPECT_EQ(read("min", "1.5"), 90.0);
  EXPECT_EQ(read("", "12.5"), 12.5);
  EXPECT_EQ(read("", "1718091015"), 1718091015.0);
  EXPECT_EQ(read("", "1718091015250"), 1718091015.25);
  EXPECT_EQ(read("", "1718091015250000"), 1718091015.25);
  EXPECT_NEAR(read("", "1718091015250000000"), 1718091015.25, 5e-7);  // two steps of doubles
  EXPECT_EQ(read("", "45", 30.0), 1.5);
  EXPECT_EQ(read("", "01:02:03.5"), 3723.5);
  EXPECT_EQ(read("", "25:00:01"), 90001.0);  // of a stopwatch
  EXPECT_EQ(read("", "01:02.5"), 62.5);
  EXPECT_EQ(read("days", "0.5"), 43200.0);
  EXPECT_EQ(read("", "1.5 sec"), 1.5);  // a duration of MATLAB
  EXPECT_EQ(read("", "2 min"), 120.0);
  EXPECT_EQ(read("", "1 days 00:00:01.5"), 86401.5);  // and of pandas
}

// Derived: what loggers of GPS write; without its zeros at the front a time loses nothing, and a
// number that no clock shows is none.
TEST(Clock, ReadsTimesAndDatesOfDigits) {
  EXPECT_EQ(parse_compact_time("095950"), 35990.0);
  EXPECT_EQ(parse_compact_time("95950.25"), 35990.25);
  EXPECT_EQ(parse_compact_time("7"), 7.0);
  for (const char* none : {"", "246000", "126100", "1234567", "12:00", "-1", "1e3"}) {
    EXPECT_FALSE(parse_compact_time(none)) << none;
  }
  EXPECT_EQ(parse_date("240611", DateOrder::kYearFirst), 19885);
  EXPECT_EQ(parse_date("110624", DateOrder::kDayFirst), 19885);
  EXPECT_EQ(parse_date("061124", DateOrder::kMonthFirst), 19885);
  EXPECT_EQ(parse_date("700101", DateOrder::kYearFirst), 0);
  EXPECT_FALSE(parse_date("241311", DateOrder::kYearFirst));
  EXPECT_EQ(Clock({}, "95950").meaning(), "s");
  EXPECT_EQ(Clock({.has_date = true}, "95950").seconds("100001"), 36001.0);
}

// Derived: 2024-06-11 is day 45454 of Excel and day 739414 of MATLAB; without dashes it is a date
// only where the column says so, or with its time.
TEST(Clock, CountsDaysAsProgramsDo) {
  constexpr double kMidnight = 19885.0 * 86400.0;
  const auto of_dates = [](const char* text) {
    return Clock({.are_dates = true}, text).seconds(text).value();
  };
  EXPECT_EQ(of_dates("45454.25"), kMidnight + 21600.0);
  EXPECT_EQ(of_dates("739414.5"), kMidnight + 43200.0);
  EXPECT_EQ(of_dates("20240611"), kMidnight);
  EXPECT_EQ(read("", "20240611"), 20240611.0);
  EXPECT_EQ(read("", "20240611000001"), kMidnight + 1.0);
}

// Derived: a minute of latitude is a nautical mile of 1852 m to half a percent; the way back ends
// where it started.
TEST(Place, TurnsDegreesIntoMetresAndBack) {
  const GeoPoint origin{.latitude = 37.46, .longitude = 126.43};
  const Eigen::Vector2d north = to_metres(origin, {37.46 + 1.0 / 60.0, 126.43});
  EXPECT_NEAR(north.x(), 0.0, 1e-6);
  EXPECT_NEAR(north.y(), 1852.0, 0.005 * 1852.0);
  EXPECT_FALSE(std::signbit(to_metres(origin, origin).y()));  // read as "-0" otherwise
  const GeoPoint away{.latitude = 37.9, .longitude = 125.8};
  const GeoPoint back = to_degrees(origin, to_metres(origin, away));
  EXPECT_NEAR(back.latitude, away.latitude, 1e-11);
  EXPECT_NEAR(back.longitude, away.longitude, 1e-11);
  // Across the line where the date changes, the way is the short one.
  EXPECT_NEAR(to_metres({0.0, 179.99}, {0.0, -179.99}).x(), 0.02 * 111319.5, 1.0);
}

}  // namespace
}  // namespace ghtrack
