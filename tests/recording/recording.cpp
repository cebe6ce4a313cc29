// SPDX-License-Identifier: MIT
#include "diabolo/recording/recording.hpp"

#include "catch.hpp"
#include "recording/support.hpp"

using namespace diabolo;
using test::complaint;

TEST_CASE("Cutting a whole recording changes nothing") {
  const std::uint32_t seed = test::fresh_seed();
  INFO("seed " << seed);
  for (std::uint32_t k = 0; k < 50; ++k) {
    const Recording recording = test::random_recording(seed + k);
    CHECK(test::same(cut(recording, 0, recording.size() - 1), recording));
  }
}

TEST_CASE("A cut of a cut is a cut") {
  const std::uint32_t seed = test::fresh_seed();
  INFO("seed " << seed);
  std::mt19937 generator(seed);
  for (std::uint32_t k = 0; k < 50; ++k) {
    const Recording recording = test::random_recording(seed + k);
    const auto draw = [&](Eigen::Index low, Eigen::Index high) {
      return std::uniform_int_distribution<Eigen::Index>(low, high)(generator);
    };
    const Eigen::Index first = draw(0, recording.size() - 1), last = draw(first, recording.size() - 1);
    const Recording part = cut(recording, first, last);
    REQUIRE(part.size() == last - first + 1);
    CHECK(part.time[0] == recording.time[first]);
    CHECK(part.frame.back() == recording.frame[static_cast<std::size_t>(last)]);
    const Eigen::Index a = draw(0, part.size() - 1), b = draw(a, part.size() - 1);
    CHECK(test::same(cut(part, a, b), cut(recording, first + a, first + b)));
  }
}

TEST_CASE("A cut beyond the recording is refused") {
  Recording recording = test::random_recording(1);
  recording.name = "take";
  const Eigen::Index size = recording.size();
  CHECK(complaint([&] { cut(recording, 0, size); }) ==
        "cut of recording \"take\": rows 0 to " + std::to_string(size) + "; expected 0 <= first <= last < " +
            std::to_string(size));
  CHECK(complaint([&] { cut(recording, -1, 0); }) != "(no complaint)");
  CHECK(complaint([&] { cut(recording, 1, 0); }) != "(no complaint)");
}

TEST_CASE("Steps are even within a tenth of a period") {
  Recording recording;
  recording.rate = 100.0;
  recording.time.resize(5);
  recording.time << 0.0, 0.01, 0.0209, 0.0320, 0.0408;  // steps of 10, 10.9, 11.1 and 8.8 ms
  CHECK(recording.steps_evenly(0));
  CHECK(recording.steps_evenly(1));
  CHECK(!recording.steps_evenly(2));
  CHECK(!recording.steps_evenly(3));
  CHECK(!recording.steps_evenly(4));
}
