// SPDX-License-Identifier: MIT
#include "diabolo/recording/formats/motive.hpp"

#include <fstream>

#include "catch.hpp"
#include "recording/support.hpp"

using namespace diabolo;
using test::complaint;
using test::motive_text;
using test::replaced;

namespace {

std::string motive_says(const std::string& text) {
  return complaint([&] { read_motive(text, "take.csv"); });
}

std::string motive_says_of(const std::string& from, const std::string& to) {
  return motive_says(replaced(motive_text(), from, to));
}

std::string replace_all(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
  return text;
}

}  // namespace

TEST_CASE("A Motive export is read as it stands") {
  const TrackedTake take = read_motive(motive_text(), "take.csv");
  CHECK(take.file_name == "take.csv");
  CHECK(take.rate == 120.0);
  CHECK(take.frame == std::vector<long>{40, 41, 42});
  CHECK(take.time == Eigen::Vector3d(0.333333, 0.341667, 0.35));
  REQUIRE(take.bodies.size() == 3);
  const TrackedBody &left = take.bodies[0], &diabolo = take.bodies[1];
  CHECK(left.name == "stick_left");
  CHECK(left.valid.all());
  CHECK(left.position.col(2) == Eigen::Vector3d(-0.25, 0.5, 1.02));
  CHECK(left.quaternion.col(2) == Eigen::Vector4d(0.0, 0.0, 0.0, 1.0));
  CHECK(diabolo.name == "diabolo_red");
  CHECK((diabolo.valid == (Marks(3) << true, false, true).finished()).all());
  CHECK(diabolo.position.col(1).array().isNaN().all());
  CHECK(diabolo.quaternion.col(1).array().isNaN().all());
  CHECK(diabolo.quaternion.col(2) == Eigen::Vector4d(0.6, 0.8, 0.0, 0.0));
  REQUIRE(take.markers.size() == 1);
  CHECK(take.markers[0].name == "diabolo_red:Marker1");
  CHECK(take.markers[0].measured);
  CHECK((take.markers[0].valid == (Marks(3) << true, false, true).finished()).all());
  CHECK(take.markers[0].position.col(2) == Eigen::Vector3d(0.1, 0.2, 0.35));
}

TEST_CASE("CRLF, a byte order mark, blank lines at the end and padding from a spreadsheet change nothing") {
  const TrackedTake plain = read_motive(motive_text(), "take.csv");
  const std::string padded = replaced(motive_text(), "Global\n\n", "Global,,,\n,,,\n");
  for (const std::string& text : {replace_all(motive_text(), "\n", "\r\n"), "\xef\xbb\xbf" + motive_text(),
                                  motive_text() + "\n\n", padded}) {
    const TrackedTake take = read_motive(text, "take.csv");
    CHECK(take.time == plain.time);
    CHECK(take.bodies[0].position == plain.bodies[0].position);
    CHECK(take.bodies[2].quaternion == plain.bodies[2].quaternion);
  }
}

TEST_CASE("Centimetres and millimetres become metres") {
  const auto height = [](const std::string& units) {
    return read_motive(replaced(motive_text(), "Meters", units), "take.csv").bodies[0].position(2, 1);
  };
  CHECK(height("Meters") == 1.01);
  CHECK(height("Centimeters") == 1.01 / 100.0);
  CHECK(height("Millimeters") == 1.01 / 1000.0);
}

TEST_CASE("Error and quality columns are skipped, whatever they are called") {
  std::string text = motive_text();
  text = replaced(text, "Marker,Marker,Marker\n", "Marker,Marker,Marker,Rigid Body,Rigid Body Marker,Bone\n");
  text =
      replaced(text, "diabolo_red:Marker1\n", "diabolo_red:Marker1,stick_left,\"stick_left:Marker1\",arm\n");
  text = replaced(text, "\"D4\"\n", "\"D4\",A1,A1,A1\n");
  text = replaced(text, "Position,Position\nFrame", "Position,Position,Error,Marker Quality,Rotation\nFrame");
  text = replaced(text, "X,Y,Z\n40", "X,Y,Z,,,X\n40");
  text = replaced(text, ",0.1,0.2,0.3\n", ",0.1,0.2,0.3,0.0001,1.000,2\n");
  text = replaced(text, ",,,\n42", ",,,,,\n42");
  text = replaced(text, "0.99,,,,,\n", "0.99,,,,,,\n");
  text = replaced(text, "0.1,0.2,0.35\n", "0.1,0.2,0.35,0.0001,1.000,2\n");
  const TrackedTake take = read_motive(text, "take.csv");
  CHECK(take.bodies.size() == 3);
  CHECK(take.markers.size() == 1);
}

TEST_CASE("Solved and measured markers of one name are told apart") {
  std::string text = replaced(motive_text(), "Marker,Marker,Marker\n",
                              "Marker,Marker,Marker,Rigid Body Marker,Rigid Body Marker,Rigid Body Marker\n");
  text = replaced(text, "diabolo_red:Marker1\n",
                  "diabolo_red:Marker1,diabolo_red:Marker1,diabolo_red:Marker1,diabolo_red:Marker1\n");
  text = replaced(text, "\"D4\"\n", "\"D4\",B2,B2,B2\n");
  text = replaced(text, "Position,Position\nFrame", "Position,Position,Position,Position,Position\nFrame");
  text = replaced(text, "X,Y,Z\n40", "X,Y,Z,X,Y,Z\n40");
  text = replaced(text, ",0.1,0.2,0.3\n", ",0.1,0.2,0.3,1,2,3\n");
  text = replaced(text, ",,,\n42", ",,,,1,2,3\n42");
  text = replaced(text, "0.1,0.2,0.35\n", "0.1,0.2,0.35,1,2,3\n");
  const TrackedTake take = read_motive(text, "take.csv");
  REQUIRE(take.markers.size() == 2);
  CHECK(take.markers[0].measured);
  CHECK(!take.markers[1].measured);
  CHECK(take.markers[1].valid.all());
  CHECK(take.markers[1].position.col(0) == Eigen::Vector3d(1.0, 2.0, 3.0));
}

TEST_CASE("Rounded quaternions are normalised, wrong ones refused") {
  const TrackedTake take =
      read_motive(replaced(motive_text(), ",0.6,0.8,0,0,", ",0.6,0.8004,0,0,"), "take.csv");
  CHECK(take.bodies[1].quaternion.col(2).norm() == Approx(1.0).epsilon(1e-15));
  CHECK(motive_says_of(",0.6,0.8,0,0,", ",0.3,0.4,0,0,") ==
        "take.csv, line 10: \"diabolo_red\": quaternion of norm 0.5; expected 1 within 0.001");
  CHECK(motive_says_of(",0.6,0.8,0,0,", ",0,0,0,0,") ==
        "take.csv, line 10: \"diabolo_red\": quaternion of norm 0; expected 1 within 0.001");
  CHECK(motive_says_of(",0.6,0.8,0,0,", ",1e300,0,0,0,") ==
        "take.csv, line 10: \"diabolo_red\": quaternion of norm inf; expected 1 within 0.001");
}

TEST_CASE("What is no Motive export is refused") {
  CHECK(motive_says("") == "take.csv: the file is empty");
  CHECK(motive_says("time,left_x\n") ==
        "take.csv, line 1: starts with \"time\"; expected \"Format Version\", as Motive exports it");
  CHECK(motive_says("\n") ==
        "take.csv, line 1: starts with \"\"; expected \"Format Version\", as Motive exports it");
  CHECK(motive_says("\xff\xfe" + motive_text()) == "take.csv: the text is UTF-16; expected UTF-8");
  CHECK(motive_says(replace_all(motive_text(), "\n", "\r")) ==
        "take.csv: lines end with CR only (old Mac); expected LF or CRLF");
}

TEST_CASE("Other units, rotations and spaces are refused") {
  CHECK(motive_says_of("Meters", "Inches") ==
        "take.csv, line 1: \"Length Units\" is \"Inches\"; expected Meters, Centimeters or Millimeters");
  CHECK(motive_says_of("Rotation Type,Quaternion", "Rotation Type,XYZ") ==
        "take.csv, line 1: \"Rotation Type\" is \"XYZ\"; expected \"Quaternion\"");
  CHECK(motive_says_of("Coordinate Space,Global", "Coordinate Space,Local") ==
        "take.csv, line 1: \"Coordinate Space\" is \"Local\"; expected \"Global\"");
  CHECK(motive_says_of("Length Units,Meters,", "") ==
        "take.csv, line 1: \"Length Units\" is missing; expected it with a value, as Motive exports it");
  CHECK(motive_says_of("Export Frame Rate,120.000000", "Export Frame Rate,fast") ==
        "take.csv, line 1: \"Export Frame Rate\" is \"fast\"; expected a number");
  CHECK(motive_says_of("Export Frame Rate,120.000000", "Export Frame Rate,0") ==
        "take.csv: rate 0 Hz; expected more than 0, at most 1e6");
  CHECK(motive_says_of("Export Frame Rate,120.000000", "Export Frame Rate,60")
            .starts_with("take.csv: rate 60 Hz, but the times step by 0.0083"));
  CHECK(motive_says_of("-0.25,0.5,1.02", "-250,500,1020") ==
        "take.csv, line 10: \"stick_left\": position -250 m; expected within 100 m (other units?)");
}

TEST_CASE("Of a file that is cut off the whole lines are read, with one note") {
  const std::string text = motive_text();
  const std::size_t first = text.find("40,"), second = text.find("41,");
  for (std::size_t length = 0; length < text.size(); ++length) {
    INFO("cut off after " << length << " bytes");
    const std::string part = text.substr(0, length);
    if (length < second) {
      CHECK(motive_says(part).starts_with("take.csv"));
      continue;
    }
    const TrackedTake take = read_motive(part, "take.csv");
    const long lines = std::count(part.begin() + static_cast<std::ptrdiff_t>(first), part.end(), '\n');
    CHECK(take.frame.size() == static_cast<std::size_t>(lines));
    CHECK(take.time.size() == lines);
    CHECK(take.bodies[0].position.cols() == lines);
    CHECK(take.notes == std::vector<std::string>{"of the 3 exported frames that line 1 tells of, " +
                                                 std::to_string(lines) + " are there: the file is cut off"});
  }
  CHECK(read_motive(text, "take.csv").notes.empty());
  CHECK(read_motive(replaced(text, "Frames,3,", "Frames,2,").substr(0, text.size() - 1), "take.csv").notes ==
        std::vector<std::string>{kCutLineNote});
  CHECK(motive_says_of("Frames,3,", "Frames,2,") ==
        "take.csv: 3 lines of data, but line 1 says 2 exported frames; expected no more than it says");
  CHECK(motive_says(text.substr(0, text.find("40,"))) ==
        "take.csv, line 7: the file ends here; expected at least one line of data");
  CHECK(motive_says(text.substr(0, text.find(",,\"A1\""))) ==
        "take.csv, line 4: the file ends here; expected the line of identifiers next");
}

TEST_CASE("headers of Motive that do not fit are refused") {
  CHECK(motive_says_of("Global\n\n", "Global\n") ==
        "take.csv, line 2: starts with \"Rigid Body\"; expected a blank line below the take");
  CHECK(motive_says_of("Frame,Time", "Time,Frame")
            .starts_with("take.csv, line 7: starts with \"Time\"; expected \"Frame,"));
  CHECK(motive_says_of(",Marker,Marker,Marker\n", ",Marker,Marker\n") ==
        "take.csv, line 7: 26 columns, but the four lines above have 25, 26, 26 and 26; expected as many");
  CHECK(motive_says_of("Rotation,Position,Position,Position", "Rotation,Position,Position,Rotation") ==
        "take.csv, line 7: column 9: \"stick_left\" has this component in column 5 already; expected every "
        "body and "
        "marker once");
  CHECK(motive_says_of("X,Y,Z,W", "X,Y,Z,V") ==
        "take.csv, line 7: column 6: \"Rotation\" \"V\"; expected an axis of it");
  CHECK(motive_says_of("X,Y,Z\n", "X,Y,W\n") ==
        "take.csv, line 7: column 26: \"Position\" \"W\"; expected an axis of it");
  CHECK(motive_says_of(",,stick_left,", ",,,") ==
        "take.csv, line 7: column 3: no name in the second line below the blank one");
  CHECK(motive_says_of(",,stick_left,", ",,other,") ==
        "take.csv, line 7: \"other\" has no column Rotation Y");
  CHECK(motive_says_of("Position,Position\nFrame", "Position,Quality\nFrame") ==
        "take.csv, line 7: \"diabolo_red:Marker1\" has no column Position Z");
}

TEST_CASE("A body that is there twice is refused") {
  CHECK(motive_says(replace_all(motive_text(), "stick_right", "stick_left")) ==
        "take.csv, line 7: column 17: \"stick_left\" has this component in column 3 already; expected every "
        "body and "
        "marker once");
}

TEST_CASE("rows of Motive that do not fit are refused") {
  CHECK(motive_says_of("0.1,0.2,0.3\n", "0.1,0.2\n") ==
        "take.csv, line 8: 25 cells; expected 26, as in the header");
  CHECK(motive_says_of("0.1,0.2,0.3\n", "0.1,0.2,0.3,0.4\n") ==
        "take.csv, line 8: 27 cells; expected 26, as in the header");
  CHECK(motive_says_of("\n41,", "\n\n41,") == "take.csv, line 9: an empty line; expected a row of the table");
  CHECK(motive_says_of("-0.25,0.5,1.02", "-0.25,,1.02") ==
        "take.csv, line 10: \"stick_left\": 1 of its 3 position cells are empty; expected none, or all in a "
        "dropout");
  CHECK(
      motive_says_of("-0.25,0.5,1.02", ",,") ==
      "take.csv, line 10: \"stick_left\": some of its 7 cells are empty; expected none, or all in a dropout");
  CHECK(motive_says_of(",0.6,0.8,0,0,", ",0.6,0.8,,0,") ==
        "take.csv, line 10: \"diabolo_red\": some of its 7 cells are empty; expected none, or all in a "
        "dropout");
  CHECK(motive_says_of(",0.6,0.8,0,0,", ",nan,0.8,0,0,") ==
        "take.csv, line 10: column 10: \"nan\"; expected a finite number or an empty cell");
  CHECK(motive_says_of("-0.25,0.5,1.02", "-0.25,1e999,1.02") ==
        "take.csv, line 10: column 8: \"1e999\"; expected a finite number or an empty cell");
  CHECK(motive_says_of("-0.25,0.5,1.02", "-0.25,1e300,1.02") ==
        "take.csv, line 10: \"stick_left\": position 1e+300 m; expected within 100 m (other units?)");
}

TEST_CASE("Frames and times have to increase") {
  CHECK(motive_says_of("\n42,", "\n41,") == "take.csv, line 10: frame 41 does not come after frame 41");
  CHECK(motive_says_of("42,0.350000", "42,0.341667") ==
        "take.csv, line 10: time 0.341667 s does not come after 0.341667 s");
  CHECK(motive_says_of("\n42,", "\n42.5,") == "take.csv, line 10: frame 42.5; expected a whole number");
  CHECK(motive_says_of("\n42,", "\n,") == "take.csv, line 10: frame nan; expected a whole number");
  CHECK(motive_says_of("\n42,", "\n1e300,") == "take.csv, line 10: frame 1e+300; expected a whole number");
  CHECK(motive_says_of("42,0.350000", "42,") ==
        "take.csv, line 10: time is empty; expected a number of seconds");
  CHECK(motive_says_of("42,0.350000", "42,1e10") ==
        "take.csv, line 10: time 1e+10 s; expected a number within 1e9 s");
}

TEST_CASE("A million columns take bounded work") {
  std::string types = ",", names = ",", kinds = ",", axes = "Frame,Time (Seconds)", cells;
  for (int marker = 0; marker < 333'333; ++marker) {
    for (const char axis : {'X', 'Y', 'Z'}) {
      types += ",Marker";
      names += ",m" + std::to_string(marker);
      kinds += ",Position";
      axes += std::string(",") + axis;
      cells += ",";
    }
  }
  const std::string header =
      "Format Version,1.22,Export Frame Rate,120,Total Exported Frames,2,Rotation Type,Quaternion,"
      "Length Units,Meters,Coordinate Space,Global\n\n" +
      types + "\n" + names + "\n" + names + "\n" + kinds + "\n" + axes + "\n";
  const TrackedTake take = read_motive(header + "0,0" + cells + "\n1,0.008333" + cells + "\n", "take.csv");
  CHECK(take.markers.size() == 333'333);
  // As many lines without cells: the room that they would need is never asked for.
  CHECK(motive_says(header + "0,0" + cells + "\n" + std::string(1'000'000, '\n') + "1\n") ==
        "take.csv, line 9: an empty line; expected a row of the table");
}

TEST_CASE("A file is read by its path") {
  const test::TemporaryFolder folder;
  const std::filesystem::path path = folder / "take.csv";
  std::ofstream(path) << motive_text();
  CHECK(load_motive(path).frame.size() == 3);
  CHECK(complaint([&] { load_motive(folder / ""); }).ends_with("a directory; expected a file"));
}

TEST_CASE("Every published take is read") {
  const auto folder = test::recordings_folder("reading every published take");
  if (!folder) return;
  int takes = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(*folder)) {
    const std::string path = entry.path().string();
    if (entry.path().extension() != ".csv" || path.find("/processed/") != path.npos ||
        path.find("/published/") != path.npos)
      continue;
    INFO(path);
    const TrackedTake take = load_motive(path);
    ++takes;
    CHECK(!take.bodies.empty());
    CHECK(take.frame.back() - take.frame.front() + 1 == static_cast<long>(take.frame.size()));
    for (const TrackedBody& body : take.bodies) CHECK(body.valid.count() > 0);
  }
  CHECK(takes > 0);
}
