#include "tools/data/table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "tests/tools/record/scratch_folder.hpp"
#include "tools/record/errors.hpp"

namespace ghtrack {
namespace {

using ::testing::HasSubstr;

// Property: a heading is a name and a unit, however they are joined.
TEST(Heading, KnowsItsUnit) {
  for (const char* text :
       {"y(mm)", "y [mm]", "Y (mm)", "\"y\" (mm)", "y / mm", "y in mm", "y_mm"}) {
    SCOPED_TRACE(text);
    const Heading heading = parse_heading(text);
    EXPECT_EQ(heading.base, "y");
    ASSERT_TRUE(heading.unit.has_value());
    EXPECT_EQ(heading.unit->scale, 1e-3);
  }
  EXPECT_EQ(parse_heading("Time (s)").base, "time");
  EXPECT_FALSE(parse_heading("sigma_x").unit.has_value());
  EXPECT_EQ(parse_heading("bb_left").base, "bb_left");
  EXPECT_EQ(parse_heading("Pos X (arb. units)").base, "pos_x");
}

/// The cells of a file as "a|b" lines.
std::string cells_of(const std::string& content) {
  const ScratchFolder folder;
  Table table(folder.write("in.csv", content).string());
  std::string text;
  while (table.next()) {
    for (std::size_t i = 0; i < table.headings().size(); ++i) {
      const auto number = table.number(i);
      text += (i > 0 ? "|" : "") +
              (number ? std::to_string(*number).substr(0, 4) : std::string(table.cell(i)));
    }
    text += "\n";
  }
  return text;
}

// Property: all dialects of one table say the same.
TEST(Table, ReadsEveryDialectAlike) {
  for (const char* text :
       {"t,x,y\n0.25,1.5,2.5\n1.25,,4.5\n", "t;x;y\n0.25;1.5;2.5\n1.25;;4.5\n",
        "t;x;y\n0,25;1,5;2,5\n1,25;;4,5\n", "t\tx\ty\n0.25\t1.5\t2.5\n1.25\t\t4.5\n",
        "t\tx\ty\r\n0,25\t1,5\t2,5\r\n1,25\t\t4,5",
        "\xef\xbb\xbft , x,y\n0.25, 1.5 ,2.5\n1.25,,4.5",
        "\"t\",\"x\",\"y\"\n\"0.25\",\"1.5\",2.5\n1.25,\"\",4.5\n",
        "# made by a logger\n% and another\n// one more\nt,x,y\n0.25,1.5,2.5\n\n# in between\n"
        "1.25,,4.5\n\n",
        "# t,x,y\n0.25,1.5,2.5\n1.25,,4.5\n", "t|x|y\n0.25|1.5|2.5\n1.25||4.5\n",
        "t,x,y\n0.25,1.5,2.5,\n1.25,,4.5,,\n"}) {
    EXPECT_EQ(cells_of(text), "0.25|1.50|2.50\n1.25||4.50\n") << text;
  }
  EXPECT_EQ(cells_of("t x  y\n0.25   1.5 2.5\n 1.25 nan 4.5\n"), "0.25|1.50|2.50\n1.25|nan|4.50\n");
}

// Derived: a single column is a series; a quoted cell may hold anything.
TEST(Table, ReadsSeriesAndQuotedCells) {
  EXPECT_EQ(cells_of("158.5\n164.2\n"), "158.\n164.\n");
  EXPECT_EQ(cells_of("z\n1,5\n2,5\n"), "1.50\n2.50\n");
  EXPECT_EQ(cells_of("name,x\n\"a, \"\"b\"\"\",2\n"), "a, \"b\"|2.00\n");
}

/// Of two rows of one column, as they are read.
std::string values_of(const std::string& first, const std::string& second) {
  const ScratchFolder folder;
  Table table(folder.write("in.csv", "t,v\n0," + first + "\n1," + second + "\n").string());
  std::string text;
  while (table.next()) {
    const auto number = table.number(1);
    text += number ? std::to_string(*number) + " " : "- ";
  }
  return text;
}

// Property: whether a comma is before decimals or between thousands, the other numbers tell; a text
// with one says nothing.
TEST(Table, TellsDecimalsFromThousands) {
  EXPECT_EQ(values_of("\"1,234\"", "999"), "1234.000000 999.000000 ");
  EXPECT_EQ(values_of("\"1,234.5\"", "\"1,235\""), "1234.500000 1235.000000 ");
  EXPECT_EQ(values_of("\"1,234,567\"", "12"), "1234567.000000 12.000000 ");
  EXPECT_EQ(values_of("\"1,234\"", "\"1,5\""), "1.234000 1.500000 ");
  EXPECT_EQ(values_of("\"0,123\"", "\"0,125\""), "0.123000 0.125000 ");
  EXPECT_EQ(values_of("\"1.234,5\"", "\"1.235,5\""), "1234.500000 1235.500000 ");
  EXPECT_EQ(values_of("\"1,2\"", "1.5"), "- 1.500000 ");
  EXPECT_EQ(cells_of("t\tv\n0\t1,234.5\n1\t12\n"), "0.00|1234\n1.00|12.0\n");
  EXPECT_EQ(cells_of("t;v;zone\n0;1,5;1.2.3\n1;1.234,5;\n"), "0.00|1.50|1.2.3\n1.00|1234|\n");
}

// Derived: R names its rows in a column that has no heading.
TEST(Table, ReadsNamesOfRows) {
  EXPECT_EQ(cells_of("\"t\" \"x\"\n\"1\" 0 5\n\"2\" 1 6\n"), "1.00|0.00|5.00\n2.00|1.00|6.00\n");
  EXPECT_EQ(cells_of("t,x\n0,5,7\n"), "");  // that is one field too many
}

// Derived: lines that end with CR alone are lines, too.
TEST(Table, ReadsLinesOfOldMacs) {
  EXPECT_EQ(cells_of("t,x\r0,5\r1,6\r"), "0.00|5.00\n1.00|6.00\n");
}

// Derived: a row of units under the header belongs to it.
TEST(Table, TakesARowOfUnits) {
  const ScratchFolder folder;
  Table table(folder.write("in.csv", "time,x,y\n(ms),(cm),(cm)\n1,2,3\n").string());
  EXPECT_EQ(table.headings()[0].unit->scale, 1e-3);
  EXPECT_EQ(table.headings()[2].unit->scale, 1e-2);
  ASSERT_TRUE(table.next());
  EXPECT_EQ(table.cell(0), "1");
}

// Property: columns are found by alias, by choice and by number.
TEST(ColumnMap, FindsColumns) {
  const auto headings = [](std::initializer_list<const char*> cells) {
    std::vector<Heading> all;
    for (const char* cell : cells) all.push_back(parse_heading(cell));
    return all;
  };
  const ColumnMap aliases(headings({"MMSI", "BaseDateTime", "LAT", "LON", "SOG"}), {});
  EXPECT_EQ(aliases.find(Role::kTime), 1U);
  EXPECT_EQ(aliases.find(Role::kLatitude), 2U);
  EXPECT_EQ(aliases.find(Role::kIdentity), 0U);
  EXPECT_FALSE(aliases.has(Role::kX));
  const auto odd = headings({"foo", "bar (mm)", "baz", "x"});
  const ColumnMap chosen(odd, parse_column_choices("t=foo, x=bar, y=3"));
  EXPECT_EQ(chosen.find(Role::kTime), 0U);
  EXPECT_EQ(chosen.find(Role::kX), 1U);
  EXPECT_EQ(chosen.find(Role::kY), 2U);
  EXPECT_THROW(ColumnMap(odd, parse_column_choices("t=fop")), ColumnError);
  EXPECT_THROW(parse_column_choices("foo"), ColumnError);
  EXPECT_THROW(parse_column_choices("q=foo"), ColumnError);
}

// Property: what cannot be read is refused at once, by name.
TEST(TextInput, RefusesWhatIsNoText) {
  const ScratchFolder folder;
  const auto message = [](const std::filesystem::path& path) -> std::string {
    try {
      Table table(path.string());
      while (table.next()) continue;
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_EQ(message("/dev/zero"), "/dev/zero: error: this is no regular file");
  EXPECT_THAT(message(folder.path()), HasSubstr("this is no regular file"));
  EXPECT_THAT(message(folder.path() / "none"), HasSubstr("No such file or directory"));
  EXPECT_THAT(message(folder.write("a", "t,x\n1,2\n3,\xe9\n")),
              HasSubstr("a:3: error: this is no text"));
  EXPECT_THAT(message(folder.write("b", std::string("t,x\n1,\0\n", 8))), HasSubstr("b:2: error"));
  EXPECT_THAT(message(folder.write("c", "t,x\n" + std::string(70000, '1') + "\n")),
              HasSubstr("c:2: error: this line is longer than 64 KiB"));
  EXPECT_THAT(message(folder.write("d", "\xff\xfet")), HasSubstr("UTF-16"));
}

// Property: lines longer than a block, and blocks that end anywhere, change nothing.
TEST(TextInput, KeepsLinesWholeAcrossBlocks) {
  std::string content = "x\n";
  for (int i = 0; i < 60000; ++i) content += std::to_string(i) + std::string(i % 37, ' ') + "\n";
  const ScratchFolder folder;
  Table table(folder.write("long.csv", content).string());
  for (int pass = 0; pass < 2; ++pass) {
    int expected = 0;
    while (table.next()) {
      ASSERT_EQ(table.number(0), expected) << table.line();
      ASSERT_EQ(table.line(), expected + 2);
      ++expected;
    }
    EXPECT_EQ(expected, 60000);
    table.rewind();
  }
}

}  // namespace
}  // namespace ghtrack
