// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "../../../tests/catch.hpp"
#include "../cell.hpp"
#include "../stand_in/server.hpp"
#include "loopback.hpp"

/// Two stand-in controllers on loopback addresses, and the cell that plays on them through the real client.
namespace arms {

using namespace diabolo;
using ur5e::TickClock;

inline const StickPlanner& planner() {
  static const StickPlanner plans = ur5e::paper_planner();
  return plans;
}

/// Both tips on circles in the upright plane: radius [m] times rate [rad/s] is their speed.
inline TipMotion<double> circles(double seconds, double rate, double radius = 0.3, double start = 0) {
  std::vector<double> times;
  std::vector<Vector3<double>> left, right;
  for (double t = 0; t <= seconds; t += 1.0 / 120) {
    const double a = rate * (start + t);
    const Vector3<double> at{0, radius * std::cos(a), radius * std::sin(a)};
    times.push_back(t);
    left.push_back(Vector3<double>(0.6, 0.55, 1.25) + at);
    right.push_back(Vector3<double>(0.6, -0.55, 1.25) + at);
  }
  return TipMotion<double>(times, left, right, Interpolation::kSpline);
}

/// Patient, since the machine of a test is not the cell's: ticks may come late by half a second.
inline ur5e::CellOptions patient() {
  ur5e::CellOptions options;
  options.client = UR5E_CLIENT;
  options.left = loopback_address(0);
  options.right = loopback_address(1);
  options.settings.slow_call = 0.5;
  options.settings.move_speed = 1;
  options.settings.move_acceleration = 4;
  options.settings.watchdog = 1;
  options.guard.tracking = 1.0;  // so that a silence is told as one
  options.control.stale_after = options.control.late_after = 0.5;
  options.control.recover_after = 0.3;
  return options;
}

struct Bench {
  explicit Bench(const StickPlan& plan, const ur5e::CellOptions& given = patient())
      : first(plan.setpoints.front()), options(given), cell(planner(), options) {
    start(Side::kLeft);
    start(Side::kRight);
  }
  ~Bench() { cell.end(); }

  std::unique_ptr<stand_in::Server>& server(Side side) { return servers[side == Side::kLeft ? 0 : 1]; }
  /// A controller, its arm a little off where the plan begins.
  void start(Side side) {
    const double off = side == Side::kLeft ? 0.03 : -0.03;
    Joints<double> joints = SetpointGuard::half(first, side) + Joints<double>::Constant(off);
    joints[5] -= off;
    server(side).reset();
    server(side) =
        std::make_unique<stand_in::Server>(loopback_address(side == Side::kLeft ? 0 : 1), joints, 120);
    while (server(side)->ticks().empty()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }

  void connect() {
    REQUIRE(cell.control.connect(cell.now).empty());
    const bool connected = cell.until(ControlState::kIdle, 12);
    INFO(text_of(cell.control.fault()) << "; " << cell.left.trouble() << "; " << cell.right.trouble());
    REQUIRE(connected);
  }
  void go_home() {
    REQUIRE(cell.control.home(first, cell.now) == "");
    const bool home = cell.until(ControlState::kReady, 20);
    INFO(text_of(cell.control.fault()) << "; " << cell.left.trouble() << "; " << cell.right.trouble());
    REQUIRE(home);
  }
  void run(const StickPlan& plan) {
    REQUIRE(cell.control.run(std::make_shared<LoadedPlan>(plan), cell.now) == "");
  }
  void make_run(const StickPlan& plan) {
    connect();
    go_home();
    run(plan);
  }
  /// Until the plan has ended and the arms are at rest there.
  void play_out(const StickPlan& plan) {
    while (cell.control.state() == ControlState::kRunning &&
           cell.control.plan_ticks() < static_cast<double>(plan.setpoints.size()) + 150)
      cell.tick();
    INFO(text_of(cell.control.fault()) << "; " << cell.left.trouble() << "; " << cell.right.trouble());
    REQUIRE(cell.control.state() == ControlState::kRunning);
  }
  std::vector<Joints<double>> setpoints(Side side) {
    std::vector<Joints<double>> all;
    for (const stand_in::Arrival& arrival : server(side)->arrivals()) all.push_back(arrival.setpoint);
    return all;
  }

  PairJoints first;
  ur5e::CellOptions options;
  std::unique_ptr<stand_in::Server> servers[2];
  ur5e::Cell cell;
};

/// The longest that a controller waited for its next setpoint [s].
inline double longest_wait(const stand_in::Server& server) {
  double longest = 0;
  const std::vector<stand_in::Arrival> arrivals = server.arrivals();
  for (std::size_t i = 1; i < arrivals.size(); ++i)
    longest = std::max(longest, arrivals[i].time - arrivals[i - 1].time);
  return longest;
}

/// How much the setpoints of an arm go beyond the limits: 1 is at them.
inline double largest_excess(const std::vector<Joints<double>>& setpoints, std::size_t from = 0) {
  double largest = 0;
  const auto both = [&](std::size_t i) { return PairJoints(setpoints[i].replicate<2, 1>()); };
  for (std::size_t i = from + 3; i < setpoints.size(); ++i)
    largest = std::max(largest, excess(both(i - 3), both(i - 2), both(i - 1), both(i), planner().limits()));
  return largest;
}

}  // namespace arms
