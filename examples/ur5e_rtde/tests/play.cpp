// SPDX-License-Identifier: MIT
// Plans played on two stand-in controllers through the real client. Figures of time are printed, not judged:
// the machine of a test is no cell's.
#include <algorithm>
#include <cstdio>
#include <future>

#include "arms.hpp"
#include "diabolo/robot/control/servo_lag.hpp"

using namespace arms;

namespace {

double quantile(std::vector<double> values, double share) {
  std::ranges::sort(values);
  return values.empty() ? 0
                        : values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

void print_timing(Bench& bench) {
  const std::vector<stand_in::Arrival> left = bench.server(Side::kLeft)->arrivals(),
                                       right = bench.server(Side::kRight)->arrivals();
  std::vector<double> periods, skews;
  for (std::size_t i = 1; i < left.size(); ++i) periods.push_back(1e3 * (left[i].time - left[i - 1].time));
  for (std::size_t i = 0; i < std::min(left.size(), right.size()); ++i)
    skews.push_back(1e3 * std::abs(left[i].time - right[i].time));
  int ticks = 0, fresh = 0, bursts = 0;
  for (const stand_in::Tick& tick : bench.server(Side::kLeft)->ticks()) {
    if (tick.time < left.front().time || tick.time > left.back().time) continue;
    ++ticks;
    fresh += tick.commands > 0;
    bursts += tick.commands > 2;
  }
  std::printf(
      "timing: %zu setpoints, %.2f %% of %d ticks fresh, period mean %.4f p99 %.3f max %.2f ms, "
      "skew of the arms p99 %.3f ms, %d ticks with more than two\n",
      left.size(), 100.0 * fresh / ticks, ticks,
      1e3 * (left.back().time - left.front().time) / static_cast<double>(left.size() - 1),
      quantile(periods, 0.99), quantile(periods, 1), quantile(skews, 0.99), bursts);
}

}  // namespace

TEST_CASE("two arms connect, start without a bump, and play a person's speed within all limits") {
  // 2.7 m/s and 20 m/s^2, as a person's stick goes: the arms take longer, on the same circles.
  const double radius = 0.36;
  const StickPlan plan = planner().start(circles(2.0, 7.45, radius));
  REQUIRE(plan.ok());
  Bench bench(plan);
  const double begin = TickClock::now();
  bench.connect();
  std::printf(
      "connected after %.3f s; played %.2f times slower than planned, %.2f times where it is slowest\n",
      TickClock::now() - begin, plan.as_played / plan.as_planned, plan.worst_factor);
  bench.go_home();
  bench.run(plan);
  const Joints<double> left = bench.cell.control.reading(Side::kLeft).actual,
                       right = bench.cell.control.reading(Side::kRight).actual;
  bench.play_out(plan);
  bench.cell.wait(0.1);
  for (const auto& [side, actual] : {std::pair{Side::kLeft, left}, {Side::kRight, right}}) {
    const std::vector<Joints<double>> sent = bench.setpoints(side);
    REQUIRE(sent.size() > plan.setpoints.size() / 2);
    CHECK((sent.front() - actual).cwiseAbs().maxCoeff() <= 2e-5);
    CHECK((sent.back() - SetpointGuard::half(plan.setpoints.back(), side)).cwiseAbs().maxCoeff() <= 1e-9);
    const StickArm& arm = side == Side::kLeft ? planner().left().arm() : planner().right().arm();
    const Vector3<double> middle{0.6, side == Side::kLeft ? 0.55 : -0.55, 1.25};
    double off = 0;
    for (std::size_t i = 300; i < sent.size(); ++i) {  // from where the gap of going home has faded out
      const Vector3<double> at = arm.tip_at(sent[i]) - middle;
      off = std::max({off, std::abs(at.x()), std::abs(std::hypot(at.y(), at.z()) - radius)});
    }
    CHECK(off <= 1e-3);
    double fastest = 0;
    for (const stand_in::Tick& tick : bench.server(side)->ticks()) {
      fastest = std::max(fastest, tick.speed.cwiseAbs().maxCoeff());
      REQUIRE(tick.safety == stand_in::Controller::kNormal);
    }
    std::printf("%s arm: %.3g mm off the circle, at most %.3f rad/s\n", name_of(side), 1e3 * off, fastest);
    CHECK(fastest <= 3.2);
    // Where the machine lets a tick of the client slip, two setpoints in a row look like one step: count
    // those out.
    if (sent.size() == bench.cell.session.size()) CHECK(largest_excess(sent) <= 1.02);
  }
  CHECK(bench.cell.session.size() >= plan.setpoints.size());
  print_timing(bench);
}

TEST_CASE("motions that are replaced midway join smoothly") {
  const StickPlan begin = planner().start(circles(1.0, 4));
  REQUIRE(begin.ok());
  Bench bench(begin);
  bench.make_run(begin);
  StickPlan running = begin;
  unsigned state = 20261122;
  const auto random = [&state] {
    return static_cast<double>((state = state * 1664525u + 1013904223u) >> 8) / (1 << 24);
  };
  int joined = 0;
  constexpr int kMotions = 100;
  for (int i = 0; i < kMotions; ++i) {
    bench.cell.wait(0.2 + 0.3 * random());
    const auto tick = static_cast<std::size_t>(bench.cell.control.plan_ticks()) + 300;
    const TipMotion<double> motion =
        circles(0.5 + 0.5 * random(), 3 + 2 * random(), 0.25 + 0.1 * random(), random());
    // Beside the loop, which must not wait: the watchdog would stop the arms.
    auto next = std::async(std::launch::async, [&] { return planner().replace(running, tick, motion, 0); });
    while (next.wait_for(std::chrono::seconds(0)) != std::future_status::ready) bench.cell.tick();
    const StickPlan plan = next.get();
    REQUIRE(plan.ok());
    INFO(i << ": " << text_of(bench.cell.control.fault()));
    REQUIRE(bench.cell.control.state() == ControlState::kRunning);
    // A plan that comes too late is refused, and the old one goes on to its end.
    if (!bench.cell.control.replace(std::make_shared<LoadedPlan>(plan), static_cast<double>(tick)).empty())
      continue;
    ++joined;
    const double before = bench.cell.control.plan_ticks();
    while (bench.cell.control.plan_ticks() >= before && bench.cell.control.state() == ControlState::kRunning)
      bench.cell.tick();
    running = plan;
  }
  std::printf("%d of %d motions were taken up midway\n", joined, kMotions);
  CHECK(joined >= kMotions / 2);
  bench.play_out(running);
  bench.cell.wait(0.1);
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const std::vector<Joints<double>> sent = bench.setpoints(side);
    CHECK((sent.back() - SetpointGuard::half(running.setpoints.back(), side)).cwiseAbs().maxCoeff() <= 1e-6);
    if (sent.size() == bench.cell.session.size()) CHECK(largest_excess(sent) <= 1.02);
  }
}

TEST_CASE("without the guard the controller's own stop is the answer, so the tests can see it") {
  const StickPlan plan = planner().start(circles(1.0, 3));
  Bench bench(plan);
  bench.connect();
  const Joints<double> at = bench.cell.control.reading(Side::kLeft).actual;
  for (int i = 0; i < 200; ++i) {
    bench.cell.tick();
    bench.cell.left.servo(at + Joints<double>::Constant(i < 100 ? 0 : 0.15));
  }
  CHECK(bench.server(Side::kLeft)->reason().starts_with("C204A1"));
  CHECK(bench.cell.control.reading(Side::kLeft).protective_stop);
  CHECK(bench.cell.control.fault().kind == ControlFaultKind::kProtectiveStop);
}

TEST_CASE("how late the arms follow is found out") {
  const StickPlan plan = planner().start(circles(1.2, 4));
  for (const auto& [lookahead, gain] : {std::pair{0.03, 2000.0}, {0.1, 300.0}, {0.05, 500.0}}) {
    ur5e::CellOptions options = patient();
    options.settings.lookahead = lookahead;
    options.settings.gain = gain;
    options.guard.tracking = 0.6;
    Bench bench(plan, options);
    bench.make_run(plan);
    bench.play_out(plan);
    const ServoLag lag = estimate_lag(bench.cell.session.commanded(), bench.cell.session.actual());
    std::printf("lookahead %.2f s, gain %.0f: %.1f ms late, %.2g rad left\n", lookahead, gain, 1e3 * lag.lag,
                lag.residual);
    CHECK(lag.certain);
    CHECK(lag.lag > lookahead);
    CHECK(lag.lag < lookahead + 0.02);  // two or three ticks on the way, more where the machine is busy
  }
}

TEST_CASE("a controller that slows down slows the plan down, and both arms with it") {
  const StickPlan plan = planner().start(circles(2.0, 3));
  Bench bench(plan);
  bench.make_run(plan);
  bench.cell.wait(0.5);
  const double before = bench.cell.control.plan_ticks();
  const std::size_t rows = bench.cell.session.size();
  bench.server(Side::kRight)->order("scaling 0.5 1.0");
  bench.cell.wait(1.0);
  const double share =
      (bench.cell.control.plan_ticks() - before) / static_cast<double>(bench.cell.session.size() - rows);
  CHECK(share > 0.45);
  CHECK(share < 0.75);
  bench.play_out(plan);
  for (const Side side : {Side::kLeft, Side::kRight})
    CHECK(bench.server(side)->ticks().back().safety == stand_in::Controller::kNormal);
}

TEST_CASE("where a fieldbus holds the lower registers, the upper ones serve") {
  const StickPlan plan = planner().start(circles(1.0, 3));
  for (const bool upper : {false, true}) {
    ur5e::CellOptions options = patient();
    options.settings.upper_registers = upper;
    options.control.connect_within = upper ? 10 : 2;
    Bench bench(plan, options);
    bench.server(Side::kLeft)->order("fieldbus on");
    if (upper) {
      bench.make_run(plan);
      bench.play_out(plan);
    } else {
      bench.cell.control.connect(bench.cell.now);
      CHECK(bench.cell.until(ControlState::kFaulted, 5));
      CHECK(bench.cell.control.fault().kind == ControlFaultKind::kConnect);
      CHECK(bench.cell.left.trouble().find("already in use") != std::string::npos);
    }
  }
}
