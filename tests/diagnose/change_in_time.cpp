// SPDX-License-Identifier: MIT
#include "diabolo/diagnose/change_in_time.hpp"

#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <vector>

#include "catch.hpp"
#include "recording/support.hpp"

using namespace diabolo;

namespace {

constexpr std::size_t kSideways = 1, kLength = 10, kDelay = 12;  // of kMayChange

/// Windows of half a second that see an unknown (SI units) with a deviation of a usual size.
std::vector<WindowFinding> seen(std::size_t k, int count, const std::function<double(double)>& value,
                                std::uint32_t seed) {
  std::mt19937_64 generator(seed);
  std::normal_distribution<double> normal;
  std::vector<WindowFinding> windows;
  for (int i = 0; i < count; ++i) {
    WindowFinding w{};
    w.begin = 0.5 * i;
    w.end = w.begin + 0.5;
    w.curvature[k] = 1.0;
    w.slope[k] =
        value(w.begin) / (kMayChange[k].factor * info_of(kMayChange[k].unknown).scale) + normal(generator);
    windows.push_back(w);
  }
  return windows;
}

double wave(double t) { return 0.2 * std::sin(2.0 * std::numbers::pi * 0.21 * t + 0.4); }

}  // namespace

TEST_CASE("an acceleration that comes and goes is found with its frequency and size") {
  const std::vector<ChangeInTime> changes = changes_in_time(seen(kSideways, 120, wave, test::fresh_seed()));
  REQUIRE(changes.size() == 1);
  CHECK(changes.front().quantity == "acceleration_left");
  REQUIRE(changes.front().frequency_hz.has_value());
  CHECK(*changes.front().frequency_hz == Approx(0.21).margin(0.01));
  CHECK(changes.front().size > 0.05);
  CHECK(changes.front().size < 0.2);
}

TEST_CASE("clocks that drift apart are told, a delay that comes and goes is none") {
  const std::vector<ChangeInTime> drift = changes_in_time(seen(
      kDelay, 120, [](double t) { return 1e-3 * (t - 30.0); }, test::fresh_seed()));
  REQUIRE(drift.size() == 1);
  CHECK(drift.front().quantity == "time_offset");
  CHECK(*drift.front().trend_per_s == Approx(1e-3).epsilon(0.3));
  CHECK(changes_in_time(seen(
                            kDelay, 120, [](double t) { return 0.1 * wave(t); }, test::fresh_seed()))
            .empty());
  CHECK(changes_in_time(seen(
                            kDelay, 120, [](double t) { return t < 30.0 ? 0.0 : 0.03; }, test::fresh_seed()))
            .empty());
  // A few windows that know it well, and are off by more than they know, do not decide.
  std::vector<WindowFinding> windows = seen(
      kDelay, 120, [](double t) { return 2e-3 * (t - 30.0); }, test::fresh_seed());
  for (std::size_t i = 3; i < windows.size(); i += 9) {
    windows[i].curvature[kDelay] *= 300.0;
    windows[i].slope[kDelay] *= 300.0;
  }
  REQUIRE(changes_in_time(windows).size() == 1);
  CHECK(*changes_in_time(windows).front().trend_per_s == Approx(2e-3).epsilon(0.3));
}

TEST_CASE("a string that creeps is told by how much a second") {
  const std::vector<ChangeInTime> changes = changes_in_time(seen(
      kLength, 120, [](double t) { return 2e-3 * (t - 30.0); }, test::fresh_seed()));
  REQUIRE(changes.size() == 1);
  CHECK(changes.front().quantity == "string_length");
  REQUIRE(changes.front().trend_per_s.has_value());
  CHECK(*changes.front().trend_per_s == Approx(2e-3).epsilon(0.15));
}

TEST_CASE(
    "a change too small to matter is none, however sure; windows that know little do not make it large") {
  const auto windows_of = [](double factor) {
    std::vector<WindowFinding> windows = seen(
        kSideways, 120, [](double) { return 0.0; }, test::fresh_seed());
    for (WindowFinding& w : windows) {
      w.curvature[kSideways] = 1e6;
      w.slope[kSideways] = 1e6 * factor * wave(w.begin) / kStandardGravity / info_of(Unknown::kTiltY).scale;
    }
    return windows;
  };
  CHECK(changes_in_time(windows_of(0.02)).empty());  // 4 mm/s^2
  std::vector<WindowFinding> windows = windows_of(0.2);
  const auto size = [&] {
    const std::vector<ChangeInTime> changes = changes_in_time(windows);
    REQUIRE(changes.size() == 1);
    return changes.front().size;
  };
  CHECK(size() == Approx(0.04 / std::sqrt(2.0)).epsilon(0.2));
  for (std::size_t i = 0; i < windows.size(); i += 3) {  // ten times as far, and hardly sure of it
    windows[i].slope[kSideways] *= 1e-5;
    windows[i].curvature[kSideways] *= 1e-6;
  }
  CHECK(size() < 0.04);
}

TEST_CASE("noise changes in less than one of a hundred recordings, however large; so does a constant") {
  std::mt19937 generator(test::fresh_seed());
  int found = 0;
  for (int i = 0; i < 400; ++i)
    found += static_cast<int>(changes_in_time(seen(
                                                  kSideways, 60, [](double) { return 0.5; },
                                                  static_cast<std::uint32_t>(generator())))
                                  .size());
  CHECK(found <= 4);
}

TEST_CASE("what lies in events, across a gap or in another recording is no neighbour") {
  const std::uint32_t seed = test::fresh_seed();
  std::vector<WindowFinding> windows = seen(kSideways, 120, wave, seed), gaps = windows, takes = windows;
  for (WindowFinding& w : windows) w.eventful = true;
  CHECK(changes_in_time(windows).empty());
  for (WindowFinding& w : gaps) w.begin *= 3.0, w.end *= 3.0;
  CHECK(changes_in_time(gaps).empty());
  for (std::size_t i = 0; i < takes.size(); ++i) takes[i].recording = i;
  CHECK(changes_in_time(takes).empty());
}

TEST_CASE("a single window far off does not make all others agree") {
  std::vector<WindowFinding> windows = seen(
      kSideways, 120, [](double) { return 0.0; }, test::fresh_seed());
  windows[30].slope[kSideways] = 1e4;
  CHECK(changes_in_time(windows).empty());
}
