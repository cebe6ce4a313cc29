// SPDX-License-Identifier: MIT
#include "diabolo/recording/formats/tidy.hpp"

#include "catch.hpp"
#include "recording/support.hpp"

using namespace diabolo;
using test::complaint;
using test::replaced;
using test::tidy_text;

namespace {

const TidyMetadata kMetadata{kBlueDiabolo, 1.5, 100.0};

std::string says(const std::string& text, const TidyMetadata& metadata = kMetadata) {
  return complaint([&] { read_tidy(text, "play.csv", metadata); });
}

std::string says_of(const std::string& from, const std::string& to) {
  return says(replaced(tidy_text(), from, to));
}

}  // namespace

TEST_CASE("A tidy recording is read as it stands") {
  const Recording recording = read_tidy(tidy_text(), "folder/play.csv", kMetadata);
  CHECK(recording.name == "play");
  CHECK(recording.rate == 100.0);
  CHECK(recording.string_length == 1.5);
  CHECK(recording.properties.mass == 0.2895);
  CHECK(recording.frame == std::vector<long>{0, 1, 2});
  CHECK(recording.time == Eigen::Vector3d(0.0, 0.01, 0.02));
  CHECK(recording.left.position.col(2) == Eigen::Vector3d(0.1, 0.3, 1.02));
  CHECK(recording.right.position.col(1) == Eigen::Vector3d(0.1, -0.3, 0.99));
  CHECK((recording.diabolo.valid == (Marks(3) << true, false, true).finished()).all());
  CHECK(recording.diabolo.position.col(1).array().isNaN().all());
  CHECK(recording.diabolo_orientation.quaternion.col(2) == Eigen::Vector4d(0.6, 0.8, 0.0, 0.0));
  CHECK(recording.left_orientation.empty());
  CHECK(recording.right_orientation.empty());
}

TEST_CASE("Whatever is written reads back, bit for bit") {
  const std::uint32_t seed = test::fresh_seed();
  INFO("seed " << seed);
  for (std::uint32_t k = 0; k < 200; ++k) {
    INFO("recording " << k);
    const Recording recording = test::random_recording(seed + k);
    const std::string text = write_tidy(recording);
    const Recording read =
        read_tidy(text, "random.csv", {recording.properties, recording.string_length, recording.rate});
    CHECK(test::same(read, recording));
    CHECK(write_tidy(read) == text);
  }
}

TEST_CASE("A recording without orientation of the diabolo is written with empty cells") {
  Recording recording = test::random_recording(5);
  recording.diabolo_orientation = {};
  const Recording read = read_tidy(write_tidy(recording), "random.csv",
                                   {recording.properties, recording.string_length, recording.rate});
  CHECK(test::same(read.diabolo_orientation, OrientationTrack::missing(recording.size())));
}

TEST_CASE("Columns may stand in any order, sticks may have orientations") {
  const Recording recording = read_tidy(
      "left_qw,left_qz,left_qy,left_qx,diabolo_qw,diabolo_qz,diabolo_qy,diabolo_qx,diabolo_z,diabolo_y,"
      "diabolo_x,"
      "right_z,right_y,right_x,left_z,left_y,left_x,time\r\n1,0,0,0,0,0,0.8,0.6,9,8,7,6,5,4,3,2,1,0.5\r\n",
      "play.csv", kMetadata);
  CHECK(recording.frame == std::vector<long>{50});
  CHECK(recording.left.position.col(0) == Eigen::Vector3d(1.0, 2.0, 3.0));
  CHECK(recording.diabolo.position.col(0) == Eigen::Vector3d(7.0, 8.0, 9.0));
  CHECK(recording.diabolo_orientation.quaternion.col(0) == Eigen::Vector4d(0.6, 0.8, 0.0, 0.0));
  CHECK(recording.left_orientation.quaternion.col(0) == Eigen::Vector4d(0.0, 0.0, 0.0, 1.0));
  CHECK(recording.right_orientation.empty());
}

TEST_CASE("nobody needs to have seen how the diabolo lies") {
  const Recording recording = read_tidy(
      "time,left_x,left_y,left_z,right_x,right_y,right_z,diabolo_x,diabolo_y,diabolo_z\n"
      "0.5,1,2,3,4,5,6,7,8,9\n",
      "play.csv", kMetadata);
  CHECK(recording.diabolo.position.col(0) == Eigen::Vector3d(7.0, 8.0, 9.0));
  CHECK(test::same(recording.diabolo_orientation, OrientationTrack::missing(1)));
}

TEST_CASE("headers of a tidy file that do not fit are refused") {
  CHECK(
      says_of("left_x", "left_q") ==
      "play.csv, line 1: column 2 is \"left_q\", which a tidy recording lacks (--columns maps other names)");
  CHECK(says_of("left_y", "left_x") == "play.csv, line 1: column \"left_x\" is there twice");
  CHECK(says_of("time,", "") == "play.csv, line 1: column \"time\" is missing");
  CHECK(says_of("diabolo_qw", "left_qx") == "play.csv, line 1: column \"diabolo_qw\" is missing");
  CHECK(says_of("diabolo_qw", "diabolo_qw,left_qx") == "play.csv, line 1: column \"left_qy\" is missing");
  CHECK(says_of("diabolo_qw", "diabolo_qw,right_qw") == "play.csv, line 1: column \"right_qx\" is missing");
  CHECK(says("\n") ==
        "play.csv, line 1: column 1 is \"\", which a tidy recording lacks (--columns maps other names)");
  CHECK(says(tidy_text().substr(0, tidy_text().find('\n') + 1)) ==
        "play.csv, line 1: the file ends here; expected at least one line of data");
  CHECK(says("time,left_x,left_y,left_z,right_x,right_y,right_z\n0,0,0,0,0,0,0\n") ==
        "play.csv, line 1: column \"diabolo_x\" is missing: these are the sticks alone; expected a recording "
        "of "
        "the diabolo, too");
  CHECK(says_of("left_x", "H\xc3\xb6he_\xc2\xb5")
            .starts_with("play.csv, line 1: column 2 is \"H\xc3\xb6he_\xc2\xb5\""));
  CHECK(says("\x1f\x8b\x08") == "play.csv: the file is compressed by gzip; expected it unpacked");
  std::string wide = "time";
  for (int column = 0; column < 1'000'000; ++column) wide += ",left_x";
  CHECK(says(wide + "\n") == "play.csv, line 1: column \"left_x\" is there twice");
  CHECK(says("") == "play.csv: the file is empty");
  CHECK(says("\xfe\xff") == "play.csv: the text is UTF-16; expected UTF-8");
}

TEST_CASE("rows of a tidy file that do not fit are refused") {
  CHECK(says_of("0.6,0.8,0,0\n", "0.6,0.8,0\n") ==
        "play.csv, line 4: 13 cells; expected 14, as in the header");
  CHECK(says_of("0.02,", "\n0.02,") == "play.csv, line 4: an empty line; expected a row of the table");
  CHECK(says_of("0.6,0.8,0,0\n", "0.6,0.8,0,0,0\n") ==
        "play.csv, line 4: 15 cells; expected 14, as in the header");
  CHECK(
      says_of("0.6,0.8,0,0\n", "0.6,0.8,,0\n") ==
      "play.csv, line 4: 1 of 4 cells from \"diabolo_qx\" on are empty; expected none, or all in a dropout");
  CHECK(says_of("0.1,0.3,1.02", "0.1,,") ==
        "play.csv, line 4: 2 of 3 cells from \"left_x\" on are empty; expected none, or all in a dropout");
  CHECK(says_of("0.6,0.8,0,0\n", "0.6,0.7,0,0\n")
            .starts_with("play.csv, line 4: \"diabolo_qx\" and on: quaternion of norm 0.92"));
  CHECK(says_of("0.6,0.8,0,0\n", "0,0,0,0\n") ==
        "play.csv, line 4: \"diabolo_qx\" and on: quaternion of norm 0; expected 1 within 0.001");
  CHECK(says_of("0.1,0.3,1.02", "0.1,-300,1020") ==
        "play.csv, line 4: \"left_x\" and on: 1020 m; expected positions within 100 m (other units?)");
  CHECK(says_of("0.1,0.3,1.02", "0.1,NaN,1.02") ==
        "play.csv, line 4: column \"left_y\": \"NaN\"; expected a finite number or an empty cell");
}

TEST_CASE("Times have to increase at the stated rate") {
  CHECK(says_of("\n0.02,", "\n0.01,") == "play.csv, line 4: time 0.01 s does not come after 0.01 s");
  CHECK(says_of("\n0.02,", "\n,") == "play.csv, line 4: time is empty; expected a number of seconds");
  CHECK(says_of("\n0.02,", "\n5000,") ==
        "play.csv, line 4: time 5000 s comes more than an hour after 0.01 s; expected one take a file");
  CHECK(says_of("\n0.02,", "\n1e10,") == "play.csv, line 4: time 1e+10 s; expected a number within 1e9 s");
  CHECK(says(tidy_text(), {kBlueDiabolo, 1.5, 120.0}) ==
        "play.csv: rate 120 Hz, but the times step by 0.01 s (100 Hz)");
  CHECK(says(tidy_text(), {kBlueDiabolo, 1.5, 1e5}) ==
        "play.csv: rate 1e+05 Hz, but the times step by 0.01 s (100 Hz), as if they were in ms: --columns "
        "time=NAME[ms]");
  CHECK(says(tidy_text(), {kBlueDiabolo, 1.5, kNaN}) ==
        "play.csv: rate nan Hz; expected more than 0, at most 1e6");
  CHECK(says(tidy_text(), {kBlueDiabolo, 0.0, 100.0}) ==
        "play.csv: string_length [m] 0; expected 0.05 to 20");
}

TEST_CASE("Of a file that is cut off inside a line the lines before are read, with a note") {
  const std::string text = tidy_text();
  const std::size_t second = text.find("0.01,");
  for (std::size_t length = 0; length < text.size(); ++length) {
    const std::string part = text.substr(0, length);
    INFO("cut off after " << length << " bytes");
    if (length < second) {
      CHECK(says(part).starts_with("play.csv"));
      continue;
    }
    const Recording recording = read_tidy(part, "play.csv", kMetadata);
    CHECK(recording.size() == std::count(part.begin(), part.end(), '\n') - 1);
    CHECK(recording.notes.empty() == part.ends_with('\n'));
  }
}

TEST_CASE("Stamps of a clock are counted from the first row, in seconds only") {
  const auto at = [](const std::string& first, const std::string& second, const std::string& third) {
    return replaced(
        replaced(replaced(tidy_text(), "\n0,", "\n" + first + ","), "\n0.01,", "\n" + second + ","),
        "\n0.02,", "\n" + third + ",");
  };
  const Recording recording =
      read_tidy(at("1700000000.5", "1700000000.51", "1700000000.52"), "play.csv", kMetadata);
  CHECK(recording.time.isApprox(Eigen::Vector3d(0.0, 0.01, 0.02), 1e-5));
  CHECK(recording.frame == std::vector<long>{0, 1, 2});
  CHECK(recording.notes ==
        std::vector<std::string>{"the times are stamps of a clock, from 1700000000.5 s on: they "
                                 "are counted from there"});
  CHECK(says(at("1700000000500", "1700000000510", "1700000000520")) ==
        "play.csv, line 2: time 1700000000500 s; expected seconds (a clock's ms: --columns time=NAME[ms])");
  const auto advice = [&](const std::string& stamp, const std::vector<MappedColumn>& columns) {
    const std::string said =
        complaint([&] { read_tidy(at(stamp, "2e30", "3e30"), "play.csv", kMetadata, columns); });
    return said.substr(said.find("--columns"));
  };
  CHECK(advice("1700000000500000", {}) == "--columns time=NAME[us])");
  CHECK(advice("1700000000500000000", {}) == "--columns time=NAME[ns])");
  CHECK(advice("1700000000500000000", columns_of("time=time[ms]")) == "--columns time=NAME[ns])");
}

TEST_CASE("A broken recording is not written") {
  Recording recording = test::random_recording(6);
  recording.diabolo.position(0, 0) = 1e9;
  CHECK(complaint([&] { write_tidy(recording); }).starts_with("recording \"random\", diabolo, sample 0"));
  Recording empty;
  empty.rate = 120.0;
  CHECK(complaint([&] { write_tidy(empty); }) == "recording \"\": no samples to write");
}
