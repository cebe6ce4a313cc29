// SPDX-License-Identifier: MIT
#include "diabolo/recording/dropouts.hpp"

#include "catch.hpp"
#include "recording/support.hpp"

using namespace diabolo;

TEST_CASE("A held track repeats the last valid position and keeps what came before the first") {
  Track track = Track::missing(6);
  track.valid << false, true, false, false, true, false;
  track.position.col(1) << 1.0, 2.0, 3.0;
  track.position.col(4) << 4.0, 5.0, 6.0;
  const Track held = hold_last_valid(track);
  CHECK((held.valid == (Marks(6) << false, true, true, true, true, true).finished()).all());
  CHECK(held.position.col(0).array().isNaN().all());
  CHECK(held.position.col(2) == track.position.col(1));
  CHECK(held.position.col(3) == track.position.col(1));
  CHECK(held.position.col(5) == track.position.col(4));
}

TEST_CASE("Holding changes no valid sample, and holding twice changes nothing more") {
  const std::uint32_t seed = test::fresh_seed();
  INFO("seed " << seed);
  for (std::uint32_t k = 0; k < 50; ++k) {
    const Track track = test::random_recording(seed + k).left;
    const Track held = hold_last_valid(track);
    for (Eigen::Index i = 0; i < track.valid.size(); ++i)
      if (track.valid[i]) CHECK(held.position.col(i) == track.position.col(i));
    CHECK(test::same(hold_last_valid(held), held));
  }
}

namespace {

/// One mark per digit, 1 being valid.
Marks marks(const std::string& digits) {
  Marks result(static_cast<Eigen::Index>(digits.size()));
  for (std::size_t i = 0; i < digits.size(); ++i) result[static_cast<Eigen::Index>(i)] = digits[i] == '1';
  return result;
}

}  // namespace

TEST_CASE("Dropouts widen by the asked number of samples") {
  const Marks valid = marks("111101111");
  CHECK((widen_dropouts(valid, 0) == valid).all());
  CHECK((widen_dropouts(valid, 1) == marks("111000111")).all());
  CHECK((widen_dropouts(valid, 2) == widen_dropouts(widen_dropouts(valid, 1), 1)).all());
  CHECK(!widen_dropouts(valid, 100).any());
}

TEST_CASE("Without dropout edges the diabolo has wider dropouts and the sticks keep theirs") {
  const std::uint32_t seed = test::fresh_seed();
  INFO("seed " << seed);
  for (std::uint32_t k = 0; k < 50; ++k) {
    Recording recording = test::random_recording(seed + k);
    const Recording result = without_dropout_edges(recording);
    CHECK(test::same(result.left, recording.left));
    CHECK((result.diabolo.valid == widen_dropouts(recording.diabolo.valid, 1)).all());
    for (Eigen::Index i = 0; i < recording.size(); ++i)
      CHECK(result.diabolo.position.col(i).array().isNaN().all() == !result.diabolo.valid[i]);
    CHECK((result.diabolo_orientation.valid == widen_dropouts(recording.diabolo_orientation.valid, 1)).all());
  }
}
