// SPDX-License-Identifier: MIT
#include "motion.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "random.hpp"

namespace plant {
namespace {

constexpr double kLongestMotion = 3600.0;  // [s]
constexpr double kKnotSpacing = 0.04;      // [s], of holds and moves
constexpr int kKnotsPerCycle = 24;
constexpr int kWanderTones = 8;
constexpr std::uint64_t kWanderStream = 100;  // the cameras draw from the streams below
constexpr double kTwoPi = 2.0 * std::numbers::pi;

/// From 0 to 1 with least jerk.
double least_jerk(double phase) { return LeastJerk(phase).value; }

CubicSpline<10>::Values offset_knot(const Pair<Vec3>& offsets) {
  CubicSpline<10>::Values knot = CubicSpline<10>::Values::Zero();
  knot << offsets[0], offsets[1], 0.0, 0.0, 0.0, 0.0;
  return knot;
}

int knot_count(double duration) { return std::max(8, static_cast<int>(std::ceil(duration / kKnotSpacing))); }

}  // namespace

Pair<Stick> Motion::at(double time) const {
  const CubicSpline<10>::Sample sample = spline_.at(time);
  Pair<Stick> sticks;
  for (std::size_t side = 0; side < 2; ++side) {
    const Eigen::Index tip = 3 * static_cast<Eigen::Index>(side);
    const Eigen::Index angles = 6 + 2 * static_cast<Eigen::Index>(side);
    Stick& stick = sticks[side];
    stick.tip = sample.value.segment<3>(tip);
    stick.velocity = sample.rate.segment<3>(tip);
    stick.acceleration = sample.second_rate.segment<3>(tip);
    stick.direction = direction_from_angles(sample.value(angles), sample.value(angles + 1));
  }
  for (const Reach& reach : reaches_) {
    if (!(time > reach.begin)) continue;
    const LeastJerk share = reach.share(time);
    for (std::size_t side = 0; side < 2; ++side) {
      sticks[side].tip += share.value * reach.offsets[side];
      sticks[side].velocity += share.rate * reach.offsets[side];
      sticks[side].acceleration += share.second_rate * reach.offsets[side];
    }
  }
  if (push_ && time >= push_->begin) {
    const double passed = time - push_->begin;
    for (std::size_t side = 0; side < 2; ++side) {
      const Vec3& acceleration = push_->accelerations[side];
      sticks[side].tip = push_->tips[side] + passed * (push_->velocities[side] + 0.5 * passed * acceleration);
      sticks[side].velocity = push_->velocities[side] + passed * acceleration;
      sticks[side].acceleration = acceleration;
    }
  }
  return sticks;
}

Motion Motion::pushed(const Push& push) const {
  Motion motion = *this;
  motion.push_ = push;
  return motion;
}

Motion Motion::reaching(const Reach& reach) const {
  Motion motion = *this;
  motion.reaches_.push_back(reach);
  return motion;
}

MotionBuilder::MotionBuilder(const SticksPose& start) {
  Knot knot;
  knot << start.tips[0], start.tips[1], start.yaws[0], start.pitches[0], start.yaws[1], start.pitches[1];
  add(0.0, knot);
}

void MotionBuilder::add(double time, const Knot& knot) {
  if (!times_.empty() && !(time > times_.back())) throw std::invalid_argument("motion: knot times must rise");
  if (!(time <= kLongestMotion)) throw std::invalid_argument("motion: lasts more than an hour");
  times_.push_back(time);
  knots_.push_back(knot);
}

Pair<Vec3> MotionBuilder::home() const { return {knots_.back().segment<3>(0), knots_.back().segment<3>(3)}; }

void MotionBuilder::hold(double duration) { move(duration, {Vec3::Zero(), Vec3::Zero()}); }

void MotionBuilder::move(double duration, const Pair<Vec3>& offsets) {
  const double start = times_.back();
  const Knot home = knots_.back();
  const Knot offset = offset_knot(offsets);
  const int count = knot_count(duration);
  for (int i = 1; i <= count; ++i) {
    const double phase = static_cast<double>(i) / count;
    add(start + duration * phase, home + least_jerk(phase) * offset);
  }
}

template <typename Wave>
void MotionBuilder::repeat(double frequency, double cycles, const Wave& wave) {
  const double start = times_.back();
  const Knot home = knots_.back();
  const double ease = std::min(1.0, 0.5 * cycles);
  const int count = std::max(4, static_cast<int>(std::ceil(cycles * kKnotsPerCycle)));
  for (int i = 1; i <= count; ++i) {
    const double turns = cycles * i / count;
    const double envelope = least_jerk(std::min({1.0, turns / ease, (cycles - turns) / ease}));
    add(start + turns / frequency, home + envelope * wave(kTwoPi * turns));
  }
}

void MotionBuilder::oscillate(const Pair<Vec3>& amplitudes, double frequency, double cycles) {
  const Knot amplitude = offset_knot(amplitudes);
  repeat(frequency, cycles, [&](double phase) -> Knot { return std::sin(phase) * amplitude; });
}

void MotionBuilder::turn(const Pair<double>& yaws, const Pair<double>& pitches, double frequency,
                         double cycles) {
  Knot amplitude = Knot::Zero();
  amplitude.tail<4>() << yaws[0], pitches[0], yaws[1], pitches[1];
  repeat(frequency, cycles, [&](double phase) -> Knot { return std::sin(phase) * amplitude; });
}

void MotionBuilder::path(const std::vector<double>& times, const Pair<std::vector<Vec3>>& offsets) {
  const double start = times_.back();
  const Knot home = knots_.back();
  for (std::size_t i = 0; i < times.size(); ++i) {
    add(start + times[i], home + offset_knot({offsets[0][i], offsets[1][i]}));
  }
}

Motion MotionBuilder::finish(const Wander& wander, std::uint64_t seed) const {
  Knot deviation;
  deviation << Eigen::Vector<double, 6>::Constant(wander.tips), Eigen::Vector4d::Constant(wander.directions);
  std::vector<Knot> knots = knots_;
  for (int quantity = 0; quantity < knots.front().size(); ++quantity) {
    RandomStream random(seed, kWanderStream + static_cast<std::uint64_t>(quantity));
    for (int tone = 0; tone < kWanderTones; ++tone) {
      const double amplitude = deviation(quantity) * std::sqrt(2.0 / kWanderTones);
      const double frequency = wander.slowest + (wander.fastest - wander.slowest) * random.uniform();
      const double phase = kTwoPi * random.uniform();
      for (std::size_t i = 0; i < knots.size(); ++i) {
        const double onset = least_jerk(std::min({1.0, times_[i], times_.back() - times_[i]}));
        knots[i](quantity) += onset * amplitude * std::sin(kTwoPi * frequency * times_[i] + phase);
      }
    }
  }
  return Motion(CubicSpline<10>(times_, knots));
}

}  // namespace plant
