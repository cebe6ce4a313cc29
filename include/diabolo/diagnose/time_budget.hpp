// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "diabolo/math/parallel.hpp"

namespace diabolo {

/// How the fits of a diagnosis are watched and stopped. `enough` may be empty; once it is true it stays so:
/// what runs ends where it stands, and says nothing that it has not settled.
struct FitWatch : Watch {
  std::function<bool()> enough;

  bool is_enough() const { return enough && enough(); }
};

/// Shares of the budget after which no fit goes on, no trial beside what was found, and no comparison of
/// rules. What is left is for the comparison on data left out.
inline constexpr double kFitsShare = 0.8, kTrialsShare = 0.87, kRulesShare = 0.93;

/// Watches work of unknown length that comes in rounds, each of which tells its fraction: what is reported
/// goes from `begin` towards `end` and slows down on the way, half of which is some twenty rounds.
inline std::function<void(double)> towards(double begin, double end,
                                           const std::function<void(double)>& report) {
  constexpr double kRounds = 30.0;
  return [=, rounds = 0.0, before = 0.0](double fraction) mutable {
    if (fraction < before) rounds += 1.0;
    before = fraction;
    report(begin + (end - begin) * (1.0 - std::exp(-(rounds + fraction) / kRounds)));
  };
}

/// The time that a diagnosis may take, and what was not done for want of it.
class TimeBudget {
 public:
  /// Tells the time since some instant [s].
  using Clock = std::function<double()>;

  static double steady_seconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
  }

  explicit TimeBudget(double seconds, Clock clock = {})
      : clock_(clock ? std::move(clock) : Clock(steady_seconds)), seconds_(seconds), begin_(clock_()) {}

  double seconds() const { return seconds_; }
  /// Since the diagnosis began [s].
  double elapsed() const { return clock_() - begin_; }
  /// Whether this share of the time is over.
  bool spent(double share = 1.0) const { return elapsed() >= share * seconds_; }

  /// Whether there is time for `what` within this share; else notes it.
  bool allows(const std::string& what, double share) {
    if (!spent(share)) return true;
    leave(what);
    return false;
  }

  /// Notes what is not done, or not to its end.
  void leave(const std::string& what) { left_.push_back(beyond(what)); }
  static std::string beyond(const std::string& what) { return what + " (beyond the budget)"; }
  const std::vector<std::string>& left() const { return left_; }

 private:
  Clock clock_;
  double seconds_, begin_;
  std::vector<std::string> left_;
};

}  // namespace diabolo
