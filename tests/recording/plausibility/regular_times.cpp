// SPDX-License-Identifier: MIT
#include "diabolo/recording/plausibility/regular_times.hpp"

#include <algorithm>
#include <random>
#include <utility>
#include <vector>

#include "catch.hpp"
#include "recording/shipped.hpp"
#include "recording/support.hpp"

using namespace diabolo;

namespace {

Recording with_jitter(Recording r, double seconds, std::uint32_t seed) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> jitter(0.0, seconds);
  for (double& time : r.time) time += jitter(generator);
  return r;
}

/// Times of ten seconds at 120 Hz, rows left out at random, put right, with what they were without jitter. A
/// rate of 0 is not stated.
std::pair<Recording, Eigen::VectorXd> thinned(double out, double jitter, double rate,
                                              std::mt19937& generator) {
  std::uniform_real_distribution<double> share(0.0, 1.0);
  std::normal_distribution<double> normal;
  std::vector<double> even, stamps;
  for (int i = 0; i < 1200; ++i) {
    if (share(generator) < out) continue;
    even.push_back(i / 120.0);
    stamps.push_back(even.back() + jitter * normal(generator));
  }
  std::ranges::sort(stamps);
  const Eigen::Index size = std::ssize(stamps);
  Recording r;
  r.time = Eigen::Map<const Eigen::VectorXd>(stamps.data(), size);
  r.left = r.right = r.diabolo = Track::missing(size);
  r.rate = rate > 0.0 ? rate : rate_of(r.time);
  check_rate(r.rate, r.time, "thinned");
  regularise_times(r);
  put_rate_right(r);
  return {r, Eigen::Map<const Eigen::VectorXd>(even.data(), size)};
}

}  // namespace

TEST_CASE("Jitter of 0.4 ms at 120 Hz is put right") {
  const Recording given = test::shipped("throw");
  Recording r = with_jitter(given, 0.4e-3, test::fresh_seed());
  REQUIRE(regularise_times(r));
  CHECK((r.time - given.time).cwiseAbs().maxCoeff() < 1e-4);
  for (Eigen::Index i = 0; i + 1 < r.size(); ++i) CHECK(r.steps_evenly(i));
  REQUIRE(r.notes.size() == 1);
  CHECK(r.notes.front().starts_with("the times jitter by 0."));
  CHECK(odd_times(r).empty());
}

TEST_CASE("Gaps stay where they are, also such as are no whole periods") {
  Recording given = test::shipped("throw");
  given.time.tail(800).array() += 0.2541;
  Recording r = with_jitter(given, 0.3e-3, 7);
  REQUIRE(regularise_times(r));
  CHECK((r.time - given.time).cwiseAbs().maxCoeff() < 1e-4);
}

TEST_CASE("Even times stay bit for bit, and so do those of which no rate is clear") {
  Recording even = test::shipped("swing");
  const Eigen::VectorXd before = even.time;
  CHECK(!regularise_times(even));
  CHECK(even.time == before);
  Recording random = even;
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> share(0.2, 1.8);
  for (Eigen::Index i = 1; i < random.size(); ++i)
    random.time[i] = random.time[i - 1] + share(generator) / 120.0;
  const Eigen::VectorXd given = random.time;
  CHECK(!regularise_times(random));
  CHECK(random.time == given);
  CHECK(odd_times(random).find("the times step unevenly in ") == 0);
}

TEST_CASE("The rate of times is found through jitter and gaps") {
  Recording r = with_jitter(test::shipped("throw"), 0.4e-3, 3);
  r.time.tail(500).array() += 3.3;
  CHECK(rate_of(r.time) == 120.0);
  CHECK(rate_of(Eigen::VectorXd::LinSpaced(1000, 0.0, 999.0 / 119.88)) == Approx(119.88));
}

TEST_CASE("A second between rows is too long for play") {
  Recording r = test::shipped("hop");
  r.time *= 120.0;
  r.rate = 1.0;
  CHECK(odd_times(r) == "the rows are 1 s apart, too far for play: the times may be in other units");
}

TEST_CASE("Where rows are left out, and stamps lie far off now and then, each row finds its place") {
  const Recording given = test::shipped("throw");
  const std::uint32_t seed = test::fresh_seed();
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  Eigen::Index misplaced = 0;  // rarely a few rows in a row; of five plays
  for (std::uint32_t play = 0; play < 5; ++play) {
    std::vector<Eigen::Index> kept;
    for (Eigen::Index i = 0; i < given.size(); ++i)
      if (share(generator) > 0.3) kept.push_back(i);
    Recording r = given;
    r.time = given.time(kept);
    r.frame.assign(kept.begin(), kept.end());
    for (Track* track : {&r.left, &r.right, &r.diabolo}) *track = Track::missing(std::ssize(kept));
    const Eigen::VectorXd even = r.time;
    r = with_jitter(std::move(r), 1.0e-3, seed + play);
    std::ranges::sort(r.time);
    CHECK(steps_at(120.0, r.time));
    CHECK_FALSE(steps_at(60.0, r.time));
    CHECK_FALSE(steps_at(240.0, r.time));
    REQUIRE(regularise_times(r));
    const Eigen::VectorXd off = r.time - even;
    const double shift = off.mean();  // of what the jitter makes of the whole
    misplaced += ((off.array() - shift).abs() > 4e-3).count();
    Eigen::Index uneven = 0;
    for (Eigen::Index i = 0; i + 1 < r.size(); ++i) uneven += steps_unevenly(r, i);
    CHECK(uneven == 0);
  }
  CHECK(misplaced <= 20);
}

TEST_CASE("Jitter of a seventh of the period is put right") {
  const Recording given = test::shipped("throw");
  Recording r = with_jitter(given, 1.2e-3, test::fresh_seed());
  std::ranges::sort(r.time);
  REQUIRE(regularise_times(r));
  CHECK((r.time - given.time).cwiseAbs().maxCoeff() < 4e-4);
}

TEST_CASE("Rows that arrive together after a stall find their places") {
  const Recording given = test::shipped("throw");
  for (const Eigen::Index at : {8, 15, 500})
    for (const Eigen::Index late : {1, 2, 3, 5, 8}) {
      CAPTURE(at, late);
      Recording r = with_jitter(given, 0.2e-3, 5);
      for (Eigen::Index k = 0; k < late; ++k)
        r.time[at + k] = r.time[at + late] - 1e-5 * static_cast<double>(late - k);
      REQUIRE(regularise_times(r));
      CHECK((r.time - given.time).cwiseAbs().maxCoeff() < 1e-3);
    }
}

TEST_CASE("The rate is found where most rows are left out") {
  const Recording given = test::shipped("throw");
  const std::uint32_t seed = test::fresh_seed();
  for (const double out : {0.3, 0.5, 0.6}) {
    CAPTURE(seed, out);
    std::mt19937 generator(seed);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    std::vector<Eigen::Index> kept;
    for (Eigen::Index i = 0; i < given.size(); ++i)
      if (share(generator) > out) kept.push_back(i);
    CHECK(rate_of(given.time(kept)) == 120.0);
  }
}

TEST_CASE("Where many rows are left out and stamps jitter, the rate is right, or it is told that it is not") {
  const std::uint32_t seed = test::fresh_seed();
  std::mt19937 generator(seed);
  for (const double out : {0.3, 0.5, 0.7})
    for (const double jitter : {0.0, 0.3e-3, 0.6e-3, 1.0e-3, 1.5e-3})
      for (const bool is_stated : {true, false}) {
        CAPTURE(seed, out, jitter, is_stated);
        const auto [r, even] = thinned(out, jitter, is_stated ? 120.0 : 0.0, generator);
        const bool is_right = std::abs(r.rate / 120.0 - 1.0) < 5e-3, is_told = !odd_times(r).empty();
        CHECK((is_right || is_told));
        if (jitter <= 1.0e-3) CHECK(is_right);
        if (jitter <= 0.6e-3) CHECK(!is_told);
        if (is_told) continue;
        const Eigen::ArrayXd off = r.time - even;
        CHECK(50 * ((off - off.mean()).abs() > 4e-3).count() <= r.size());
      }
}

TEST_CASE("Jitter between rows of which most are left out is put right, or told") {
  std::mt19937 generator(4);
  Recording steady = thinned(0.8, 0.0, 120.0, generator).first;
  std::normal_distribution<double> normal;
  Recording slight = steady, hopeless = steady;
  for (double& time : slight.time) time += 0.3e-3 * normal(generator);
  CHECK(share_between_places(slight.time, slight.rate) > kMostUneven);
  CHECK(regularise_times(slight));
  CHECK(odd_times(slight).empty());
  for (double& time : hopeless.time) time += 3e-3 * normal(generator);
  std::ranges::sort(hopeless.time);
  CHECK(!regularise_times(hopeless));
  CHECK(odd_times(hopeless).starts_with("the times step unevenly in "));
}

TEST_CASE("Rows that are moved so far that they may belong beside are counted") {
  Recording r = with_jitter(test::shipped("throw"), 0.2e-3, 5);
  r.time[300] += 3.8e-3;
  r.time[500] -= 3.8e-3;
  REQUIRE(regularise_times(r));
  REQUIRE(r.notes.size() == 1);
  CHECK(
      r.notes.front().ends_with("each row is moved to its even time, 2 of them by more than 0.4 of a period: "
                                "they may belong beside it"));
}

TEST_CASE("A rate that the times contradict a little is put right, and said to be") {
  for (const double jitter : {0.0, 0.4e-3}) {
    Recording r = with_jitter(test::shipped("throw"), jitter, 11);
    const std::vector<Eigen::Index> frames(r.frame.begin(), r.frame.end());
    r.rate = 118.0;
    for (Eigen::Index i = 0; i < r.size(); ++i)
      r.frame[static_cast<std::size_t>(i)] = std::lround(118.0 * r.time[i]);
    CHECK(odd_times(r).starts_with("the rate is given as 118 Hz, but the times step at 120 Hz") ==
          (jitter == 0.0));
    regularise_times(r);
    put_rate_right(r);
    CAPTURE(jitter, r.notes);
    CHECK(r.rate == 120.0);
    CHECK(r.notes.back() == "the rate is given as 118 Hz, but the times step at 120 Hz, which counts");
    if (jitter == 0.0) CHECK(std::ranges::equal(r.frame, frames));
  }
  Recording right = test::shipped("throw");
  put_rate_right(right);
  CHECK(right.notes.empty());
}
