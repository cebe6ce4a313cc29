// SPDX-License-Identifier: MIT
#include "diabolo/json/recording_file.hpp"

#include <fstream>

#include "catch.hpp"
#include "recording/support.hpp"

using namespace diabolo;
using test::complaint;
using test::replaced;

namespace {

const std::string kMetadata = R"({"schema": "diabolo.recording/1",
  "diabolo": {"mass": 0.2845, "diameter": 0.127, "length": 0.143, "axle_radius": 0.0065},
  "string_length": 1.46, "rate": 100, "units": "SI", "frame": "x forward, y left, z up"})";

void write(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

std::string metadata_complaint(const std::string& from, const std::string& to) {
  return complaint([&] { read_metadata(replaced(kMetadata, from, to), "play.json"); });
}

}  // namespace

TEST_CASE("Metadata is read as it stands and written back") {
  const TidyMetadata metadata = read_metadata(kMetadata, "play.json");
  CHECK(metadata.properties.mass == 0.2845);
  CHECK(metadata.properties.axle_radius == 0.0065);
  CHECK(metadata.string_length == 1.46);
  CHECK(metadata.rate == 100.0);
  const TidyMetadata again = read_metadata(write_metadata(metadata), "play.json");
  CHECK(again.properties.diameter == metadata.properties.diameter);
  CHECK(again.properties.length == metadata.properties.length);
  CHECK(again.rate == metadata.rate);
  CHECK(again.clock == 0.0);
  CHECK(read_metadata(write_metadata({kRedDiabolo, 1.46, 100.0, {}, 2.5}), "play.json").clock == 2.5);
  CHECK_NOTHROW(read_metadata(replaced(kMetadata, "\"rate\"", "\"note\": [1, {}], \"rate\""), "play.json"));
}

TEST_CASE("Missing and wrong metadata are named") {
  CHECK(metadata_complaint("\"rate\": 100", "\"clock\": 1e300, \"rate\": 100") ==
        "play.json: field \"clock\" is 1e+300; expected seconds within 1e9");
  CHECK(metadata_complaint("recording/1", "calibration/1") ==
        "play.json: field \"schema\" is \"diabolo.calibration/1\"; expected \"diabolo.recording/1\"");
  CHECK(metadata_complaint("\"SI\"", "\"mm\"") == "play.json: field \"units\" is \"mm\"; expected \"SI\"");
  CHECK(metadata_complaint("y left", "y up") ==
        "play.json: field \"frame\" is \"x forward, y up, z up\"; expected \"x forward, y left, z up\"");
  CHECK(metadata_complaint("\"rate\": 100, ", "") == "play.json: field \"rate\" is missing");
  CHECK(metadata_complaint("100", "\"fast\"") == "play.json: field \"rate\" is \"fast\"; expected a number");
  CHECK(metadata_complaint("0.2845", "-1") ==
        "play.json: field \"diabolo.mass\" is -1; expected a number > 0");
  CHECK(metadata_complaint("\"mass\": 0.2845, ", "") == "play.json: field \"diabolo.mass\" is missing");
  const auto assumed = [](const std::string& said) {
    return metadata_complaint("\"rate\"", "\"assumed\": " + said + ", \"rate\"");
  };
  CHECK(assumed("[\"mass\"]") ==
        "play.json: assumed: \"mass\"; expected \"string_length\" or \"diabolo\", each once");
  CHECK(assumed("\"diabolo\"") == "play.json: field \"assumed\" is \"diabolo\"; expected a list of texts");
  CHECK(assumed("[1]") == "play.json: field \"assumed\" is of type array; expected a list of texts");
  CHECK(assumed("[]") == "(no complaint)");
  CHECK(metadata_complaint("\"mass\"", "\"length\": 1, \"mass\"") ==
        "play.json: field \"length\" is there twice");
  CHECK(complaint([] {
          write_metadata({kRedDiabolo, kNaN, 100.0});
        }) == "recording: string_length [m] nan; expected 0.05 to 20");
  CHECK(complaint([] {
          write_metadata({kRedDiabolo, 1.46, 100.0, {"mass"}});
        }).starts_with("recording: assumed: \"mass\"; expected"));
}

TEST_CASE("Motive and tidy recordings are told apart by content") {
  const test::TemporaryFolder folder;
  write(folder / "take.txt", test::motive_text());
  write(folder / "play.csv", test::tidy_text());
  write(folder / "play.json", kMetadata);
  write(folder / "quoted.csv",
        "\xef\xbb\xbf" + replaced(test::motive_text(), "Format Version", "\"Format Version\""));
  const Recording take = load_recording(folder / "take.txt", published_calibration());
  CHECK(take.name == "take");
  CHECK(take.rate == 120.0);
  CHECK(test::same(load_recording(folder / "quoted.csv"), take));
  const Recording play = load_recording(folder / "play.csv", published_calibration());
  CHECK(play.name == "play");
  CHECK(play.rate == 100.0);
  CHECK(play.left.position.col(0) == Eigen::Vector3d(0.1, 0.3, 1.0));
  write(folder / "play.csv",
        replaced(replaced(test::tidy_text(), "time", "\"time\""), "left_x", "\"left_x\""));
  CHECK(test::same(load_recording(folder / "play.csv"), play));
}

TEST_CASE("Files of other kinds are refused") {
  const test::TemporaryFolder folder;
  const auto says = [&folder](const std::string& text) {
    write(folder / "x.csv", text);
    return replaced(complaint([&] { load_recording(folder / "x.csv"); }), (folder / "x").string(), "x");
  };
  CHECK(says("t,error\n0,1\n") ==
        "x.csv, line 1: starts with \"t,error\"; expected a Motive export (\"Format "
        "Version,...\") or a tidy recording (\"time,...\"); --columns maps other names");
  CHECK(says("") == "x.csv: the file is empty");
  CHECK(says("time\tleft_x\n0\t1\n") ==
        "x.csv, line 1: tabs separate the columns; expected commas, and decimal points");
  CHECK(says(test::tidy_text()) == "x.csv: expected " + (folder / "x.json").string() +
                                       " beside it, which says the string's length, the rate and what the "
                                       "diabolo is like");
  write(folder / "x.json", "{");
  CHECK(says(test::tidy_text()) == "x.json, line 1, column 2: this is not JSON (or the file is cut off)");
  write(folder / "x.json", kMetadata);
  CHECK(says(replaced(test::tidy_text(), "\n", "\r")).starts_with("x.csv, line 1: a CR inside the line"));
  CHECK(complaint([&] { load_recording(folder / "y.csv"); }).ends_with("y.csv: there is no such file"));
  CHECK(complaint([&] { load_recording(folder / ""); }).ends_with(": a directory; expected a file"));
}

TEST_CASE("What is saved loads again, bit for bit") {
  const std::uint32_t seed = test::fresh_seed();
  INFO("seed " << seed);
  const test::TemporaryFolder folder;
  for (std::uint32_t k = 0; k < 20; ++k) {
    Recording recording = test::random_recording(seed + k);
    recording.properties = kGreenDiabolo;
    recording.string_length = 1.0 / 3.0;
    if (k % 2 == 1) recording.assumed = {"string_length"};
    save_tidy(recording, folder / "random.csv");
    const Recording again = load_recording(folder / "random.csv");
    CHECK(test::same(again, recording));
    CHECK(again.assumed == recording.assumed);
    CHECK(folder.entries() == 2);
  }
}

TEST_CASE("A recording that cannot be saved leaves everything as it was") {
  const test::TemporaryFolder folder;
  Recording recording = test::random_recording(3);
  save_tidy(recording, folder / "play.csv");
  const std::string before = read_file(folder / "play.csv");
  recording.left = Track::missing(0);
  CHECK(complaint([&] {
          save_tidy(recording, folder / "play.csv");
        }).starts_with("recording \"random\", left tip:"));
  CHECK(read_file(folder / "play.csv") == before);
  CHECK(folder.entries() == 2);
  recording = test::random_recording(3);
  CHECK(complaint([&] {
          save_tidy(recording, folder / "play.json");
        }).ends_with("expected a name that ends in .csv"));
  std::filesystem::create_directory(folder / "taken.csv");
  CHECK(complaint([&] {
          save_tidy(recording, folder / "taken.csv");
        }).ends_with("a directory; expected a file"));
  CHECK(folder.entries() == 3);
}

TEST_CASE("Every published take loads, saved ones the same") {
  const auto recordings =
      test::recordings_folder("loading published takes and saving them as tidy recordings");
  if (!recordings) return;
  const test::TemporaryFolder folder;
  for (const char* name : {"2020-07-11_basic_physics/throw_1", "2020-06-18/deceleration_diabolo_red_2",
                           "2020-09-14_motion_extraction/circular_accel_stick_motion"}) {
    INFO(name);
    const Recording recording = load_recording(*recordings / (std::string(name) + ".csv"));
    save_tidy(recording, folder / "copy.csv");
    CHECK(test::same(load_recording(folder / "copy.csv"), recording));
  }
}
