#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "tests/tools/record/message_of.hpp"
#include "tests/tools/record/scratch_folder.hpp"
#include "tools/data/point_reader.hpp"
#include "tools/data/scan_reader.hpp"
#include "tools/record/errors.hpp"

namespace ghtrack {
namespace {

using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

/// Scans as "t/sensor: x,y x,y; …".
std::string scans_of(const std::string& content, const ReadOptions& options = {}) {
  const ScratchFolder folder;
  ScanReader reader(folder.write("in.csv", content).string(), options);
  std::string text;
  for (Scan scan; reader.next(scan);) {
    char number[64];
    std::snprintf(number, sizeof number, "%g/%d:", scan.time, scan.sensor);
    text += number;
    for (const Detection& detection : scan.detections) {
      std::snprintf(number, sizeof number, " %g,%g", detection.position.x(),
                    detection.position.y());
      text += number;
    }
    text += "; ";
  }
  return text;
}

// Derived: rows with the same time and sensor make one scan; times are sorted.
TEST(ScanReader, GathersRowsIntoScans) {
  EXPECT_EQ(
      scans_of("t,sensor,class,x,y\n0.2,radar,ball,1,2\n0.1,camera,,3,4\n0.2,camera,train,5,6\n"
               "0.2,radar,,7,8\n"),
      "0.1/1: 3,4; 0.2/0: 1,2 7,8; 0.2/1: 5,6; ");
}

// Derived: a row without a position is a scan that saw nothing.
TEST(ScanReader, TakesAnEmptyPositionForAMissedDetection) {
  for (const char* missing :
       {",", "nan,nan", "NaN,NaN", "NA,NA", " , ", "\"\",\"\"", "null,1", "<NA>,<NA>", "NaT,NaT",
        "None,None", "\\N,\\N", "#N/A,#N/A", "#NV,1", ".,."}) {
    EXPECT_EQ(scans_of("t,x,y\n0,1,2\n1," + std::string(missing) + "\n2,3,4\n"),
              "0/0: 1,2; 1/0:; 2/0: 3,4; ")
        << missing;
  }
}

// Property: what a logger wrote twice to the letter was seen once; what only looks alike was not.
TEST(ScanReader, PassesOverRepeatedRows) {
  EXPECT_EQ(scans_of("t,x,y\n0,1,2\n0,1,2\n0,1,2\n1,3,4\n1,3,4.0\n0.5,1,1\n0.5,1,1\n"),
            "0/0: 1,2; 0.5/0: 1,1; 1/0: 3,4 3,4; ");
  const ScratchFolder folder;
  const ScanReader reader(folder.write("in.csv", "t,x,y\n0,1,2\n0,1,2\n1,3,4\n1,3,4\n").string());
  EXPECT_EQ(reader.summary().rows, 2);
  EXPECT_EQ(reader.summary().repeated, 2);
  EXPECT_THAT(reader.summary().understood, HasSubstr("2 rows repeat the one before"));
}

// Derived: of BaseStation's messages those count that have a position; times are UTC.
TEST(ScanReader, ReadsMessagesOfBaseStation) {
  const std::string callsign =
      "MSG,1,1,1,4CA2D6,1,2026/03/11,12:00:00.000,2026/03/11,12:00:00.100,EIN123,,,,,,,,,,,0\n";
  const auto position = [](const char* time, double latitude) {
    return "MSG,3,1,1,4CA2D6,1,2026/03/11," + std::string(time) + ",2026/03/11," + time +
           ",,36000,,," + std::to_string(latitude) + ",-1.5,,,0,0,0,0\n";
  };
  const ScratchFolder folder;
  const auto file =
      folder.write("flights.sbs", callsign + position("12:00:01.500", 51.0) +
                                      "STA,,1,1,4CA2D6,1\n" + position("12:00:02.000", 51.001));
  ScanReader reader(file.string());
  EXPECT_EQ(reader.summary().rows, 2);
  EXPECT_NEAR(reader.summary().period, 0.5, 1e-6);
  ASSERT_TRUE(reader.summary().origin);
  Scan first, second;
  ASSERT_TRUE(reader.next(first) && reader.next(second));
  EXPECT_NEAR(first.time, 1773230401.5, 1e-3);   // date -u -d '2026-03-11 12:00:01.5' +%s.%N
  constexpr double kMetresPerDegree = 111253.0;  // of latitude at 51°
  EXPECT_NEAR((second.detections[0].position - first.detections[0].position).norm(),
              0.001 * kMetresPerDegree, 0.1);
  const std::string cut =
      position("12:00:01.500", 51.0) + position("12:00:02.500", 51.0) + "MSG,3,1,1,4CA2D6";
  EXPECT_THAT(message_of(cut, [](const auto& path) { ScanReader(path.string()); }),
              HasSubstr("in.csv:3:1: error: 'a message with 5 of 22 fields'"));
  ScanReader tolerant(folder.write("cut.sbs", cut).string(), {.skip_bad_rows = true});
  EXPECT_EQ(tolerant.summary().rows, 2);
  EXPECT_EQ(tolerant.summary().left_out, 1);
}

// Property: units, formats of time and names of columns change nothing.
TEST(ScanReader, UnderstandsUnitsAndAliases) {
  const std::string expected = "0/0: 1,2; 0.5/0: 1.5,2.5; ";
  EXPECT_EQ(scans_of("t,x,y\n0,1,2\n0.5,1.5,2.5\n"), expected);
  EXPECT_EQ(scans_of("Time (ms),East [cm],y(mm)\n0,100,2000\n500,150,2500\n"), expected);
  EXPECT_EQ(scans_of("time_us;pos_x;pos_y\n0;1;2\n500000;1,5;2,5\n"), expected);
  EXPECT_EQ(scans_of("frame,x,y\n0,1,2\n15,1.5,2.5\n", {.columns = "", .frame_rate = 30.0}),
            expected);
  EXPECT_EQ(scans_of("1970-01-01T01:00:00+01:00 1 2\n1970-01-01T00:00:00.5Z 1.5 2.5\n",
                     {.columns = "t=1,x=2,y=3"}),
            expected);
  EXPECT_EQ(scans_of("date,time,x,y\n1970-01-01,00:00:00,1,2\n1970-01-01,00:00:00.5,1.5,2.5\n"),
            expected);
}

// Property: nor do dates as people write them, titles over the header, a header that comes again in
// other words, words beside those that tell, or a unit that only an option names.
TEST(ScanReader, UnderstandsWhatProgramsWriteAroundATable) {
  const std::string expected = "0/0: 1,2; 0.5/0: 1.5,2.5; ";
  EXPECT_EQ(scans_of("mass_A\t\t\nt\tx\ty\n0\t1\t2\n0.5\t1.5\t2.5\n"), expected);
  EXPECT_EQ(scans_of("LABEL,POSITION_X,POSITION_Y,POSITION_T\nLabel,X,Y,T\n"
                     ",(micron),(micron),(sec)\nID1,1e6,2e6,0\nID2,1.5e6,2.5e6,0.5\n"),
            expected);
  EXPECT_EQ(scans_of("Latest: Time (s),Latest: X (m),Latest: Y (m)\n0,1,2\n0.5,1.5,2.5\n"),
            expected);
  EXPECT_EQ(
      scans_of("Zeit t / s;Ort x / m;Ort y / m;Geschwindigkeit v x\n0;1;2;7\n0,5;1,5;2,5;7\n"),
      expected);
  EXPECT_EQ(scans_of("timestamp,x,y\n0,1,2\n500000,1.5,2.5\n", {.columns = "t=timestamp[us]"}),
            expected);
  // What OptiTrack, Vicon and ROS write: names of groups over names that repeat, the rate alone in
  // a row, fields of messages.
  EXPECT_EQ(scans_of("Format Version,1.23,Take Name,walk\n\n,Type,Body,Body,Body,Body\n"
                     ",,Rotation,Rotation,Position,Position\n"
                     "Frame,Time (Seconds),X,Y,X,Y,\n0,0,9,9,1,2\n60,0.5,9,9,1.5,2.5\n"),
            expected);
  EXPECT_EQ(scans_of("Trajectories\n100\n,,Walker:Head,,\nFrame,Sub Frame,X,Y,Z\n,,mm,mm,mm\n"
                     "0,0,1000,2000,9\n50,0,1500,2500,9\n",
                     {.columns = "", .frame_rate = 100.0}),
            expected);
  EXPECT_EQ(scans_of("%time,field.header.seq,field.pose.position.x,field.pose.position.y,"
                     "field.pose.orientation.x,field.pose.orientation.y\n"
                     "0,1,1,2,9,9\n0.5,2,1.5,2.5,9,9\n"),
            expected);
  EXPECT_EQ(
      scans_of("t,/odom/pose/pose/position/x,/odom/pose/pose/position/y,/odom/twist/linear/x\n"
               "0,1,2,9\n0.5,1.5,2.5,9\n"),
      expected);
  EXPECT_EQ(scans_of("names,of,objects,here\na,b,c,d\n0,1,2,9\n0.5,1.5,2.5,9\n",
                     {.columns = "t=a,x=b,y=c"}),
            expected);
  EXPECT_EQ(scans_of("# Timestamp,x,y\n01/01/1970 00:00:00,1,2\n01/01/1970 00:00:00.5,1.5,2.5\n"),
            expected);
  // What datasets and autopilots write: titles of other shape, words joined by capitals, vectors
  // beside the position.
  EXPECT_EQ(scans_of("mass A\nt,x,y\n0,1,2\n0.5,1.5,2.5\n"), expected);
  EXPECT_EQ(scans_of("This file is made by a logger\n\nFormat,3\nTitle,\"Track\"\nMade,13/06/2024,"
                     "9:30\nNote,\n\nt,lap,x,y\n0,1,1,2\n0.5,1,1.5,2.5\n0.5,1,1.5,2.5\n"
                     "0.5,1,1.5,2.5\n0.5,1,1.5,2.5\n0.5,1,1.5,2.5\n"),
            expected);
  EXPECT_EQ(scans_of("\"Time\",\"X\",\"Y\",\"Speed\"\n\"ms\",\"cm\",\"cm\",\"m/s\"\n0,100,200,1\n"
                     "500,150,250,1\n"),
            expected);
  EXPECT_EQ(
      scans_of("sep=,\nCUSTOM.updateTime [local],OSD.flyTime,OSD.flyTime [s],p.x,p.y,HOME.x,"
               "HOME.y\n9:30:00.00 AM,0m 0s,0,1,2,9,9\n9:30:00.50 AM,0m 0.5s,0.5,1.5,2.5,9,9\n"),
      expected);
  EXPECT_EQ(scans_of("Film 3\nmass A\nt;x;y\n0;1;2\n0,5;1,5;2,5\n"), expected);
  EXPECT_EQ(scans_of("t x y\n0 1,0 2,0\n0,5 1,5 2,5\n"), expected);
  EXPECT_EQ(scans_of("TimeUS,xCenter,yCenter\n0,1,2\n500000,1.5,2.5\n"), expected);
  EXPECT_EQ(
      scans_of("#timestamp [ns],p_RS_R_x [m],p_RS_R_y [m],q_RS_x [],q_RS_y [],v_RS_R_x [m s^-1],"
               "v_RS_R_y [m s^-1]\n0,1,2,9,9,9,9\n500000000,1.5,2.5,9,9,9,9\n"),
      expected);
  EXPECT_EQ(scans_of("# timestamp tx ty tz qx qy qz qw\n0 1 2 9 0 0 0 1\n0.5 1.5 2.5 9 0 0 0 1\n"),
            expected);
  EXPECT_EQ(scans_of("Vehicle_ID,Global_Time,Local_X,Local_Y,Global_X,Global_Y\n1,0,1,2,9,9\n"
                     "1,500,1.5,2.5,9,9\n",
                     {.columns = "t=Global_Time[ms]"}),
            expected);
  EXPECT_THAT(message_of("t,p x (m/s^2),p y (m/s^2)\n0,1,2\n",
                         [](const auto& path) { ScanReader reader(path.string()); }),
              HasSubstr("column 'x' is missing"));
  EXPECT_THAT(message_of("vel t,vel x,vel y\n0,1,2\n",
                         [](const auto& path) { ScanReader reader(path.string()); }),
              HasSubstr("column 'x' is missing"));
}

// Property: objects side by side are the rows that they would be one below the other, whatever rows
// of headings name them: of Tracker, pandas, DeepLabCut, SLEAP or Vicon.
TEST(ScanReader, PartsObjectsSideBySide) {
  const std::string expected = "0/0: 1,2 7,8; 0.5/0: 1.5,2.5; 1/0: 2,3 9,9; ";
  const std::string rows = "0,1,2,7,8\n0.5,1.5,2.5,,\n1,2,3,9,9\n";
  for (const char* header :
       {"t,ball_x,ball_y,box_x,box_y\n", "t,x1,y1,x2,y2\n",
        "t,x_{mass_A},y_{mass_A},x_{mass_B},y_{mass_B}\n", "multi:,mass_A,,mass_B,\nt,x,y,x,y\n",
        ",one,,two,\nt,x,y,x,y\n", ",one,one,two,two\n,x,y,x,y\ntime,,,,\n",
        "object,one,one,two,two\ncoord,x,y,x,y\nt,,,,\n",
        ",Walker:Head,,Walker:Toe,\nTime,X,Y,X,Y\ns,m,m,m,m\n",
        "Time (s),Track 1: X (m),Track 1: Y (m),Track 2: X (m),Track 2: Y (m)\n"}) {
    EXPECT_EQ(scans_of(header + rows), expected) << header;
  }
  // Each with times of its own, one of them seen for a shorter time.
  EXPECT_EQ(scans_of("mass_A\t\t\tmass_B\t\t\nt\tx\ty\tt\tx\ty\n0\t1\t2\t0\t7\t8\n"
                     "0.5\t1.5\t2.5\t1\t9\t9\n1\t2\t3\t\t\t\n"),
            "0/0: 1,2 7,8; 0.5/0: 1.5,2.5; 1/0: 9,9 2,3; ");
  const std::string frames = "0,1,2,0.9,7,8,1\n1,1.5,2.5,1,,,\n2,2,3,1,9,9,0.8\n";
  for (const char* header :
       {"scorer,net,net,net,net,net,net\nbodyparts,nose,nose,nose,tail,tail,tail\n"
        "coords,x,y,likelihood,x,y,likelihood\n",
        "scorer,net,net,net,net,net,net\nindividuals,mouse1,mouse1,mouse1,mouse2,mouse2,"
        "mouse2\nbodyparts,nose,nose,nose,nose,nose,nose\n"
        "coords,x,y,likelihood,x,y,likelihood\n",
        "frame_idx,nose.x,nose.y,nose.score,tail.x,tail.y,tail.score\n"}) {
    EXPECT_EQ(scans_of(header + frames, {.columns = "", .frame_rate = 2.0}), expected) << header;
  }
  // Beside two objects, the end of something is a third.
  EXPECT_EQ(scans_of("t,nose_x,nose_y,tail_base_x,tail_base_y,tail_end_x,tail_end_y\n"
                     "0,1,2,7,8,3,4\n1,1,2,7,8,3,5\n"),
            "0/0: 1,2 7,8 3,4; 1/0: 1,2 7,8 3,5; ");
  EXPECT_EQ(scans_of("t,p_x,p_y,q2_x,q2_y\n" + rows, {.columns = "x=q2_x,y=q2_y"}),
            "0/0: 7,8; 0.5/0:; 1/0: 9,9; ");
  // What is written of one object several times, or in two units, is not several objects.
  for (const char* header :
       {"t,true_x,true_y,measured_x,measured_y\n", "t,start_x,start_y,end_x,end_y\n",
        "t,p_x (mm),p_y (mm),q2_x (m),q2_y (m)\n", "t,a_vel_x,a_vel_y,b_vel_x,b_vel_y\n"}) {
    EXPECT_THAT(
        message_of(header + rows, [](const auto& path) { ScanReader reader(path.string()); }),
        HasSubstr("column 'x' is missing"))
        << header;
  }
}

// Property: an index without a name is the time, or counts images.
TEST(ScanReader, TakesAnIndexForTheTime) {
  const std::string expected = "0/0: 1,2; 0.5/0: 1.5,2.5; ";
  EXPECT_EQ(scans_of(",x,y\n0,1,2\n1,1.5,2.5\n", {.columns = "", .frame_rate = 2.0}), expected);
  EXPECT_EQ(scans_of(",x,y\n0.0,1,2\n0.5,1.5,2.5\n"), expected);
  EXPECT_EQ(scans_of(",x,y\n1970-01-01 00:00:00,1,2\n1970-01-01 00:00:00.5,1.5,2.5\n"), expected);
  EXPECT_EQ(scans_of("\"\",\"t\",\"x\",\"y\"\n\"1\",0,1,2\n\"2\",0.5,1.5,2.5\n"), expected);
}

// Property: a cell in quotes may go on in the next lines; one that never ends, or ends elsewhere
// than before a separator, takes no other row with it.
TEST(ScanReader, ReadsCellsOfSeveralLines) {
  EXPECT_EQ(scans_of("t,note,x,y\n0,\"first\n# second, \"\"third\"\"\n\",1,2\n0.5,,1.5,2.5\n"),
            "0/0: 1,2; 0.5/0: 1.5,2.5; ");
  EXPECT_EQ(scans_of("\"t\n(ms)\",\"x\r\n(cm)\",y\n0,100,2\n500,150,2.5\n"),
            "0/0: 1,2; 0.5/0: 1.5,2.5; ");
  std::string many = "t,note,x,y\n";
  for (int i = 0; i < 60; ++i)
    many += std::to_string(i) + (i == 50 ? ",\"a\nb\",1,2\n" : ",,1,2\n");
  const auto read = [](const auto& path) { ScanReader reader(path.string()); };
  EXPECT_EQ(message_of(many + "60,\"open,1,2\n61,,1,2\n", read),
            "in.csv:63: error: this row has 2 fields; the header row has 4; a cell in quotes does "
            "not end, or has text behind it");
  EXPECT_THAT(message_of("t,note,x,y\n0,\"open,1,2\n1,\"shut\",1,2\n2,,1,2\n", read),
              StartsWith("in.csv:2: error: this row has 2 fields"));
}

// Derived: sentences of NMEA 0183 with their checksums; 4807.038 N is 48° 7.038'. Dates are in RMC
// alone; a receiver without a fix (V, or quality 0) saw nothing.
TEST(ScanReader, ReadsSentencesOfReceivers) {
  const auto sentence = [](const std::string& text) {
    unsigned sum = 0;
    for (const char c : text) sum ^= static_cast<unsigned char>(c);
    char end[8];
    std::snprintf(end, sizeof end, "*%02X\r\n", sum);
    return "$" + text + end;
  };
  const std::string first = sentence("GPRMC,123519.00,A,4807.038,N,01131.000,W,22.4,84.4,230394,,");
  EXPECT_THAT(first, HasSubstr("*"));
  const std::string log = sentence("GPGSV,1,1,00") + sentence("GNRMC,,V,,,,,,,,,,N") +
                          sentence("GNGGA,123519,4807.038,S,01131.000,E,1,08,0.9,5.4,M,,M,,") +
                          first + sentence("GPRMC,123520.00,V,,,,,,,230394,,") +
                          sentence("GPRMC,123521.50,A,4807.038,N,01131.000,W,22.4,84.4,230394,,");
  const ScratchFolder folder;
  ScanReader reader(folder.write("gps.txt", log).string());
  ASSERT_TRUE(reader.summary().origin.has_value());
  EXPECT_DOUBLE_EQ(reader.summary().origin->latitude, 48.0 + 7.038 / 60.0);
  EXPECT_DOUBLE_EQ(reader.summary().origin->longitude, -(11.0 + 31.0 / 60.0));
  EXPECT_EQ(reader.summary().rows, 3);
  EXPECT_EQ(reader.summary().missed, 1);
  EXPECT_EQ(reader.summary().first_time, 764426119.0);  // 1994-03-23 12:35:19
  EXPECT_EQ(reader.summary().last_time, 764426121.5);
  ScanReader positions(
      folder
          .write("gga.txt", sentence("GPGGA,235959,4807.038,S,01131.000,E,2,08,0.9,5.4,M,,M,,") +
                                sentence("GPGGA,000000,,,,,0,00,,,M,,M,,") +
                                sentence("GPGGA,000001,4807.038,S,01131.000,E,1,08,,,M,,M,,"))
          .string());
  EXPECT_LT(positions.summary().origin->latitude, -48.0);
  EXPECT_EQ(positions.summary().last_time - positions.summary().first_time, 2.0);
  EXPECT_EQ(positions.summary().missed, 1);
  const auto read = [](const auto& path) { ScanReader all(path.string()); };
  std::string damaged = log;
  damaged.replace(damaged.rfind("4807.038"), 8, "4817.038");
  EXPECT_THAT(message_of(damaged, read), HasSubstr("in.csv:6:1: error: 'a sentence with the "
                                                   "checksum"));
  EXPECT_THAT(message_of("!AIVDM,1,1,,A,13HOI:0P0000VOHLCnHQKwvL05Ip,0*23\n", read),
              HasSubstr("gpsdecode"));
}

// Property: places of two zones of a grid are in no common plane; bands of one zone are.
TEST(ScanReader, RefusesPlacesOfTwoZones) {
  const auto rows = [](const char* first, const char* second) {
    return std::string("t,easting,northing,zone\n0,1,2,") + first + "\n1,3,4," + second + "\n";
  };
  for (const auto& [first, second] : {std::pair("32", "32"), std::pair("32V", "32U"),
                                      std::pair("32V", "32"), std::pair("09 N", "9N")}) {
    EXPECT_EQ(scans_of(rows(first, second)), "0/0: 1,2; 1/0: 3,4; ") << first << second;
  }
  for (const auto& [first, second] : {std::pair("32V", "33V"), std::pair("32", "33"),
                                      std::pair("32M", "32N"), std::pair("32S", "32N")}) {
    EXPECT_THAT(
        message_of(rows(first, second), [](const auto& path) { ScanReader reader(path.string()); }),
        HasSubstr(":3:7: error: '" + std::string(second) +
                  "' in column 'zone' is not the zone of line 2, '" + first + "'"));
  }
}

// Property: what is measured in microseconds and taken for seconds is remarked upon, with a way out
// that works; seconds are not.
TEST(ScanReader, DoubtsTimesWithoutAUnit) {
  const auto understood = [](const std::string& content, const ReadOptions& options = {}) {
    const ScratchFolder folder;
    return ScanReader(folder.write("in.csv", content).string(), options).summary().understood;
  };
  const std::string boot = "timestamp,x,y\n60000000,1,2\n60200000,1,2\n60400000,1,2\n";
  EXPECT_THAT(understood(boot),
              HasSubstr("200000 s from row to row: if 'timestamp' is in another "
                        "unit, such as µs, say so by --columns 't=timestamp[us]'"));
  EXPECT_THAT(understood(boot, {.columns = "t=timestamp[us]"}), Not(HasSubstr("another unit")));
  EXPECT_THAT(understood("t,x,y\n0,1,2\n33,1,2\n67,1,2\n"), HasSubstr("such as ms"));
  for (const char* sound : {"t,x,y\n0,1,2\n1,1,2\n2,1,2\n", "t (s),x,y\n0,1,2\n60,1,2\n120,1,2\n",
                            "t,x,y\n1700000000,1,2\n1700003600,1,2\n1700007200,1,2\n"}) {
    EXPECT_THAT(understood(sound), Not(HasSubstr("another unit"))) << sound;
  }
}

// Derived: 13/1 can only have the day first, 1/13 only the month; the first row decides for all.
TEST(ScanReader, TakesTheOrderOfDatesFromTheFirst) {
  EXPECT_EQ(scans_of("t,x,y\n13/01/1970,1,2\n14/01/1970,3,4\n"),
            "1.0368e+06/0: 1,2; 1.1232e+06/0: 3,4; ");
  EXPECT_EQ(scans_of("t,x,y\n01/13/1970,1,2\n01/14/1970,3,4\n"),
            "1.0368e+06/0: 1,2; 1.1232e+06/0: 3,4; ");
}

// Property: degrees, minutes and seconds, whole numbers of 1e-7 degrees, and the semicircles of
// FIT, 2^31 to 180°, are the same places; that a ship does not know where it is, is no place.
TEST(ScanReader, ReadsDegreesInEveryForm) {
  const auto last = [](const std::string& first, const std::string& second,
                       const std::string& columns = "lat,lon") {
    const ScratchFolder folder;
    ScanReader reader(
        folder.write("in.csv", "t," + columns + "\n0," + first + "\n1," + second + "\n").string());
    Scan scan;
    reader.next(scan);
    reader.next(scan);
    return scan.detections.empty() ? Eigen::Vector2d(-1.0, -1.0) : scan.detections[0].position;
  };
  const Eigen::Vector2d expected = last("49.5,8.25", "49.501,8.251");
  EXPECT_TRUE(last("49°30'00\"N,8°15'00\"E", "49°30'3.6\"N,8°15'3.6\"E").isApprox(expected, 1e-9));
  EXPECT_TRUE(last("49°30.000'N,8°15.000'E", "49°30.060'N,8°15.060'E").isApprox(expected, 1e-9));
  EXPECT_TRUE(last("495000000,82500000", "495010000,82510000").isApprox(expected, 1e-9));
  const Eigen::Vector2d fit =
      last("590558003,98426334", "590569934,98438264", "position_lat,position_long");
  EXPECT_TRUE(fit.isApprox(expected, 1e-3)) << fit.transpose();  // a semicircle is 9 mm
  EXPECT_EQ(last("49.5,8.25", "49.501,8.251", "Breite,Länge"), expected);
  EXPECT_EQ(last("\"49.5,8.25\"", "\"49.501, 8.251\"", "Position"), expected);
  EXPECT_EQ(last("POINT (8.25 49.5)", "POINT(8.251 49.501)", "geometry"), expected);
  EXPECT_THAT(message_of("t,Position\n0,\"49.5,8.25\"\n1,here\n",
                         [](const auto& path) { ScanReader reader(path.string()); }),
              HasSubstr("'here' in column 'Position' is not a latitude and a longitude"));
  EXPECT_EQ(last("\"[49.5, 8.25]\"", "\"[49.501, 8.251]\"", "latlng"), expected);
  EXPECT_TRUE(last("0.86393797973719,0.14398966328953", "0.86395543302971,0.14400711658205",
                   "lat (rad),lon (rad)")
                  .isApprox(expected, 1e-6));
  for (const char* nowhere : {"91,181", "91,0", "0,181"}) {
    EXPECT_EQ(last("49.5,8.25", nowhere), Eigen::Vector2d(-1.0, -1.0));
  }
  const Eigen::Vector2d south = last("-49.5,-8.25", "-49.501,-8.251");
  EXPECT_EQ(last("49.5,S,8.25,W", "49.501,S,8.251,W", "lat,ns,lon,ew"), south);
  EXPECT_EQ(last("49.5,S,8.25,W", "49.501,S,8.251,W", "Latitude,N/S,Longitude,E/W"), south);
  EXPECT_EQ(last("49.5,N,8.25,E", "49.501,N,8.251,E", "lat,ns,lon,ew"), expected);
  // Degrees and minutes in one number, by the heading, the digits, or their size.
  EXPECT_TRUE(last("4930.000,N,00815.000,E", "4930.060,N,00815.060,E", "lat,ns,lon,ew")
                  .isApprox(expected, 1e-9));
  EXPECT_TRUE(last("4930.000,N,815.000,E", "4930.060,N,815.060,E", "lat,ns,lon,ew")
                  .isApprox(expected, 1e-9));
  EXPECT_TRUE(last("4930.000,815.000", "4930.060,815.060", "lat (ddmm.mmmm),lon (dddmm.mmmm)")
                  .isApprox(expected, 1e-9));
  EXPECT_EQ(last("0030.000,N,00015.000,E", "0030.060,N,00015.060,E", "lat,ns,lon,ew"),
            last("0.5,0.25", "0.501,0.251"));
  EXPECT_THAT(message_of("t,lat,ns,lon,ew\n0,4930.0,N,00815.0,E\n1,4960.0,N,00815.0,E\n",
                         [](const auto& path) { ScanReader reader(path.string()); }),
              HasSubstr("'4960.0' in column 'lat' is not degrees and minutes as ddmm.mmmm"));
  EXPECT_EQ(last("49.5S,8.25W", "49.501S,8.251W", "LATITUDE N/S,LONGITUDE E/W"), south);
  EXPECT_THAT(message_of("t,lat,ns,lon,ew\n0,49.5,N,8.25,E\n1,49.5,?,8.25,E\n",
                         [](const auto& path) { ScanReader reader(path.string()); }),
              HasSubstr("'?' in column 'ns' is not N or S"));
  EXPECT_THAT(message_of("t,lat,lon\n0,49°30'E,8°15'E\n",
                         [](const auto& path) { ScanReader reader(path.string()); }),
              HasSubstr("'49°30'E' in column 'lat' is not a number of degrees"));
}

// Property: any order of the rows gives the same scans, those of one time in the order of the file.
TEST(ScanReader, SortsStably) {
  std::vector<std::string> rows;
  for (int i = 0; i < 500; ++i) {
    rows.push_back(std::to_string(i / 3) + "," + std::to_string(i) + ",0\n");
  }
  std::string sorted = "t,x,y\n";
  for (const std::string& row : rows) sorted += row;
  std::mt19937 random(5);
  std::vector<int> blocks(167);
  for (int i = 0; i < 167; ++i) blocks[i] = i;
  std::shuffle(blocks.begin(), blocks.end(), random);
  std::string shuffled = "t,x,y\n";
  for (const int block : blocks) {
    for (int i = 3 * block; i < std::min(500, 3 * block + 3); ++i) shuffled += rows[i];
  }
  EXPECT_EQ(scans_of(shuffled), scans_of(sorted));
}

// Derived: what the file says of its own errors is the covariance; elsewhere it is zero.
TEST(ScanReader, ReadsErrors) {
  const ScratchFolder folder;
  ScanReader reader(folder.write("in.csv", "t,x,y,accuracy\n0,1,2,3\n1,1,2,\n").string());
  EXPECT_TRUE(reader.summary().has_sigma);
  Scan scan;
  ASSERT_TRUE(reader.next(scan));
  EXPECT_EQ(scan.detections[0].covariance, Eigen::Matrix2d(9.0 * Eigen::Matrix2d::Identity()));
  ASSERT_TRUE(reader.next(scan));
  EXPECT_TRUE(scan.detections[0].covariance.isZero(0.0));
}

// Derived: degrees become metres around the first point.
TEST(ScanReader, TurnsDegreesIntoMetres) {
  const ScratchFolder folder;
  ScanReader reader(
      folder.write("in.csv", "timestamp,latitude,longitude\n0,50,8\n1,50.001,8\n").string());
  ASSERT_TRUE(reader.summary().origin.has_value());
  EXPECT_EQ(reader.summary().origin->latitude, 50.0);
  Scan scan;
  reader.next(scan);
  EXPECT_EQ(scan.detections[0].position, Eigen::Vector2d::Zero());
  reader.next(scan);
  EXPECT_NEAR(scan.detections[0].position.y(), 111.2, 0.1);
  EXPECT_THAT(reader.summary().understood, HasSubstr("2 rows at 2 instants over 1 s (commas)"));
}

// Derived: 2 km at 90° from x are (0, 2000); at 90° of a compass, (2000, 0). Coordinates in a plane
// come first; a negative distance is none.
TEST(ScanReader, TurnsDistancesAndBearingsIntoMetres) {
  EXPECT_EQ(scans_of("t,range (km),azimuth (deg)\n0,2,90\n1,1,180\n2,1,-90\n3,,\n4,1,360\n"),
            "0/0: 0,2000; 1/0: -1000,0; 2/0: 0,-1000; 3/0:; 4/0: 1000,0; ");
  EXPECT_EQ(scans_of("t,distance,bearing_rad\n0,2,0\n1,2,3.141592653589793\n"),
            "0/0: 2,0; 1/0: -2,0; ");
  EXPECT_EQ(scans_of("t,r,theta\n0,3,0\n1,3,270\n"), "0/0: 3,0; 1/0: 0,-3; ");
  EXPECT_EQ(scans_of("t,r,brg\n0,3,90\n1,3,0\n", {.columns = "compass=brg"}),
            "0/0: 3,0; 1/0: 0,3; ");
  EXPECT_EQ(scans_of("t,r,brg\n0,3,0\n", {.columns = "compass=brg[deg]"}), "0/0: 0,3; ");
  EXPECT_EQ(scans_of("t,range,bearing,x,y\n0,3,100,1,2\n"), "0/0: 1,2; ");
  // Places of the earth do, too, however they are written; and az is an acceleration.
  EXPECT_EQ(scans_of("t,range,bearing,location\n0,3,1,POINT (8 50)\n"), "0/0: 0,0; ");
  EXPECT_THROW(scans_of("t,distance,az\n0,3,9.81\n"), InputError);
  const auto read = [](const auto& path) { ScanReader reader(path.string()); };
  EXPECT_EQ(message_of("t,range,bearing\n0,3,1\n1,3,2\n", read),
            "in.csv:1: error: are bearings in 'bearing' degrees or radians? --columns "
            "'bearing=bearing[deg]' or 'bearing=bearing[rad]' says it");
  EXPECT_EQ(message_of("t,range,azimuth (deg)\n0,-3,1\n", read),
            "in.csv:2:3: error: '-3' in column 'range' is not a distance");
  const ScratchFolder folder;
  ScanReader reader(folder.write("in.csv", "t,range (km),azimuth (deg)\n0,2,90\n").string());
  EXPECT_THAT(reader.summary().understood,
              HasSubstr("x and y in m from distances in 'range (km)' and bearings in "
                        "'azimuth (deg)', degrees counter-clockwise from x"));
}

// Derived: ROS keeps the whole seconds of a stamp and the rest in two columns.
TEST(ScanReader, AddsNanosecondsToSeconds) {
  for (const char* header :
       {"sec,nanosec,x,y", "secs,nsecs,x,y", "header.stamp.secs,header.stamp.nsecs,x,y",
        "stamp_sec,stamp_nanosec,x,y"}) {
    EXPECT_EQ(scans_of(std::string(header) + "\n5,250000000,1,2\n5,500000000,3,4\n6,0,5,6\n"),
              "5.25/0: 1,2; 5.5/0: 3,4; 6/0: 5,6; ")
        << header;
  }
}

// Derived: runs of one experiment are told apart by the user.
TEST(ScanReader, ReadsOneOfSeveralRuns) {
  EXPECT_EQ(scans_of("Time (ms) Run #1,x (cm) Run #1,y (cm) Run #1\n500,100,200\n"),
            "0.5/0: 1,2; ");
  const auto read = [](const auto& path) { ScanReader reader(path.string()); };
  const std::string runs =
      "Time (s) Run #1,x (m) Run #1,y (m) Run #1,Time (s) Run #2,x (m) Run #2,y (m) Run #2\n"
      "0,1,2,7,3,4\n";
  EXPECT_EQ(message_of(runs, read),
            "in.csv:1: error: there are 'Run #1' and 'Run #2': choose one by a column of its own, "
            "such as --columns 't=Time (s) Run #2'");
  EXPECT_EQ(scans_of(runs, {.columns = "t=Time (s) Run #2"}), "7/0: 3,4; ");
  EXPECT_EQ(scans_of("t,x,y,x\n0,1,2,3\n", {.columns = "x=4"}), "0/0: 3,2; ");
}

// Derived: one of a thing is said in the singular.
TEST(ScanReader, SaysWhatItUnderstood) {
  const ScratchFolder folder;
  const auto said = [&](const char* text) {
    return ScanReader(folder.write("in.csv", text).string()).summary().understood;
  };
  EXPECT_THAT(said("t,x,y,sensor\n0,1,2,a\n"), HasSubstr("1 row at 1 instant over 0 s (commas)"));
  EXPECT_THAT(said("t,x,y,sensor\n0,1,2,a\n"), EndsWith("; 1 sensor"));
  EXPECT_THAT(said("t,x,y,class\n0,1,2,a\n1,NA,NA,b\n"),
              EndsWith("; 2 classes; 1 row without a position"));
}

// Property: each defect is reported with its line and column; all are listed.
TEST(ScanReader, NamesLineAndColumn) {
  const auto read = [](const auto& path) { ScanReader reader(path.string()); };
  EXPECT_EQ(message_of("t,x,y\n0,abc,2\n0,1,inf\nx,1,2\n0,1\n", read),
            "in.csv:2:3: error: 'abc' in column 'x' is not a finite number\n"
            "in.csv:3:5: error: 'inf' in column 'y' is not a finite number\n"
            "in.csv:4:1: error: 'x' in column 't' is not a finite number\n"
            "in.csv:5: error: this row has 2 fields; the header row has 3");
  EXPECT_EQ(message_of("a,b\n", read),
            "in.csv:1: error: column 't' is missing; the header row has 'a', 'b'; --columns t=NAME "
            "says which one it is, 't=NAME[ms]' in which unit\n"
            "in.csv:1: error: column 'x' is missing; the header row has 'a', 'b'; --columns x=NAME "
            "says which one it is\n"
            "in.csv:1: error: column 'y' is missing; the header row has 'a', 'b'; --columns y=NAME "
            "says which one it is");
  EXPECT_THAT(message_of("", read), StartsWith("in.csv:1: error: column 't' is missing"));
  EXPECT_THAT(message_of("frame,x,y\n0,1,2\n", read), HasSubstr("--frame-rate"));
  EXPECT_EQ(message_of("t,x,y,x\n0,1,2,3\n", read), "in.csv:1: error: column 'x' is there twice");
  EXPECT_THAT(message_of("t,lat,lon\n0,91,5\n", read), HasSubstr("no point of the earth"));
}

// Derived: two of four rows are left out, and said.
TEST(ScanReader, LeavesOutBadRowsIfAskedTo) {
  const ScratchFolder folder;
  ScanReader reader(folder.write("in.csv", "t,x,y\n0,1,2\n1,oops,2\n2,3\n3,3,4\n").string(),
                    {.columns = "", .skip_bad_rows = true});
  EXPECT_EQ(reader.summary().left_out, 2);
  EXPECT_EQ(reader.summary().rows, 2);
  ASSERT_EQ(reader.summary().remarks.size(), 2U);
  EXPECT_THAT(reader.summary().remarks[0], HasSubstr(":3:3: error: 'oops'"));
}

// Property: columns are found by name; times are sorted; tentative tracks are left out.
TEST(PointReader, FindsColumnsByName) {
  const ScratchFolder folder;
  const auto points =
      read_tracks_csv(folder.write("tracks.csv",
                                   "y,status,name,track_id,t,x\n2,confirmed,\"a, b\",7,0.2,1\n"
                                   "4,coasting,c,-3,0.1,3\n9,tentative,c,8,0.1,9\n"));
  ASSERT_EQ(points.size(), 2U);
  EXPECT_EQ(points[0].id, -3);
  EXPECT_EQ(points[0].position, Eigen::Vector2d(3.0, 4.0));
  EXPECT_EQ(points[1].id, 7);
}

// Derived: identities that are words are numbered, and keep their names.
TEST(PointReader, TakesWordsForIdentities) {
  const ScratchFolder folder;
  PointReader reader(
      folder.write("in.csv", "time,icao24,x,y\n0,a1b2,1,2\n0,3c4d,3,4\n1,a1b2,5,6\n").string(),
      PointKind::kTruth);
  EXPECT_EQ(reader.next().size(), 2U);
  EXPECT_EQ(reader.name_of(2), "3c4d");
  EXPECT_EQ(reader.next().at(0).id, 1);
}

// Property: what looks like a number at first may be the address of an aircraft.
TEST(PointReader, TakesAddressesForIdentities) {
  const ScratchFolder folder;
  PointReader reader(
      folder.write("in.csv", "t,icao24,x,y\n0,400123,0,0\n0,4e5,1,1\n0,400000,2,2\n").string(),
      PointKind::kTruth);
  EXPECT_EQ(reader.next().size(), 3U);
  EXPECT_EQ(reader.name_of(2), "4e5");
}

// Property: GeoJSON with names, nothing and several lines in a feature, and GPX with a prefix in
// capitals, are read; a point without a time is named by its line.
TEST(PointReader, ReadsEveryWayOfWritingTracks) {
  const ScratchFolder folder;
  PointReader json(folder
                       .write("in.geojson",
                              R"({"type":"FeatureCollection","features":[
                    {"type":"Feature","properties":{"name":"Smith, \"J\"","times":[0,1]},
                     "geometry":{"type":"LineString","coordinates":[[8,51],[8.1,51]]}},
                    {"type":"Feature","properties":null,"geometry":null},
                    {"type":"Feature","properties":{"times":[[0,1],[2]]},"geometry":
                     {"type":"MultiLineString","coordinates":[[[9,51],[9.1,51]],[[9.2,51]]]}}]})")
                       .string(),
                   PointKind::kTruth);
  EXPECT_EQ(json.next().size(), 2U);
  EXPECT_EQ(json.next().size(), 2U);
  EXPECT_EQ(json.next().size(), 1U);
  EXPECT_EQ(json.name_of(1), "Smith, \"J\"");
  const std::string gpx =
      "<?xml version=\"1.0\"?>\n<g:gpx xmlns:g=\"x\">\n<g:trk><g:trkseg>\n"
      "<g:trkpt lat=\"51\" lon=\"8\"><g:time>2024-06-11T09:30:15Z</g:time></g:trkpt>\n"
      "<g:trkpt lat=\"51.1\" lon=\"8\">TIME</g:trkpt>\n</g:trkseg></g:trk></g:gpx>\n";
  const auto with = [&](const std::string& time) {
    std::string text = gpx;
    text.replace(text.find("TIME"), 4, time);
    return folder.write("IN.GPX", text).string();
  };
  PointReader tracks(with("<g:time>2024-06-11T09:30:16Z</g:time>"), PointKind::kTruth);
  EXPECT_EQ(tracks.next().size(), 1U);
  EXPECT_EQ(tracks.next().size(), 1U);
  const std::string timeless = with("");
  try {
    PointReader(timeless, PointKind::kTruth);
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("IN.GPX:5:1: error: '' in column 'time'"));
  }
}

// Property: defects of identities are named.
TEST(PointReader, NamesDefectsOfIdentities) {
  const auto truth = [](const auto& path) { read_truth_csv(path); };
  EXPECT_EQ(message_of("t,truth_id,x,y\n0,1,1,2\n0,1.5,1,2\n", truth),
            "in.csv:3:3: error: '1.5' in column 'truth_id' is not a whole number");
  EXPECT_EQ(message_of("t,truth_id,x,y\n0,1,1,2\n1,1,1,2\n0,1,1,2\n", truth),
            "in.csv:4: error: id 1 is there twice at the same time; the first is in line 2");
}

}  // namespace
}  // namespace ghtrack
