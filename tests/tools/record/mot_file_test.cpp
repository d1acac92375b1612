#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "tests/tools/record/message_of.hpp"
#include "tests/tools/record/scratch_folder.hpp"
#include "tools/record/errors.hpp"
#include "tools/record/mot_file.hpp"
#include "tools/record/text_file.hpp"

namespace ghtrack {
namespace {

using ::testing::HasSubstr;

std::string detections_message(const std::string& content) {
  return message_of(content, [](const auto& path) { read_mot_file(path, MotKind::kDetections); });
}

std::string result_message(const std::string& content) {
  return message_of(content, [](const auto& path) { read_mot_file(path, MotKind::kResult); });
}

std::vector<MotRow> rows_of(const std::string& content, MotKind kind) {
  const ScratchFolder folder;
  return read_mot_file(folder.write("in.csv", content), kind);
}

// Derived: the rows as they are written.
TEST(MotFile, ReadsRowsInAnyOrderOfFrames) {
  const auto rows = rows_of(
      "69,-1,912.8,482.9,97.6,112.6,1\n3,-1,835.8,472.2,53.7,77,0.5\n"
      "69,-1,1,2,3,4,-0.25\n",
      MotKind::kDetections);
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[0].frame, 3);
  EXPECT_EQ(rows[0].height, 77.0);
  EXPECT_EQ(rows[1].left, 912.8);
  EXPECT_EQ(rows[2].confidence, -0.25);
}

/// Frames in which boxes come and go, in the order of frames or of identities.
std::string rows_by(bool frames) {
  std::string text;
  const auto add = [&](int frame, int id) {
    if ((frame + id) % 4 == 0) return;
    append_mot_row(text, {.frame = frame, .id = id, .width = 3.0 + id, .height = 1.0 * frame});
  };
  for (int i = 1; i <= 50; ++i) {
    for (int k = 1; k <= 50; ++k) frames ? add(i, k) : add(k, i);
  }
  return text;
}

// Property: frame by frame come the same rows whatever the order of the file, again after rewind().
TEST(MotFile, ComesFrameByFrameInAnyOrder) {
  const ScratchFolder folder;
  MotReader ordered(folder.write("ordered.txt", rows_by(true)), MotKind::kResult);
  MotReader other(folder.write("other.txt", rows_by(false)), MotKind::kResult);
  EXPECT_TRUE(ordered.in_order());
  EXPECT_FALSE(other.in_order());
  for (int pass = 0; pass < 2; ++pass) {
    std::int64_t rows = 0;
    for (int frame = 1; frame <= 50; ++frame) {
      const auto now = ordered.next();
      const auto same = other.next();
      ASSERT_EQ(now.size(), same.size());
      for (std::size_t i = 0; i < now.size(); ++i) {
        EXPECT_EQ(now[i].frame, frame);
        EXPECT_EQ(same[i].frame, frame);
        EXPECT_EQ(now[i].id, same[i].id);
        EXPECT_EQ(now[i].height, same[i].height);
      }
      rows += static_cast<std::int64_t>(now.size());
    }
    EXPECT_TRUE(ordered.next().empty());
    EXPECT_TRUE(other.next().empty());
    EXPECT_EQ(rows, ordered.rows());
    ordered.rewind();
    other.rewind();
  }
}

// Property: the dialects of the format say the same.
TEST(MotFile, ReadsEveryDialectAlike) {
  for (const std::string text :
       {"1,2,-15,20.5,30,40,1,-1,-1,-1\n", "1, 2, -15, 20.5, 30, 40, 1, -1, -1, -1\r\n",
        "1\t2\t-15\t20.5\t30\t40\t1\t-1\t-1\t-1", "1.0,2,-1.5e1,+2.05E+1,3e1,4e1,1e0,-1,-1,-1",
        "\xef\xbb\xbf"
        "1,2,-15,20.5,30,40,1\n\n",
        "1,2,-15,20.5,30,40", "1,\"2\",-15,20.5,30,40,1"}) {
    SCOPED_TRACE(text);
    const auto rows = rows_of(text, MotKind::kResult);
    ASSERT_EQ(rows.size(), 1U);
    EXPECT_EQ(rows[0].frame, 1);
    EXPECT_EQ(rows[0].id, 2);
    EXPECT_EQ(rows[0].left, -15.0);
    EXPECT_EQ(rows[0].top, 20.5);
    EXPECT_EQ(rows[0].width, 30.0);
    EXPECT_EQ(rows[0].height, 40.0);
    EXPECT_EQ(rows[0].confidence, 1.0);
  }
}

// Property: a table with names says the same in every order and shape, among other columns.
TEST(MotFile, ReadsNamedColumns) {
  const ScratchFolder folder;
  for (const char* text :
       {"frame,id,left,top,width,height,conf\n1,7,10,20,30,40,0.5\n2,7,11,20,30,40,0.5\n",
        "frame_id,class,confidence,x1,y1,x2,y2,track_id\n1,car,0.5,10,20,40,60,7\n"
        "2,car,0.5,11,20,41,60,7\n",
        "x_min,y_min,x_max,y_max,class_id,confidence,tracker_id,frame_index\n"
        "10,20,40,60,0,0.5,7,0\n11,20,41,60,0,0.5,7,1\n",
        "Frame,TrackId,xCenter,yCenter,Width,Height,Score\n1,7,25,40,30,40,0.5\n"
        "2,7,26,40,30,40,0.5\n",
        "# of a detector\nframe;id;left;top;width;height;conf\n1;7;10;20,0;30;40;0,5\n1;;;;;;\n"
        "frame;id;left;top;width;height;conf\n2;7;11;20,0;30;40;0,5\n",
        "frame,id,x,y,width,height,score,xVelocity,yVelocity,a,b,c\n0,7,10,20,30,40,.5,1,2,3,4,5\n"
        "1,7,11,20,30,40,.5,1,2,3,4,5\n"}) {
    const auto path = folder.write("boxes.csv", text);
    EXPECT_TRUE(looks_like_mot_file(path)) << text;
    MotReader reader(path, MotKind::kResult);
    for (const std::int32_t frame : {1, 2}) {
      const auto rows = reader.next();
      ASSERT_EQ(rows.size(), 1U) << text;
      EXPECT_EQ(rows[0].frame, frame) << text;
      EXPECT_EQ(rows[0].id, 7) << text;
      EXPECT_EQ(rows[0].left, 9.0 + frame) << text;
      EXPECT_EQ(rows[0].top, 20.0) << text;
      EXPECT_EQ(rows[0].width, 30.0) << text;
      EXPECT_EQ(rows[0].height, 40.0) << text;
      EXPECT_EQ(rows[0].confidence, 0.5) << text;
    }
    EXPECT_TRUE(reader.next().empty()) << text;
  }
  EXPECT_FALSE(
      looks_like_mot_file(folder.write("a.csv", "t,x,y,width,height,note\n0,1,2,3,4,5\n")));
  try {
    MotReader(
        folder.write("b.csv", "frame,x1,y1,x2,y2\n0,1,2,3\n0,1,2,no,4\n-1,1,2,3,4\n1,3,2,1,4\n"),
        MotKind::kDetections);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(),
                HasSubstr("b.csv:2: error: this row has 4 fields; the header row has 5"));
    EXPECT_THAT(error.what(), HasSubstr("b.csv:3: error: 'no' in field 4 is not a finite number"));
    EXPECT_THAT(error.what(), HasSubstr("b.csv:4: error: frame '-1' is not a whole number from 0"));
    EXPECT_THAT(error.what(),
                HasSubstr("b.csv:5: error: width '-2' and height '2' must be above 0"));
  }
}

// Property: each defect is reported with its line and what is allowed.
TEST(MotFile, NamesLineAndReason) {
  EXPECT_EQ(detections_message("1,-1,1,2,3,4,1\n2,-1,nan,2,3,4,1\n"),
            "in.csv:2: error: 'nan' in field 3 (left) is not a finite number");
  EXPECT_EQ(detections_message("1,-1,1,2,3,1e999,1\n"),
            "in.csv:1: error: '1e999' in field 6 (height) is not a finite number");
  EXPECT_EQ(detections_message("1,-1,10,20\n"),
            "in.csv:1: error: 4 fields; a row has frame,id,left,top,width,height and up to 10 "
            "fields in all");
  EXPECT_EQ(detections_message("0,-1,10,20,3,4,1\n"),
            "in.csv:1: error: frame '0' is not a whole number from 1 to 2147483647");
  EXPECT_EQ(detections_message("1.5,-1,10,20,3,4,1\n"),
            "in.csv:1: error: frame '1.5' is not a whole number from 1 to 2147483647");
  EXPECT_EQ(detections_message("1,-1,10,20,-30,4,1\n"),
            "in.csv:1: error: width '-30' and height '4' must be above 0");
  EXPECT_EQ(detections_message("1,0.5,10,20,3,4,1\n"),
            "in.csv:1: error: id '0.5' is not a whole number");
  EXPECT_EQ(detections_message("1,-1,\xe9,20,3,4,1\n"),
            "in.csv:1: error: this is no text: a control character, or a byte that is not UTF-8");
  EXPECT_EQ(detections_message("frame,id,x\n"),
            "in.csv:1: error: 3 fields; a row has frame,id,left,top,width,height and up to 10 "
            "fields in all");
  EXPECT_EQ(result_message("1,1,1,2,3,4\n2,1,1,2,3,4\n1,1,5,6,7,8\n"),
            "in.csv:3: error: id 1 is there twice in frame 1; the first is in line 1");
  EXPECT_EQ(detections_message("1,1,1,2,3,4\n1,1,5,6,7,8\n"), "accepted");
  EXPECT_EQ(detections_message(""), "accepted");
}

// Property: all defects are listed, but not without end.
TEST(MotFile, ListsManyDefectsAndStops) {
  EXPECT_EQ(detections_message("0,-1,1,2,3,4\nx,-1,1,2,3,4\n1,-1,1,2,3,4\n1,2\n"),
            "in.csv:1: error: frame '0' is not a whole number from 1 to 2147483647\n"
            "in.csv:2: error: 'x' in field 1 (frame) is not a finite number\n"
            "in.csv:4: error: 2 fields; a row has frame,id,left,top,width,height and up to 10 "
            "fields in all");
  std::string bad;
  for (int i = 0; i < 1000; ++i) bad += "1,2\n";
  const std::string message = detections_message(bad);
  EXPECT_EQ(std::count(message.begin(), message.end(), '\n'), 10);
  EXPECT_THAT(message, HasSubstr("reading stopped"));
}

// Property: what a message repeats from a file is short and carries no raw control characters.
TEST(MotFile, KeepsMessagesReadable) {
  const std::string message =
      detections_message("1,-1," + std::string(5000, 'y') + "\xc2\x9b,2,3,4\n");
  EXPECT_LT(message.size(), 150U);
  EXPECT_EQ(detections_message(std::string(70000, ',')),
            "in.csv:1: error: this line is longer than 64 KiB");
}

// Derived: 9 columns are ground truth with classes.
TEST(MotFile, ReadsClassesOfTruth) {
  const auto rows =
      rows_of("1,1,1,2,3,4,1,1,0.5\n1,2,1,2,3,4,1,7,1\n1,3,1,2,3,4,0,1,1\n", MotKind::kTruth);
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[1].category, 7);
  EXPECT_EQ(rows[2].confidence, 0.0);
}

// Property: rows beyond the known end of the sequence are errors.
TEST(MotFile, RefusesFramesPastTheEnd) {
  const auto read = [](const auto& path) { read_mot_file(path, MotKind::kResult, 100); };
  EXPECT_EQ(message_of("1,1,1,2,3,4\n101,1,1,2,3,4\n", read),
            "in.csv:2: error: frame '101' is not a whole number from 1 to 100");
}

// Property: two decimals are those of exact rounding, at ties, near them, and anywhere else.
TEST(TextFile, AppendsTheNearestHundredths) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> anywhere(-3000.0, 3000.0);
  std::vector<double> values{0.0,   -0.0,   0.005,      0.015, 1.005, -0.004,
                             0.125, -2.375, 1e9 + 0.25, 1e17,  -1e300};
  for (int i = 0; i < 20000; ++i) {
    values.push_back(anywhere(random));
    const double tie = std::round(values.back()) + 0.125;
    values.insert(values.end(), {tie, std::nextafter(tie, 1e9), std::nextafter(tie, -1e9)});
  }
  for (const double value : values) {
    std::string text;
    append_hundredths(text, value);
    std::array<char, 400> exact{};
    std::snprintf(exact.data(), exact.size(), "%.2f", value);
    EXPECT_EQ(text, exact.data());
  }
}

// Property: rows written are rows read, to the two decimals of the format.
TEST(MotFile, ReadsWhatItWrites) {
  std::string text;
  append_mot_row(
      text, {.frame = 12, .id = 3, .left = 1.005, .top = -2.5, .width = 30.0, .height = 40.25});
  EXPECT_EQ(text, "12,3,1.00,-2.50,30.00,40.25,1,-1,-1,-1\n");
  EXPECT_EQ(rows_of(text, MotKind::kResult).at(0).height, 40.25);
}

// Property: the first character tells the formats apart.
TEST(MotFile, IsToldFromCsvByItsFirstLine) {
  const ScratchFolder folder;
  for (const char* text :
       {"1,-1,1,2,3,4\n",
        "\xef\xbb\xbf"
        "1,-1,1,2,3,4",
        "\n1, -1, 1, 2, 3, 4, 1\r\n",
        "frame,id,bb_left,bb_top,bb_width,bb_height,conf,x,y,z\n1,-1,1,2,3,4,1\n"}) {
    EXPECT_TRUE(looks_like_mot_file(folder.write("a", text))) << text;
    EXPECT_EQ(rows_of(text, MotKind::kDetections).size(), 1U) << text;
  }
  EXPECT_FALSE(looks_like_mot_file(folder.write("d", "0.5,1,2\n")));
  EXPECT_FALSE(looks_like_mot_file(folder.write("b", "t,x,y\n1,2,3\n")));
  EXPECT_FALSE(looks_like_mot_file(folder.write("c", "")));
  EXPECT_FALSE(looks_like_mot_file(folder.path()));
}

// Property: however detectors separate the numbers of a box, and whatever they leave out behind it,
// it is the same box; numbers of another kind between blanks are none.
TEST(MotFile, ReadsWhatDetectorsWrite) {
  const ScratchFolder folder;
  for (const char* text :
       {"1,-1,10,20,30,40\n", "1,-1,10,20,30,40,\n", "1,-1,10,20,30,40,1,-1,-1,-1,\n",
        "1,-1,10,20,30,40,,,,\n", "1 -1 10 20 30 40\n", "1 -1 10 20 30 40 1\n",
        "1  -1  10  20  30  40  1  -1 -1 -1 \r\n", "1\t-1\t10\t20\t30\t40\n",
        "1;-1;10;20;30;40;1\n"}) {
    SCOPED_TRACE(text);
    EXPECT_TRUE(looks_like_mot_file(folder.write("a", text)));
    const auto rows = rows_of(text, MotKind::kDetections);
    ASSERT_EQ(rows.size(), 1U);
    EXPECT_EQ(rows[0].left, 10.0);
    EXPECT_EQ(rows[0].height, 40.0);
    EXPECT_EQ(rows[0].confidence, 1.0);
  }
  for (const char* text : {"1305031098.6659 1.5 2.5 1.6 0 0 0 1\n", "0 0.5 0.5 0.05 0.1 0.9\n",
                           "0 100 200 140 290 0 0 0 0 \"Pedestrian\"\n", "1 2 3 4 5\n"}) {
    EXPECT_FALSE(looks_like_mot_file(folder.write("a", text))) << text;
  }
}

// Derived: the file as the format's instructions show it.
TEST(SequenceInfo, ReadsTheSequenceSection) {
  const ScratchFolder folder;
  const SequenceInfo info = read_sequence_info(
      folder.write("seqinfo.ini",
                   "[Sequence]\r\nname = plaza\r\nimDir=img1\r\nframeRate=12.5\r\nseqLength=71\r\n"
                   "imWidth=640\r\nimHeight=480\r\nimExt=.jpg\r\n"));
  EXPECT_EQ(info.name, "plaza");
  EXPECT_EQ(info.frame_rate, 12.5);
  EXPECT_EQ(info.length, 71);
  EXPECT_EQ(info.width, 640);
  EXPECT_EQ(info.height, 480);
  EXPECT_EQ(message_of("[Sequence]\nseqLength=many\nframeRate=0\nodd\n",
                       [](const auto& path) { read_sequence_info(path); }),
            "in.csv:2: error: seqLength 'many' is not a whole number above 0\n"
            "in.csv:3: error: frameRate '0' is not a number above 0\n"
            "in.csv:4: error: 'odd' is not `key = value`");
}

// Property: what is no regular file is refused at once, by name.
TEST(TextFile, RefusesWhatIsNoRegularFile) {
  const ScratchFolder folder;
  const auto message = [](const std::filesystem::path& path) -> std::string {
    try {
      read_text_file(path);
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  const auto pipe = folder.path() / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_EQ(message(pipe),
            pipe.string() +
                ": error: this is no regular file; what comes through a pipe is read with '-'");
  EXPECT_EQ(
      message("/dev/zero"),
      "/dev/zero: error: this is no regular file; what comes through a pipe is read with '-'");
  EXPECT_THAT(message(folder.path()),
              HasSubstr("this is no regular file; what comes through a pipe is read with '-'"));
  EXPECT_EQ(message(folder.path() / "none"),
            (folder.path() / "none").string() + ": error: cannot read: No such file or directory");
}

// Property: numbers are decimal, finite and use the whole field.
TEST(TextFile, ParsesNumbersStrictly) {
  EXPECT_EQ(parse_number("+2.0E+1"), 20.0);
  EXPECT_EQ(parse_number("-.5"), -0.5);
  for (const char* text :
       {"", "+", "+-1", "nan", "inf", "1e999", "0x1p3", "1.5abc", "1 2", "1,5"}) {
    EXPECT_FALSE(parse_number(text).has_value()) << text;
  }
  EXPECT_EQ(parse_whole("3.0"), 3);
  EXPECT_FALSE(parse_whole("1e300").has_value());
}

// Property: the short way through a line sees what fields that are split and read one by one say,
// and leaves what it does not understand to them.
TEST(TextFile, ReadsPlainNumbersAsItReadsFields) {
  std::array<double, 4> room{};
  for (const std::string line : {"1,-2,3.25,0.1", " 7,\t008, -.5,5.",
                                 "-0,123456789012345,1234567.12345678,0.00000000000001"}) {
    std::vector<std::string_view> fields;
    std::vector<std::string> owned;
    split_fields(line, fields, owned);
    ASSERT_EQ(plain_numbers(line, room), fields.size()) << line;
    for (std::size_t i = 0; i < fields.size(); ++i) {
      EXPECT_EQ(room[i], parse_number(fields[i])) << line;
      EXPECT_EQ(std::signbit(room[i]), std::signbit(*parse_number(fields[i]))) << line;
    }
  }
  for (const char* line : {"", "1,", ",1", "1,2 ", "1;2", "1,\"2\"", "1,+2", "1,2e3", "1,nan",
                           "1,--2", "1,.", "1,-", "1,2,3,4,5", "1,1234567890123456", "1\t2"}) {
    EXPECT_EQ(plain_numbers(line, room), 0U) << line;
  }
}

}  // namespace
}  // namespace ghtrack
