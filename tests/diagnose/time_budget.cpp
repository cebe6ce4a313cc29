// SPDX-License-Identifier: MIT
#include "diabolo/diagnose/time_budget.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "catch.hpp"
#include "diabolo/diagnose/compiled.hpp"
#include "diabolo/diagnose/diagnosis.hpp"

#include "played.hpp"

using namespace diabolo;

TEST_CASE("a budget holds by what is predicted, and what it leaves is told") {
  // A clock that goes on by the work alone: by one thread, each prediction is looked at once.
  long predictions = 0;
  DiagnosisWatch watch;
  watch.cancelled = [&] { return ++predictions < 0; };
  watch.clock = [&] { return 1e-3 * static_cast<double>(predictions); };
  DiagnosisOptions options;
  options.threads = 1;
  const std::vector<Recording> takes{played({}, 30.0, 12)};
  const auto diagnosed = [&](double budget) {
    options.budget = budget;
    predictions = 0;
    return diagnose(takes, options, watch);
  };
  const Diagnosis whole = diagnosed(1e9);
  const double wanted = watch.clock();
  CHECK(whole.not_done.empty());
  CHECK(whole.windows.size() == whole.windows_seen);
  REQUIRE(whole.adequacy.adequate);
  for (const double share : {0.9, 0.8, 0.7, 0.5, 0.2}) {
    const double budget = share * wanted;
    const Diagnosis hurried = diagnosed(budget);
    CAPTURE(share, wanted);
    CHECK(watch.clock() < 1.2 * budget);
    CHECK_FALSE(hurried.not_done.empty());
    // What was begun and not ended is not told.
    const bool judged = std::ranges::none_of(
        hurried.not_done, [](const std::string& left) { return left.starts_with("asking what noise"); });
    CHECK(judged == hurried.adequacy.adequate.has_value());
    CHECK(judged == std::isfinite(hurried.windows.front().residual_noise));
  }
  const Diagnosis nothing = diagnosed(1e-6);
  CHECK(nothing.headline == Headline::kInsufficientData);
  CHECK(nothing.sentence.find("budget") != std::string::npos);
}
