// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <utility>

#include "diabolo/robot/control/arm_monitor.hpp"
#include "diabolo/robot/control/loaded_plan.hpp"
#include "diabolo/robot/control/plan_clock.hpp"
#include "diabolo/robot/control/setpoint_guard.hpp"
#include "diabolo/text/shown.hpp"

namespace diabolo {

/// Times of the control loop [s].
struct ControlOptions {
  double stale_after = 0.010;  ///< without news from a controller: five ticks
  double late_after = 0.010;   ///< between two ticks of the loop itself
  double connect_within = 10;  ///< both arms
  double home_within = 60;     ///< each arm
  double recover_after = 5;    ///< a protective stop cannot be released sooner
  double recover_within = 15;  ///< for the safety state to become normal
  double fade = 0.5;           ///< from where the arms are to where the plan begins
  double arrived = 0.01;       ///< [rad] from a goal
};

/// Plays plans on two arms, tick by tick, and stops both when anything is wrong with one. A stop is latched
/// until a person has it recover. Call everything from one thread; nothing in tick() blocks or takes memory.
/// This is no safety function: see docs/robot.md.
class TwoArmControl {
 public:
  TwoArmControl(SetpointGuard guard, ArmLink& left, ArmLink& right, const ControlOptions& options = {})
      : guard_(std::move(guard)),
        links_{&left, &right},
        monitors_{ArmMonitor(Side::kLeft, options.stale_after),
                  ArmMonitor(Side::kRight, options.stale_after)},
        options_(options),
        clock_(guard_.options().stop_time) {}

  ControlState state() const { return state_; }
  const ControlFault& fault() const { return fault_; }  ///< of the last stop
  const ArmReading& reading(Side side) const { return monitors_[index(side)].reading(); }
  /// Time of the running plan in ticks since its first setpoint.
  double plan_ticks() const { return clock_.ticks() - joined_at_; }

  // The person's commands: each returns an empty text, or why it is refused.

  std::string connect(double now) {
    if (state_ != ControlState::kDisconnected) return refusal("connect");
    for (ArmLink* link : links_) link->begin_connect();
    enter(ControlState::kConnecting, now);
    return {};
  }

  /// Moves the left arm and then the right one, each in a straight line of its joints [rad].
  std::string home(const PairJoints& goal, double now) {
    if (state_ != ControlState::kIdle && state_ != ControlState::kReady) return refusal("home");
    PairJoints joints = actual();
    for (const Side side : {Side::kLeft, Side::kRight}) {
      if (!guard_.way_is_clear(joints, goal, side))
        return std::string("home: the ") + name_of(side) +
               " arm's way comes too close to the other arm, or leaves its joint ranges; move it by hand "
               "first";
      set_half(joints, goal, side);
    }
    goal_ = goal;
    homing_ = Side::kLeft;
    enter(ControlState::kHoming, now);
    if (!links_[0]->begin_move(SetpointGuard::half(goal, Side::kLeft)))
      halt({ControlFaultKind::kRefused, Side::kLeft, now});
    return {};
  }

  /// Plays a plan whose first setpoint is where home() went.
  std::string run(std::shared_ptr<const LoadedPlan> plan, double now) {
    if (state_ != ControlState::kReady) return refusal("run");
    const PairJoints at = actual(), begin = plan->at(0);
    const double gap = (at - begin).cwiseAbs().maxCoeff();
    if (!(gap <= 1.2 * options_.arrived))  // fading it out must not break the limits
      return "run: the arms are " + shown_rounded(gap) +
             " rad from where the plan begins; go home there first";
    guard_.begin(at);
    gap_ = at - begin;
    plan_ = std::move(plan);
    waiting_ = false;
    clock_.start();
    joined_at_ = 0;
    fault_ = {};
    enter(ControlState::kRunning, now);
    return {};
  }

  /// Takes up a plan that StickPlanner::replace() made of the running one at a tick of it, which must not
  /// have passed.
  std::string replace(std::shared_ptr<const LoadedPlan> plan, double tick) {
    if (state_ != ControlState::kRunning) return refusal("replace");
    if (!(tick >= plan_ticks()))
      return "replace: tick " + shown_rounded(tick) + " has passed, the plan is at " +
             shown_rounded(plan_ticks());
    if (!((plan->at(0) - plan_->at(tick)).cwiseAbs().maxCoeff() <= 1e-9))
      return "replace: the plan does not begin where the running one is at tick " + shown_rounded(tick);
    next_ = std::move(plan);
    next_tick_ = tick;
    waiting_ = true;
    return {};
  }

  /// Brakes both arms along the plan's path; then idle.
  void stop(double now) {
    if (state_ == ControlState::kRunning) brake({}, now);
    if (state_ == ControlState::kHoming) halt({});
  }

  /// After a fault, when the person has seen to its cause.
  std::string recover(double now) {
    if (state_ != ControlState::kFaulted) return refusal("recover");
    if (now - since_ < options_.recover_after)
      return "recover: a stop can be released " + shown(options_.recover_after) +
             " s after it at the soonest";
    for (const Side side : {Side::kLeft, Side::kRight})
      if (reading(side).emergency_stop)
        return std::string("recover: the ") + name_of(side) + " arm's emergency stop is still pressed";
    for (std::size_t i = 0; i < 2; ++i) {
      const ArmReading& read = monitors_[i].reading();
      if (read.link == LinkState::kLost || read.link == LinkState::kDisconnected)
        links_[i]->begin_connect();
      else if (read.protective_stop || !read.program_running)
        links_[i]->begin_unlock();
    }
    enter(ControlState::kRecovering, now);
    return {};
  }

  /// One turn of the loop, each kTick; `now` [s] on a clock that never runs back.
  void tick(double now) {
    const bool late = ticked_ && now - last_ > options_.late_after;
    ticked_ = true;
    last_ = now;
    for (std::size_t i = 0; i < 2; ++i) monitors_[i].update(links_[i]->read(), now);
    switch (state_) {
      case ControlState::kDisconnected:
      case ControlState::kFaulted:
        break;
      case ControlState::kConnecting:
        wait_for_both(now, options_.connect_within, ControlFaultKind::kConnect);
        break;
      case ControlState::kRecovering:
        wait_for_both(now, options_.recover_within, ControlFaultKind::kRecovery);
        break;
      case ControlState::kIdle:
      case ControlState::kReady:
        if (const ControlFault found = trouble(now); found.kind != ControlFaultKind::kNone) halt(found);
        break;
      case ControlState::kHoming:
        go_home(now);
        break;
      case ControlState::kRunning: {
        ControlFault found = trouble(now);
        if (found.kind == ControlFaultKind::kNone && late)
          found = {ControlFaultKind::kLate, Side::kLeft, now};
        if (found.kind != ControlFaultKind::kNone) brake(found, now);
        play(now);
        break;
      }
      case ControlState::kStopping:
        play(now);
        break;
    }
  }

 private:
  static std::size_t index(Side side) { return side == Side::kLeft ? 0 : 1; }
  static void set_half(PairJoints& joints, const PairJoints& from, Side side) {
    if (side == Side::kLeft)
      joints.head<kJointCount>() = from.head<kJointCount>();
    else
      joints.tail<kJointCount>() = from.tail<kJointCount>();
  }

  std::string refusal(const char* command) const {
    return std::string(command) + ": not while the control is " + name_of(state_);
  }
  void enter(ControlState state, double now) {
    state_ = state;
    since_ = now;
  }
  PairJoints actual() const {
    PairJoints joints;
    joints << reading(Side::kLeft).actual, reading(Side::kRight).actual;
    return joints;
  }
  ControlFault trouble(double now) const {
    const ControlFault left = monitors_[0].fault(now);
    return left.kind != ControlFaultKind::kNone ? left : monitors_[1].fault(now);
  }

  void wait_for_both(double now, double within, ControlFaultKind otherwise) {
    const ControlFault found = trouble(now);
    if (found.kind == ControlFaultKind::kNone)
      enter(ControlState::kIdle, now);
    else if (now - since_ > within)
      halt({otherwise, found.side, now});
  }

  void go_home(double now) {
    ControlFault found = trouble(now);
    if (found.kind == ControlFaultKind::kNone && now - since_ > options_.home_within)
      found = {ControlFaultKind::kHome, homing_, now};
    if (found.kind != ControlFaultKind::kNone) return halt(found);
    const Joints<double> goal = SetpointGuard::half(goal_, homing_);
    const ArmReading& read = reading(homing_);
    if (read.moving || !((read.actual - goal).cwiseAbs().maxCoeff() <= options_.arrived)) return;
    if (homing_ == Side::kRight) return enter(ControlState::kReady, now);
    homing_ = Side::kRight;
    since_ = now;
    if (!links_[1]->begin_move(SetpointGuard::half(goal_, Side::kRight)))
      halt({ControlFaultKind::kRefused, Side::kRight, now});
  }

  /// From here on down to rest, both arms, along the path.
  void brake(const ControlFault& fault, double now) {
    fault_ = fault;
    clock_.stop();
    enter(ControlState::kStopping, now);
  }

  /// Leaves coming to rest to the controllers: where there is no path to brake along.
  void halt(const ControlFault& fault) {
    fault_ = fault;
    for (ArmLink* link : links_) link->stop();
    enter(fault.kind == ControlFaultKind::kNone ? ControlState::kIdle : ControlState::kFaulted, last_);
  }

  /// Sends the next setpoint of the plan, or of coming to rest on it.
  void play(double now) {
    const double scaling = std::min(reading(Side::kLeft).speed_scaling, reading(Side::kRight).speed_scaling);
    const double ticks = clock_.advance(scaling);
    if (waiting_ && ticks - joined_at_ >= next_tick_ && !clock_.stopping()) {
      std::swap(plan_, next_);  // the old one is freed by the next command, not in the loop
      waiting_ = false;
      joined_at_ += next_tick_;
    }
    const double fade = 1 - smooth_step(ticks * kTick / options_.fade);
    const PairJoints setpoint = plan_->at(ticks - joined_at_) + fade * gap_;
    ControlFault found = guard_.check(setpoint, actual(), state_ == ControlState::kStopping);
    if (found.kind == ControlFaultKind::kTracking || found.kind == ControlFaultKind::kClearance ||
        found.kind == ControlFaultKind::kString) {  // the path itself is sound: brake on it
      brake({found.kind, found.side, now}, now);
      found = guard_.check(setpoint, actual(), true);
    }
    if (found.kind != ControlFaultKind::kNone)
      return halt(fault_.kind != ControlFaultKind::kNone ? fault_
                                                         : ControlFault{found.kind, found.side, now});
    for (std::size_t i = 0; i < 2; ++i) {
      const Side side = i == 0 ? Side::kLeft : Side::kRight;
      if (monitors_[i].fault(now).kind != ControlFaultKind::kNone) continue;  // it takes none
      if (links_[i]->servo(SetpointGuard::half(setpoint, side)) || state_ == ControlState::kStopping)
        continue;
      brake({ControlFaultKind::kRefused, side, now}, now);
    }
    if (clock_.at_rest()) halt(fault_);
  }

  SetpointGuard guard_;
  std::array<ArmLink*, 2> links_;
  std::array<ArmMonitor, 2> monitors_;
  ControlOptions options_;
  PlanClock clock_;
  ControlState state_ = ControlState::kDisconnected;
  ControlFault fault_;
  double since_ = 0, last_ = 0;
  bool ticked_ = false, waiting_ = false;  ///< waiting: for the tick at which `next_` takes over
  PairJoints goal_ = PairJoints::Zero(), gap_ = PairJoints::Zero();
  Side homing_ = Side::kLeft;
  std::shared_ptr<const LoadedPlan> plan_, next_;
  double next_tick_ = 0, joined_at_ = 0;
};

}  // namespace diabolo
