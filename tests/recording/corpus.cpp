// SPDX-License-Identifier: MIT
// The seeds of the fuzz targets, read without a fuzzer: each is read or refused with a sentence, nothing
// else.

#include "catch.hpp"
#include "diabolo/json/calibration_file.hpp"
#include "diabolo/json/recording_file.hpp"
#include "recording/support.hpp"
#include "source_dir.hpp"

using namespace diabolo;

namespace {

/// How many files of a corpus are read, and how many refused.
template <class Read>
std::pair<int, int> read_and_refused(const std::string& corpus, const Read& read) {
  std::pair<int, int> counts;
  for (const auto& entry : std::filesystem::directory_iterator(source_dir() / "tests/fuzz/corpus" / corpus)) {
    INFO(entry.path().string());
    const std::string text = read_file(entry.path());
    const std::string said = test::complaint([&] { read(text); });
    CHECK(said.find('\n') == std::string::npos);
    ++(said == "(no complaint)" ? counts.first : counts.second);
  }
  return counts;
}

}  // namespace

TEST_CASE("Every seed of the fuzz targets is read or refused with one sentence") {
  for (const auto& [read, refused] :
       {read_and_refused("motive", [](const std::string& text) { read_motive(text, "seed"); }),
        read_and_refused("tidy",
                         [](const std::string& text) {
                           read_tidy(text, "seed", {kRedDiabolo, 1.46, 100.0});
                         }),
        read_and_refused("recording_json", [](const std::string& text) { read_metadata(text, "seed"); }),
        read_and_refused("calibration_json",
                         [](const std::string& text) { read_calibration(text, "seed"); })}) {
    CHECK(read > 0);
    CHECK(refused > 0);
  }
}
