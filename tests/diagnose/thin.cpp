// SPDX-License-Identifier: MIT
#include "diabolo/diagnose/thin.hpp"

#include <algorithm>
#include <cstddef>
#include <random>
#include <vector>

#include "catch.hpp"

using namespace diabolo;

namespace {

constexpr int kString = index_of(Unknown::kFriction), kFlight = index_of(unknown_named("lift")),
              kOften = index_of(Unknown::kLeftX);

/// What 600 windows say: all of the string, one in fifty of the flight, and all of one more, as much as they
/// say of the string.
std::vector<UnknownVector> play() {
  std::mt19937_64 generator(3);
  std::uniform_real_distribution<double> size(0.5, 1.5);
  std::vector<UnknownVector> result(600, UnknownVector::Zero());
  for (std::size_t i = 0; i < result.size(); ++i) {
    result[i][kString] = result[i][kOften] = 100.0 * size(generator);
    if (i % 50 == 17) result[i][kFlight] = 100.0 * size(generator);
  }
  return result;
}

std::vector<FitTake> takes_of(const std::vector<int>& counts) {
  std::vector<FitTake> fit_takes;
  for (const int count : counts) {
    fit_takes.emplace_back();
    for (int w = 0; w < count; ++w) fit_takes.back().windows.push_back({w, w + 1, {}});
  }
  return fit_takes;
}

}  // namespace

TEST_CASE("windows that decide are as many as wanted, each once, from every part of the play") {
  const std::vector<std::size_t> kept = windows_that_decide(play(), 60);
  REQUIRE(kept.size() == 60);
  for (std::size_t k = 0; k < kept.size(); ++k) CHECK(kept[k] / 40 == k / kInARow);
  for (std::size_t k = 1; k < kept.size(); ++k)
    if (k % kInARow != 0) CHECK(kept[k] == kept[k - 1] + 1);  // neighbours stay together
  CHECK(windows_that_decide(play(), 60) == kept);
  CHECK(windows_that_decide(play(), 600).size() == 600);
  CHECK(windows_that_decide(play(), 601).back() == 599);
}

TEST_CASE("what few windows show is among those that decide") {
  const auto shows_flight = [](std::size_t i) { return i % 50 == 17; };
  CHECK(std::ranges::count_if(windows_that_decide(play(), 60), shows_flight) == 12);  // all that there are
  CHECK(std::ranges::count_if(evenly(600, 60), shows_flight) < 12);
}

TEST_CASE("a window that says far more than is usual of one unknown does not decide for it") {
  std::vector<UnknownVector> information = play();
  information[25][kString] = 1e12;
  information[26][kString] = 1e9;
  information[25][kOften] = information[26][kOften] = 0.0;
  const std::vector<std::size_t> kept = windows_that_decide(information, 60);
  CHECK(std::ranges::count(kept, 25) + std::ranges::count(kept, 26) == 0);
  information[45] = UnknownVector::Constant(kNaN);
  CHECK(std::ranges::count(windows_that_decide(information, 60), 45) == 0);
}

TEST_CASE("evenly spread windows keep their distance") {
  const std::vector<std::size_t> kept = evenly(100, 5);
  CHECK(kept == std::vector<std::size_t>{10, 30, 50, 70, 90});
  CHECK(evenly(3, 5) == std::vector<std::size_t>{0, 1, 2});
  CHECK(evenly(0, 5).empty());
}

TEST_CASE("windows are kept by their number, take after take") {
  std::vector<FitTake> fit_takes = takes_of({3, 0, 4});
  keep_windows(fit_takes, {1, 2, 3, 6});
  REQUIRE(fit_takes[0].windows.size() == 2);
  CHECK(fit_takes[0].windows[0].first == 1);
  CHECK(fit_takes[1].windows.empty());
  REQUIRE(fit_takes[2].windows.size() == 2);
  CHECK(fit_takes[2].windows[0].first == 0);
  CHECK(fit_takes[2].windows[1].first == 3);
}
