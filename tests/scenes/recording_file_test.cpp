#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <variant>

#include "scenes/schema/diagnostic.hpp"
#include "scenes/schema/reader.hpp"
#include "scenes/schema/writer.hpp"
#include "tests/tools/record/scratch_folder.hpp"

namespace ghtrack {
namespace {

/// A folder with a table, and a scene that asks for it.
class RecordingFile : public ::testing::Test {
 protected:
  Scene read(const std::string& table, const std::string& id = {}) const {
    folder_.write("walk.csv", table);
    const std::string recording = "{file: walk.csv" + (id.empty() ? "" : ", id: " + id) + "}";
    return read_scene_text("name: demo\ntargets: [{name: a, recording: " + recording +
                               "}]\nsensors: [{name: camera}]\n",
                           (folder_.path() / "scene.yaml").string());
  }

  std::string refusal(const std::string& table, const std::string& id = {}) const {
    try {
      read(table, id);
    } catch (const SceneError& error) {
      const std::string text = error.what();
      const std::string prefix = folder_.path().string() + "/";
      return text.starts_with(prefix) ? text.substr(prefix.size()) : text;
    }
    return "no error";
  }

  static const Recording& recording_of(const Scene& scene) {
    return std::get<Recording>(std::get<WorldScene>(scene).targets.at(0).motion);
  }

  ScratchFolder folder_;
};

// Property: columns are found by name, among others and in any order, in tables of any program; the
// scene that was read needs the table no more.
TEST_F(RecordingFile, IsReadByTheNamesOfItsColumns) {
  const Scene scene =
      read("\xEF\xBB\xBF\"y\", name ,time,x\r\n2,ann,0.5,1\r\n\r\n4.5, ann,1.5,-3e0\r\n");
  const Recording& recording = recording_of(scene);
  ASSERT_EQ(recording.places.size(), 2u);
  EXPECT_EQ(recording.places[1].t, 1.5);
  EXPECT_EQ(recording.places[1].x, -3.0);
  EXPECT_EQ(recording.places[1].y, 4.5);
  EXPECT_TRUE(recording.file.empty());
  std::filesystem::remove(folder_.path() / "walk.csv");
  const Scene again = read_scene_text(write_scene(scene), "elsewhere.yaml");
  EXPECT_EQ(recording_of(again).places.size(), 2u);
}

// Property: of a table with several objects one is chosen, by its number or its name.
TEST_F(RecordingFile, IsReadForOneObject) {
  const std::string table = "t,truth_id,x,y\n0,0,1,1\n0,1,5,5\n1,0,2,2\n1,1,6,6\n";
  const Scene scene = read(table, "'1'");
  ASSERT_EQ(recording_of(scene).places.size(), 2u);
  EXPECT_EQ(recording_of(scene).places[0].x, 5.0);
  EXPECT_EQ(refusal(table),
            "walk.csv:3:1: error: the time 0 is not later than that of the row before, 0; of "
            "several objects in a table, `id` chooses one");
  EXPECT_EQ(refusal(table, "'7'"), "walk.csv: error: no row has the id '7'");
}

// Property: what is wrong with a table is said with its place.
TEST_F(RecordingFile, SaysWhatIsWrongAndWhere) {
  EXPECT_EQ(refusal(""), "walk.csv: error: the table is empty");
  EXPECT_EQ(refusal("t,x,y\n"), "walk.csv: error: the table has no rows");
  EXPECT_EQ(refusal("t,x,height\n0,1,2\n"),
            "walk.csv:1:1: error: no column is called y; columns: t, x, height");
  EXPECT_EQ(refusal("t,x,y\n0,1,2\n1,nan,2\n"),
            "walk.csv:3:3: error: must be a number from -1000000 to 1000000; found 'nan'");
  EXPECT_EQ(refusal("t,x,y\n0,1\n"), "walk.csv:2:1: error: has 2 cells; the header has more");
}

}  // namespace
}  // namespace ghtrack
