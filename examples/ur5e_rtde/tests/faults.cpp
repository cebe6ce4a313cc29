// SPDX-License-Identifier: MIT
// What goes wrong on one arm while both play, through the real client: both stop, stay stopped, and say why.
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "arms.hpp"

using namespace arms;

namespace {

const StickPlan& plan() {
  static const StickPlan made = planner().start(circles(3.0, 4));
  return made;
}

Side other(Side side) { return side == Side::kLeft ? Side::kRight : Side::kLeft; }

/// When the first setpoint came that is not the plan's at its full speed [s].
double leaves_plan_at(Bench& bench, Side side) {
  const std::vector<stand_in::Arrival> sent = bench.server(side)->arrivals();
  std::size_t next = 0;  // of the plan; from where the gap of going home has faded out
  for (std::size_t i = 260; i < sent.size(); ++i) {
    const std::size_t last = next;
    for (std::size_t k = last; k < std::min(last == 0 ? 400 : last + 20, plan().setpoints.size()); ++k)
      if ((SetpointGuard::half(plan().setpoints[k], side) - sent[i].setpoint).cwiseAbs().maxCoeff() < 1e-6)
        next = k;
    if (next == last) return sent[i].time;
  }
  return 0;
}

/// Makes the fault on one arm amid a plan, and looks at what both do.
void make_fault(Bench& bench, Side side, ControlFaultKind kind, const std::function<void()>& make) {
  bench.make_run(plan());
  bench.cell.wait(0.8);
  REQUIRE(bench.cell.control.state() == ControlState::kRunning);
  const double made_at = TickClock::now();
  make();
  const bool stopping = bench.cell.until(
      ControlState::kStopping, 2, [&] { return bench.cell.control.state() == ControlState::kFaulted; });
  const double noticed = TickClock::now() - made_at;
  INFO(text_of(bench.cell.control.fault()) << ", expected " << text_of({kind, side}));
  REQUIRE((stopping || bench.cell.control.state() == ControlState::kFaulted));
  CHECK(bench.cell.control.fault().kind == kind);
  CHECK(bench.cell.control.fault().side == side);
  if (stopping) REQUIRE(bench.cell.until(ControlState::kFaulted, 1));
  bench.cell.wait(0.5);
  // The arm without the fault: braked along its path, at rest, no stop of its own.
  double rest_at = made_at;
  for (const stand_in::Tick& tick : bench.server(other(side))->ticks()) {
    if (tick.time > made_at && tick.speed.norm() > 0.02) rest_at = tick.time;
    CHECK(tick.safety == stand_in::Controller::kNormal);
  }
  const double told_at = leaves_plan_at(bench, other(side));
  std::printf("%s: noticed after %.1f ms, the other arm at rest after %.0f ms", text_of({kind, side}).c_str(),
              1e3 * noticed, 1e3 * (rest_at - made_at));
  if (told_at > made_at) std::printf(", told after %.1f ms", 1e3 * (told_at - made_at));
  std::printf("\n");
  CHECK(rest_at - made_at < noticed + 1.0);
  CHECK(bench.server(other(side))->ticks().back().speed.norm() < 0.02);
  CHECK(bench.server(side)->ticks().back().speed.norm() < 0.02);
  // Latched: nothing is sent, and no command but recover() counts.
  const std::size_t sent = bench.server(other(side))->arrivals().size();
  bench.cell.wait(0.3);
  CHECK(bench.server(other(side))->arrivals().size() == sent);
  CHECK(bench.cell.control.state() == ControlState::kFaulted);
  CHECK_FALSE(bench.cell.control.run(std::make_shared<LoadedPlan>(plan()), bench.cell.now).empty());
  for (const Side one : {Side::kLeft, Side::kRight})
    for (const Joints<double>& setpoint : bench.setpoints(one)) REQUIRE(setpoint.allFinite());
}

/// A person's command after a fault, and the whole way back to a running plan.
void recover(Bench& bench) {
  const PairJoints before = [&] {
    PairJoints joints;
    joints << bench.server(Side::kLeft)->ticks().back().joints,
        bench.server(Side::kRight)->ticks().back().joints;
    return joints;
  }();
  bench.cell.wait(0.4);
  REQUIRE(bench.cell.control.recover(bench.cell.now).empty());
  const bool idle = bench.cell.until(ControlState::kIdle, 12);
  INFO(text_of(bench.cell.control.fault())
       << "; " << bench.cell.left.trouble() << "; " << bench.cell.right.trouble());
  REQUIRE(idle);
  bench.cell.wait(0.2);
  PairJoints after;
  after << bench.server(Side::kLeft)->ticks().back().joints,
      bench.server(Side::kRight)->ticks().back().joints;
  CHECK((after - before).cwiseAbs().maxCoeff() <= 1e-9);  // no motion until the arms go home
  CHECK_FALSE(bench.cell.control.run(std::make_shared<LoadedPlan>(plan()), bench.cell.now).empty());
}

std::ptrdiff_t entries(const char* folder) {
  return std::distance(std::filesystem::directory_iterator(folder), std::filesystem::directory_iterator());
}

}  // namespace

TEST_CASE("a fault of one arm stops both, with the reason, and stays") {
  struct Case {
    ControlFaultKind kind;
    Side side;
    const char* order;
  };
  for (const Case& fault : {Case{ControlFaultKind::kProtectiveStop, Side::kLeft, "pstop"},
                            {ControlFaultKind::kEmergencyStop, Side::kRight, "estop on"},
                            {ControlFaultKind::kProgram, Side::kLeft, "stop"},
                            {ControlFaultKind::kProgram, Side::kRight, "pause"},
                            {ControlFaultKind::kStale, Side::kLeft, "stall 2"},
                            {ControlFaultKind::kStale, Side::kRight, "freeze 1.5"},
                            {ControlFaultKind::kLost, Side::kLeft, "drop"}}) {
    INFO(fault.order);
    ur5e::CellOptions options = patient();
    // Before the silent arm is missed where it should be.
    if (fault.kind == ControlFaultKind::kStale) options.control.stale_after = 0.2;
    Bench bench(plan(), options);
    make_fault(bench, fault.side, fault.kind,
               [&] { REQUIRE(bench.server(fault.side)->order(fault.order) == "ok"); });
  }
}

TEST_CASE("a client that is killed leaves its arm to the controller's watchdog") {
  ur5e::CellOptions options = patient();
  options.settings.watchdog = 2;
  Bench bench(plan(), options);
  double killed_at = 0;
  make_fault(bench, Side::kRight, ControlFaultKind::kLost, [&] {
    killed_at = TickClock::now();
    kill(bench.cell.right.process(), SIGKILL);
  });
  CHECK(bench.server(Side::kRight)->reason() == "the watchdog");
  double stopped_at = 0;
  for (const stand_in::Tick& tick : bench.server(Side::kRight)->ticks())
    if (stopped_at == 0 && tick.time > killed_at && tick.runtime == stand_in::Controller::kStopped)
      stopped_at = tick.time;
  std::printf("killed client: the program stopped after %.1f ms\n", 1e3 * (stopped_at - killed_at));
  CHECK(stopped_at - killed_at < 1.5);  // 0.5 s and a few ticks where the machine has time
  CHECK(bench.cell.control.recover(bench.cell.now).empty());
  CHECK(bench.cell.until(ControlState::kIdle, 12));
}

TEST_CASE("numbers that are none never leave, whoever sends them") {
  Bench bench(plan());
  bench.connect();
  Joints<double> wrong = bench.cell.control.reading(Side::kLeft).actual;
  wrong[3] = std::numeric_limits<double>::quiet_NaN();
  CHECK_FALSE(bench.cell.left.servo(wrong));
  CHECK_FALSE(bench.cell.left.begin_move(wrong));
  bench.cell.wait(0.1);
  CHECK(bench.server(Side::kLeft)->arrivals().empty());
  CHECK(bench.cell.control.state() == ControlState::kIdle);
}

TEST_CASE("after a protective stop the arms recover when a person asks, five seconds later and not before") {
  ur5e::CellOptions options = patient();
  options.control.recover_after = 5;
  Bench bench(plan(), options);
  make_fault(bench, Side::kRight, ControlFaultKind::kProtectiveStop,
             [&] { bench.server(Side::kRight)->order("pstop"); });
  CHECK(bench.cell.control.recover(bench.cell.now).starts_with("recover: a stop can be released 5"));
  CHECK(bench.server(Side::kRight)->ticks().back().safety == stand_in::Controller::kProtective);
  bench.cell.wait(4.5);
  recover(bench);
  bench.go_home();
  bench.run(plan());
  bench.cell.wait(0.5);
  CHECK(bench.cell.control.state() == ControlState::kRunning);
}

TEST_CASE(
    "arms come back after a drop, a long silence and a new controller, again and again, and nothing piles "
    "up") {
  Bench bench(plan());
  bench.connect();
  std::ptrdiff_t files = 0, threads = 0;
  for (int cycle = 0; cycle < 50; ++cycle) {
    const Side side = cycle % 2 == 0 ? Side::kLeft : Side::kRight;
    INFO("cycle " << cycle << ", " << name_of(side));
    if (cycle == 0) {
      bench.server(side)->order("stall 4");
      bench.cell.wait(4.5);
    } else if (cycle == 1) {
      bench.server(side).reset();
      bench.cell.wait(0.1);
      bench.start(side);
    } else {
      bench.server(side)->order("drop");
    }
    REQUIRE(bench.cell.until(ControlState::kFaulted, 2,
                             [&] { return bench.cell.control.state() == ControlState::kFaulted; }));
    if (cycle > 1) CHECK(bench.cell.control.fault().kind == ControlFaultKind::kLost);
    recover(bench);
    // Its own numbers, once there has been one cycle.
    if (cycle == 0) {
      files = entries("/proc/self/fd");
      threads = entries("/proc/self/task");
    }
    CHECK(entries("/proc/self/fd") <= files + 4);  // sockets of the stand-ins that are about to close
    CHECK(entries("/proc/self/task") == threads);
  }
  bench.go_home();
  bench.run(plan());
  bench.cell.wait(0.3);
  CHECK(bench.cell.control.state() == ControlState::kRunning);
}

TEST_CASE("what keeps an arm from connecting is told") {
  ur5e::CellOptions options = patient();
  options.control.connect_within = 1;
  struct Case {
    const char* order;
    const char* said;
  };
  for (const Case& wrong :
       {Case{"remote off", "remote control"}, {"silent on", "no state"}, {"refuse on", ": "}}) {
    INFO(wrong.order);
    Bench bench(plan(), options);
    bench.server(Side::kLeft)->order(wrong.order);
    REQUIRE(bench.cell.control.connect(bench.cell.now).empty());
    REQUIRE(bench.cell.until(ControlState::kFaulted, 4));
    CHECK(bench.cell.control.fault().kind == ControlFaultKind::kConnect);
    CHECK(bench.cell.left.trouble().find(wrong.said) != std::string::npos);
    std::printf("%s: %s\n", wrong.order, bench.cell.left.trouble().c_str());
  }
}

TEST_CASE("an arm whose controller comes later is waited for") {
  Bench bench(plan());
  bench.server(Side::kRight).reset();
  REQUIRE(bench.cell.control.connect(bench.cell.now).empty());
  bench.cell.wait(0.5);
  CHECK(bench.cell.control.state() == ControlState::kConnecting);
  CHECK_FALSE(bench.cell.right.trouble().empty());
  bench.start(Side::kRight);
  CHECK(bench.cell.until(ControlState::kIdle, 8));
}

TEST_CASE("settings that the controller would refuse are refused first") {
  ur5e::ArmSettings settings;
  settings.lookahead = 0.02;
  CHECK_THROWS_WITH(ur5e::RtdeArm("client", "127.0.0.1", settings),
                    "lookahead: 0.02; must be within 0.03 and 0.2");
  CHECK_THROWS_WITH(ur5e::RtdeArm("client", ""), "host: ''; expected a name or an address");
  ur5e::RtdeArm arm("/nowhere/client", "127.0.0.1");
  arm.begin_connect();
  CHECK(arm.read().link == LinkState::kLost);
  CHECK(arm.trouble().starts_with("/nowhere/client: "));
}
