// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <vector>

#include "diabolo/robot/motion/joint_path.hpp"
#include "diabolo/robot/motion/time_stretch.hpp"

namespace diabolo {

/// A path in setpoints one tick apart that keep the limits.
struct LimitedMotion {
  TimeStretch stretch;
  std::vector<PairJoints> setpoints;  ///< [rad], from the path's first point on; the last one is its end
  std::vector<double> planned;        ///< [s] of each setpoint: the time of the path that it belongs to
  bool within = false;                ///< the limits hold; else `excess` says by how much not
  double excess = 0;                  ///< largest of diabolo::excess()
  double excess_at = 0;               ///< where [s] of planned time
  int rounds = 0;
};

/// Plays a path as fast as planned where the limits allow it, and more slowly elsewhere: what is too fast is
/// stretched together with its surroundings, round by round, until every setpoint keeps the limits. The
/// path's curve stays as it is. Its first `untouched` seconds are played as planned, to join what runs. Not
/// the fastest possible motion, but one that any computer finds in a bounded time.
class LimitKeeper {
 public:
  LimitKeeper(const JointPath& path, const JointLimits& limits, double untouched = 0.0)
      : path_(path), limits_(limits), untouched_(untouched) {
    check_limits(limits);
  }

  LimitedMotion run() const {
    LimitedMotion motion{TimeStretch(path_.length()), {}, {}};
    for (; motion.rounds < kMostRounds; ++motion.rounds) {
      play(motion);
      if (motion.within) break;
      const std::vector<double> needed = needs(motion);
      const std::vector<double> by = spread(needed);
      motion.stretch.scale(by);
      if (motion.stretch.duration() > kLongest * path_.length() + 1.0) break;
    }
    return motion;
  }

 private:
  static constexpr int kMostRounds = 200;
  static constexpr double kLongest = 100.0;  // times as long as planned: such a path is not to be played
  static constexpr double kWithin = 0.999;   // of the limits is aimed at
  static constexpr int kReach = 4;           // coefficients on each side that slow down with the one in need

  void play(LimitedMotion& motion) const {
    const std::size_t count =
        static_cast<std::size_t>(std::ceil(motion.stretch.duration() / kTick - 1e-9)) + 1;
    motion.setpoints.resize(count);
    motion.planned.resize(count);
    double hint = 0;
    for (std::size_t i = 0; i < count; ++i) {
      motion.planned[i] = motion.stretch.planned(static_cast<double>(i) * kTick, hint);
      motion.setpoints[i] = path_.at(motion.planned[i]);
    }
    motion.excess = 0;
    for (std::size_t i = 1; i < count + 3; ++i) {
      const double found = excess_of(motion, i);
      if (found <= motion.excess) continue;
      motion.excess = found;
      motion.excess_at = motion.planned[std::min(i, count - 1)];
    }
    motion.within = motion.excess <= 1.0;
  }

  /// Of the setpoint `i` and the three before; beyond both ends the arms rest.
  double excess_of(const LimitedMotion& motion, std::size_t i) const {
    const auto at = [&](std::size_t back) -> const PairJoints& {
      return motion.setpoints[std::min(i < back ? 0 : i - back, motion.setpoints.size() - 1)];
    };
    // A path that joins a running motion begins in the midst of it.
    if (untouched_ > 0 && i < 3) return 0;
    return excess(at(3), at(2), at(1), at(0), limits_);
  }

  /// The factor that each coefficient lacks.
  std::vector<double> needs(const LimitedMotion& motion) const {
    std::vector<double> needed(motion.stretch.factors().size(), 1.0);
    for (std::size_t i = 1; i < motion.setpoints.size() + 3; ++i) {
      const double found = excess_of(motion, i) / kWithin;
      if (found <= 1.0) continue;
      const double planned = motion.planned[std::min(i, motion.planned.size() - 1)];
      const std::size_t k = std::min(static_cast<std::size_t>(std::lround(planned / TimeStretch::kKnot)) + 1,
                                     needed.size() - 1);
      needed[k] = std::max(needed[k], found);
    }
    return needed;
  }

  /// The needs, each taken by its neighbours too and faded out on both sides.
  std::vector<double> spread(const std::vector<double>& needed) const {
    const int n = static_cast<int>(needed.size());
    const auto at = [n](const std::vector<double>& values, int i) {
      return values[static_cast<std::size_t>(std::clamp(i, 0, n - 1))];
    };
    std::vector<double> wide(needed.size()), smooth(needed.size());
    for (int i = 0; i < n; ++i)
      for (int k = -kReach; k <= kReach; ++k)
        wide[static_cast<std::size_t>(i)] = std::max(wide[static_cast<std::size_t>(i)], at(needed, i + k));
    for (int round = 0; round < 2; ++round) {
      for (int i = 0; i < n; ++i) {
        double sum = 0;
        for (int k = -kReach / 2; k <= kReach / 2; ++k) sum += at(wide, i + k);
        smooth[static_cast<std::size_t>(i)] = sum / (kReach + 1);
      }
      wide = smooth;
    }
    const int held = untouched_ > 0 ? static_cast<int>(std::ceil(untouched_ / TimeStretch::kKnot)) + 3 : 0;
    for (int i = 0; i < std::min(held, n); ++i) smooth[static_cast<std::size_t>(i)] = 1.0;
    return smooth;
  }

  const JointPath& path_;
  JointLimits limits_;
  double untouched_;
};

inline LimitedMotion keep_limits(const JointPath& path, const JointLimits& limits, double untouched = 0.0) {
  return LimitKeeper(path, limits, untouched).run();
}

}  // namespace diabolo
