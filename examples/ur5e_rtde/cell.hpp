// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "diabolo/robot/arm/build_seed_grid.hpp"
#include "diabolo/robot/control/two_arm_control.hpp"
#include "rtde_arm.hpp"
#include "session_recording.hpp"
#include "tick_clock.hpp"

namespace ur5e {

/// A planner for the paper's two arms.
inline diabolo::StickPlanner paper_planner(
    const diabolo::JointLimits& limits = diabolo::JointLimits::uniform(),
    const diabolo::Mounts& mounts = {}) {
  const auto map = [&mounts](diabolo::Side side) {
    const diabolo::StickArm arm = diabolo::paper_arm(side, mounts);
    return diabolo::StickMap(arm, diabolo::build_seed_grid(arm, diabolo::paper_box(arm)));
  };
  return {map(diabolo::Side::kLeft), map(diabolo::Side::kRight), limits};
}

/// Slower, or faster: `speed` times as fast.
inline diabolo::TipMotion<double> at_speed(const diabolo::TipMotion<double>& motion, double speed) {
  std::vector<double> times;
  std::vector<diabolo::Vector3<double>> left, right;
  for (std::size_t i = 0; i < motion.size(); ++i) {
    times.push_back(motion.times()[i] / speed);
    left.push_back(motion.pose(i).left);
    right.push_back(motion.pose(i).right);
  }
  return {times, left, right, motion.interpolation()};
}

/// The two arms' controllers, by name or address, and what the control keeps to.
struct CellOptions {
  std::string client;  ///< path of ur5e_arm_client
  std::string left, right;
  ArmSettings settings{};
  diabolo::GuardOptions guard{};
  diabolo::ControlOptions control{};
  double longest_session = 300;  ///< [s] that is recorded
};

/// Two arms, their control, and the loop that drives it 500 times a second.
class Cell {
 public:
  /// Throws as RtdeArm does.
  Cell(const diabolo::StickPlanner& planner, const CellOptions& options)
      : left_arm_(planner.left().arm()),
        right_arm_(planner.right().arm()),
        left(options.client, options.left, options.settings),
        right(options.client, options.right, options.settings),
        control(diabolo::SetpointGuard(left_arm_, planner.left().grid().box(), right_arm_,
                                       planner.right().grid().box(), planner.limits(), options.guard),
                left, right, options.control),
        session(static_cast<std::size_t>(options.longest_session / diabolo::kTick)) {}

  /// One turn of the loop.
  void tick() {
    now = clock_.wait();
    control.tick(now);
    const bool plays = control.state() == diabolo::ControlState::kRunning ||
                       control.state() == diabolo::ControlState::kStopping;
    if (!plays || !left.sent() || !right.sent()) return;
    diabolo::PairJoints commanded, actual;
    commanded << *left.sent(), *right.sent();
    actual << control.reading(diabolo::Side::kLeft).actual, control.reading(diabolo::Side::kRight).actual;
    session.add(now, commanded, actual);
  }
  /// Turns until the state is reached; false after `seconds`, or where `cut_short` says so.
  bool until(diabolo::ControlState state, double seconds, const std::function<bool()>& cut_short = {}) {
    for (const double end = TickClock::now() + seconds; TickClock::now() < end;) {
      tick();
      if (control.state() == state) return true;
      if (cut_short && cut_short()) return false;
    }
    return false;
  }
  void wait(double seconds) {
    for (const double end = TickClock::now() + seconds; TickClock::now() < end;) tick();
  }
  /// Brakes along the path where a plan runs, then has both clients stop their programs.
  void end() {
    if (control.state() == diabolo::ControlState::kRunning ||
        control.state() == diabolo::ControlState::kHoming)
      control.stop(now);
    if (control.state() == diabolo::ControlState::kStopping)
      until(diabolo::ControlState::kIdle, 1,
            [this] { return control.state() == diabolo::ControlState::kFaulted; });
    left.end();
    right.end();
  }
  void save(const std::filesystem::path& path) const { session.save(left_arm_, right_arm_, path); }

 private:
  diabolo::StickArm left_arm_, right_arm_;
  TickClock clock_;

 public:
  RtdeArm left, right;
  diabolo::TwoArmControl control;
  SessionRecording session;
  double now = TickClock::now();  ///< of the last turn [s]
};

}  // namespace ur5e
