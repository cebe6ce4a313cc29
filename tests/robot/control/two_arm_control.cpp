// SPDX-License-Identifier: MIT
#include "diabolo/robot/control/two_arm_control.hpp"

#include <functional>
#include <limits>
#include <string>

#include "catch.hpp"
#include "count_allocations.hpp"
#include "robot/arms.hpp"
#include "robot/simulated_arm.hpp"

using namespace diabolo;

namespace {

/// Both tips on circles in the upright plane, as a person at 2 m/s would; the arms take longer.
TipMotion<double> circles(double seconds, double start = 0.0) {
  std::vector<double> times;
  std::vector<Vector3<double>> left, right;
  for (double t = 0; t <= seconds; t += 1.0 / 120) {
    const double a = 6.0 * (start + t);
    const Vector3<double> at{0.05 * std::sin(a), 0.3 * std::cos(a), 0.3 * std::sin(a)};
    times.push_back(t);
    left.push_back(Vector3<double>(0.6, 0.55, 1.25) + at);
    right.push_back(Vector3<double>(0.6, -0.55, 1.25) + at);
  }
  return TipMotion<double>(times, left, right, Interpolation::kSpline);
}

const StickPlan& plan() {
  static const StickPlan made = planner().start(circles(3.0));
  return made;
}

GuardOptions guard_options() { return {}; }

/// Two simulated arms and their control, a clock, and what happened on it.
struct Cell {
  explicit Cell(const GuardOptions& guard = guard_options(), double gain = 2000, double lookahead = 0.03)
      : left(away(Side::kLeft), gain, lookahead),
        right(away(Side::kRight), gain, lookahead),
        control(SetpointGuard(planner().left().arm(), planner().left().grid().box(), planner().right().arm(),
                              planner().right().grid().box(), planner().limits(), guard),
                left, right) {}

  /// Somewhat away from where the plan begins.
  static Joints<double> away(Side side) {
    return SetpointGuard::half(plan().setpoints.front(), side) +
           Joints<double>::Constant(side == Side::kLeft ? 0.03 : -0.03)
               .cwiseProduct((Joints<double>() << 1, 1, 1, 1, 1, 0).finished());
  }

  void tick() {
    left.tick();
    right.tick();
    now += kTick;
    control.tick(now);
  }
  /// Until the state is reached; false after `seconds`.
  bool until(ControlState state, double seconds) {
    for (const double end = now + seconds; now < end;) {
      tick();
      if (control.state() == state) return true;
    }
    return false;
  }
  void wait(double seconds) {
    for (const double end = now + seconds; now < end;) tick();
  }
  void make_ready() {
    REQUIRE(control.connect(now).empty());
    REQUIRE(until(ControlState::kIdle, 1));
    REQUIRE(control.home(plan().setpoints.front(), now) == "");
    REQUIRE(until(ControlState::kReady, 10));
  }
  void make_run() {
    make_ready();
    REQUIRE(control.run(std::make_shared<LoadedPlan>(plan()), now) == "");
  }
  SimulatedArm& arm(Side side) { return side == Side::kLeft ? left : right; }

  SimulatedArm left, right;
  TwoArmControl control;
  double now = 100;
};

double largest_excess(const std::vector<Joints<double>>& setpoints, std::size_t from = 0) {
  double largest = 0;
  const auto both = [&](std::size_t i) {
    PairJoints pair;
    pair << setpoints[i], setpoints[i];
    return pair;
  };
  for (std::size_t i = from + 3; i < setpoints.size(); ++i)
    largest = std::max(largest, excess(both(i - 3), both(i - 2), both(i - 1), both(i), planner().limits()));
  return largest;
}

}  // namespace

TEST_CASE("two arms connect, go home one after the other, and play a plan to its end") {
  REQUIRE(plan().ok());
  Cell cell;
  CHECK(cell.control.state() == ControlState::kDisconnected);
  cell.make_ready();
  CHECK(cell.left.moves.size() == 1);
  CHECK(cell.right.moves.size() == 1);
  CHECK(cell.left.setpoints.empty());
  REQUIRE(cell.control.run(std::make_shared<LoadedPlan>(plan()), cell.now).empty());
  const Joints<double> before = cell.control.reading(Side::kLeft).actual;
  cell.tick();
  REQUIRE(cell.left.setpoints.size() == 1);
  CHECK((cell.left.setpoints.front() - before).cwiseAbs().maxCoeff() <= 1e-5);  // no bump
  cell.wait(plan().as_played + 1.0);
  CHECK(cell.control.state() == ControlState::kRunning);  // and rests at its end
  CHECK((cell.left.setpoints.back() - plan().setpoints.back().head<6>()).cwiseAbs().maxCoeff() <= 1e-9);
  CHECK((cell.right.joints() - plan().setpoints.back().tail<6>()).cwiseAbs().maxCoeff() <= 1e-4);
  for (const Side side : {Side::kLeft, Side::kRight}) {
    CHECK(cell.arm(side).trips == 0);
    CHECK(largest_excess(cell.arm(side).setpoints) <= 1.02);
    CHECK(cell.arm(side).fastest <= 3.2);
  }
  CHECK(cell.left.setpoints.size() == cell.right.setpoints.size());
  cell.control.stop(cell.now);
  REQUIRE(cell.until(ControlState::kIdle, 1));
  CHECK(cell.control.fault().kind == ControlFaultKind::kNone);
}

TEST_CASE("a fault of either arm brings both to rest, with the reason, and stays") {
  struct Case {
    ControlFaultKind kind;
    std::function<void(SimulatedArm&)> make;
  };
  const std::vector<Case> cases{
      {ControlFaultKind::kProtectiveStop, [](SimulatedArm& arm) { arm.protective_stop(); }},
      {ControlFaultKind::kEmergencyStop, [](SimulatedArm& arm) { arm.emergency_stop(true); }},
      {ControlFaultKind::kProgram, [](SimulatedArm& arm) { arm.end_program(); }},
      {ControlFaultKind::kSafety, [](SimulatedArm& arm) { arm.reduce_safety(); }},
      {ControlFaultKind::kLost, [](SimulatedArm& arm) { arm.lose_link(); }},
      {ControlFaultKind::kStale, [](SimulatedArm& arm) { arm.silent_for = 1000; }},
      {ControlFaultKind::kRefused, [](SimulatedArm& arm) { arm.refuses = true; }},
      {ControlFaultKind::kTracking, [](SimulatedArm& arm) { arm.push(Joints<double>::Unit(0) * 0.4); }},
  };
  for (const Case& fault : cases)
    for (const Side side : {Side::kLeft, Side::kRight}) {
      Cell cell;
      cell.make_run();
      cell.wait(1.0);
      REQUIRE(cell.control.state() == ControlState::kRunning);
      SimulatedArm& other = cell.arm(side == Side::kLeft ? Side::kRight : Side::kLeft);
      const std::size_t count = other.setpoints.size();
      REQUIRE(other.speed() > 0.2);
      fault.make(cell.arm(side));
      // The controller's silence is noticed after the time that is allowed to it.
      const double noticed = fault.kind == ControlFaultKind::kStale ? 0.012 : 0.004;
      for (const double end = cell.now + noticed + 1e-9; cell.now < end;) cell.tick();
      INFO(text_of(cell.control.fault()) << ", expected " << text_of({fault.kind, side}));
      REQUIRE(cell.control.state() == ControlState::kStopping);
      REQUIRE(cell.control.fault().kind == fault.kind);
      REQUIRE(cell.control.fault().side == side);
      REQUIRE(cell.until(ControlState::kFaulted, 0.4));
      cell.wait(0.4);
      CHECK(other.speed() < 0.02);
      CHECK(other.trips == 0);
      CHECK(other.stops >= 1);
      // Braked smoothly, within what stopping is allowed, until it stood.
      CHECK(largest_excess(other.setpoints, count - 5) <= 1.8);
      const std::size_t n = other.setpoints.size();
      CHECK((other.setpoints[n - 1] - other.setpoints[n - 2]).cwiseAbs().maxCoeff() <= 1e-6);
      // Latched: nothing moves, no command but recover() counts.
      cell.wait(1.0);
      CHECK(other.setpoints.size() == n);
      CHECK(cell.control.state() == ControlState::kFaulted);
      CHECK(cell.control.fault().kind == fault.kind);
      CHECK(cell.control.run(std::make_shared<LoadedPlan>(plan()), cell.now) ==
            "run: not while the control is faulted");
      CHECK(cell.control.home(plan().setpoints.front(), cell.now) ==
            "home: not while the control is faulted");
    }
}

TEST_CASE(
    "after a protective stop the arms recover when a person asks, and not sooner than after five seconds") {
  Cell cell;
  cell.make_run();
  cell.wait(0.8);
  cell.right.protective_stop();
  REQUIRE(cell.until(ControlState::kFaulted, 1));
  CHECK(cell.control.recover(cell.now).starts_with("recover: a stop can be released 5"));
  cell.wait(4.5);
  CHECK_FALSE(cell.control.recover(cell.now).empty());
  CHECK(cell.right.unlocks == 0);  // never of itself
  cell.wait(0.6);
  const Joints<double> before = cell.right.joints();
  CHECK(cell.control.recover(cell.now).empty());
  REQUIRE(cell.until(ControlState::kIdle, 1));
  CHECK(cell.right.unlocks == 1);
  CHECK(cell.left.unlocks == 0);
  cell.wait(1);
  CHECK((cell.right.joints() - before).norm() <= 1e-3);  // no motion until it goes home
  CHECK_FALSE(cell.control.run(std::make_shared<LoadedPlan>(plan()), cell.now).empty());
  REQUIRE(cell.control.home(plan().setpoints.front(), cell.now) == "");
  REQUIRE(cell.until(ControlState::kReady, 20));
  CHECK(cell.control.run(std::make_shared<LoadedPlan>(plan()), cell.now).empty());
  cell.wait(1);
  CHECK(cell.control.state() == ControlState::kRunning);
}

TEST_CASE("an emergency stop that is still pressed, or comes back, is not recovered from") {
  Cell cell;
  cell.make_run();
  cell.wait(0.5);
  cell.left.emergency_stop(true);
  REQUIRE(cell.until(ControlState::kFaulted, 1));
  cell.wait(6);
  CHECK(cell.control.recover(cell.now) == "recover: the left arm's emergency stop is still pressed");
  cell.left.emergency_stop(false);
  cell.tick();
  CHECK(cell.control.recover(cell.now).empty());
  cell.left.emergency_stop(true);
  CHECK(cell.until(ControlState::kFaulted, 20));
  CHECK(cell.control.fault().kind == ControlFaultKind::kRecovery);
}

TEST_CASE("a broken connection is made anew on recovery") {
  Cell cell;
  cell.make_run();
  cell.wait(0.5);
  cell.left.lose_link();
  REQUIRE(cell.until(ControlState::kFaulted, 1));
  cell.wait(6);
  CHECK(cell.control.recover(cell.now).empty());
  CHECK(cell.until(ControlState::kIdle, 1));
}

TEST_CASE("arms that do not answer are told, and the control tries no more") {
  Cell cell;
  cell.right.connect_ticks = 1 << 30;
  REQUIRE(cell.control.connect(cell.now).empty());
  REQUIRE(cell.until(ControlState::kFaulted, 12));
  CHECK(text_of(cell.control.fault()) ==
        "right arm: no connection in time; is it powered, and in remote control?");
}

TEST_CASE("a setpoint that is not sound never leaves") {
  struct Case {
    ControlFaultKind kind;
    std::function<void(PairJoints&, double)> spoil;  ///< share: of the plan from there on, 0 to 1
  };
  const std::vector<Case> cases{
      {ControlFaultKind::kStep, [](PairJoints& q, double) { q[8] += 0.05; }},
      {ControlFaultKind::kRange, [](PairJoints& q, double share) { q[11] += 0.2 * share; }},
      {ControlFaultKind::kBox, [](PairJoints& q, double share) { q[6] += 0.5 * share; }},
  };
  for (const Case& wrong : cases) {
    StickPlan spoilt = plan();
    for (std::size_t i = 400; i < spoilt.setpoints.size(); ++i)
      wrong.spoil(spoilt.setpoints[i], smooth_step((static_cast<double>(i) - 400) / 1000));
    Cell cell;
    cell.make_ready();
    REQUIRE(cell.control.run(std::make_shared<LoadedPlan>(spoilt), cell.now).empty());
    REQUIRE(cell.until(ControlState::kFaulted, 4));
    CHECK(cell.control.fault().side == Side::kRight);
    CHECK(cell.control.fault().kind == wrong.kind);
    CHECK(cell.right.trips == 0);
    CHECK(cell.right.stops == 1);
    CHECK(cell.left.stops == 1);
    CHECK(largest_excess(cell.right.setpoints) <= 1.02);
    for (const Joints<double>& sent : cell.right.setpoints) REQUIRE(sent.allFinite());
  }
}

TEST_CASE("a NaN is refused with its place before it can run, and by the guard") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  StickPlan spoilt = plan();
  spoilt.setpoints[400][7] = nan;
  std::string message;
  try {
    LoadedPlan loaded(spoilt);
  } catch (const std::invalid_argument& error) {
    message = error.what();
  }
  CHECK(message == "plan, setpoint 400: an angle is not finite");
  SetpointGuard guard(planner().left().arm(), planner().left().grid().box(), planner().right().arm(),
                      planner().right().grid().box(), planner().limits(), {});
  const PairJoints start = plan().setpoints.front();
  guard.begin(start);
  CHECK(guard.check(start, start, false).kind == ControlFaultKind::kNone);
  PairJoints wrong = start;
  wrong[7] = nan;
  for (const bool stopping : {false, true}) {
    CHECK(guard.check(wrong, start, stopping).kind == ControlFaultKind::kNotFinite);
    CHECK(guard.check(wrong, start, stopping).side == Side::kRight);
  }
  CHECK(guard.sent() == start);
}

TEST_CASE("without the guard the arm's own stop would have been the answer") {
  SimulatedArm arm(plan().setpoints.front().head<6>());
  for (int i = 0; i < 100; ++i) {
    arm.servo(plan().setpoints.front().head<6>() + Joints<double>::Constant(i < 50 ? 0 : 0.15));
    arm.tick();
  }
  CHECK(arm.trips == 1);
}

TEST_CASE("a plan taken up midway joins without a bump") {
  Cell cell;
  cell.make_run();
  cell.wait(0.6);
  const std::size_t tick = static_cast<std::size_t>(cell.control.plan_ticks()) + 40;
  const StickPlan next = planner().replace(plan(), tick, circles(2.0, 0.9), 0.0);
  REQUIRE(next.ok());
  CHECK(cell.control.replace(std::make_shared<LoadedPlan>(next), 10).starts_with("replace: tick 10"));
  CHECK(cell.control.replace(std::make_shared<LoadedPlan>(next), static_cast<double>(tick + 1))
            .starts_with("replace: the plan does not begin"));
  REQUIRE(cell.control.replace(std::make_shared<LoadedPlan>(next), static_cast<double>(tick)).empty());
  cell.wait(next.as_played + 1.5);
  CHECK(cell.control.state() == ControlState::kRunning);
  CHECK((cell.left.setpoints.back() - next.setpoints.back().head<6>()).cwiseAbs().maxCoeff() <= 1e-9);
  CHECK(largest_excess(cell.left.setpoints) <= 1.02);
  CHECK(largest_excess(cell.right.setpoints) <= 1.02);
}

TEST_CASE("a controller that slows down slows the plan down, and the other arm with it") {
  Cell cell;
  cell.make_run();
  cell.wait(0.5);
  const double before = cell.control.plan_ticks();
  cell.right.scale_speed(0.5);
  cell.wait(1.0);
  const double slow = cell.control.plan_ticks() - before;
  CHECK(slow > 250);
  CHECK(slow < 310);
  cell.right.scale_speed(1.0);
  cell.wait(0.5);
  const double again = cell.control.plan_ticks();
  cell.wait(0.5);
  CHECK(cell.control.plan_ticks() - again == Approx(250).margin(2));
  CHECK(cell.control.state() == ControlState::kRunning);
  CHECK(largest_excess(cell.left.setpoints) <= 1.02);
}

TEST_CASE("a loop that misses its ticks stops the arms") {
  Cell cell;
  cell.make_run();
  cell.wait(0.5);
  cell.now += 0.02;
  for (int i = 0; i < 10; ++i) {  // the controllers went on meanwhile
    cell.left.tick();
    cell.right.tick();
  }
  cell.tick();
  CHECK(cell.control.state() == ControlState::kStopping);
  CHECK(cell.control.fault().kind == ControlFaultKind::kLate);
  CHECK(cell.until(ControlState::kFaulted, 0.5));
}

TEST_CASE("tips farther apart than the string are refused") {
  GuardOptions options;
  options.string_length = 1.0;  // the circles are 1.1 m apart
  Cell cell(options);
  cell.make_run();
  cell.tick();
  CHECK(cell.control.fault().kind == ControlFaultKind::kString);
  CHECK(cell.until(ControlState::kFaulted, 0.5));
}

TEST_CASE("arms that close in on each other are stopped short of the least clearance") {
  // Closer mounts, so that arms within their boxes can meet.
  const StickPlanner close = planner_on({0.70, 0.5, 0.0});
  const TipMotion<double> crossing({0, 1, 2}, {{0.6, 0.3, 1.2}, {0.6, 0.0, 1.2}, {0.6, -0.1, 1.2}},
                                   {{0.6, -0.3, 1.2}, {0.6, 0.0, 1.2}, {0.6, 0.1, 1.2}},
                                   Interpolation::kSpline);
  const StickPlan made = close.start(crossing);
  REQUIRE(made.ok());
  const StickArm &l = close.left().arm(), &r = close.right().arm();
  SimulatedArm left(made.setpoints.front().head<6>()), right(made.setpoints.front().tail<6>());
  TwoArmControl control(
      SetpointGuard(l, close.left().grid().box(), r, close.right().grid().box(), close.limits(), {}), left,
      right);
  double now = 0, least = 1;
  const auto wait_for = [&](ControlState state) {
    for (int i = 0; i < 5000 && control.state() != state; ++i) {
      left.tick();
      right.tick();
      control.tick(now += kTick);
      PairJoints joints;
      joints << left.joints(), right.joints();
      least = std::min(least, clearance(l, r, joints).distance);
    }
    return control.state() == state;
  };
  REQUIRE(control.connect(now).empty());
  REQUIRE(wait_for(ControlState::kIdle));
  REQUIRE(control.home(made.setpoints.front(), now) == "");
  REQUIRE(wait_for(ControlState::kReady));
  REQUIRE(control.run(std::make_shared<LoadedPlan>(made), now).empty());
  REQUIRE(wait_for(ControlState::kFaulted));
  CHECK(control.fault().kind == ControlFaultKind::kClearance);
  CHECK(least >= 0.10);
  CHECK(least < 0.2);
}

TEST_CASE("a way home through the other arm is refused") {
  Cell cell;
  REQUIRE(cell.control.connect(cell.now).empty());
  REQUIRE(cell.until(ControlState::kIdle, 1));
  PairJoints goal = plan().setpoints.front();
  goal[0] += 5;  // out of its range
  CHECK(cell.control.home(goal, cell.now).starts_with("home: the left arm's way"));
  CHECK(cell.left.moves.empty());
}

TEST_CASE("a slow servo is played on, too") {
  for (const auto& [gain, lookahead] : {std::pair{300.0, 0.1}, std::pair{500.0, 0.05}}) {
    Cell cell(guard_options(), gain, lookahead);
    cell.make_run();
    const bool faulted = cell.until(ControlState::kFaulted, plan().as_played + 1);
    // A lookahead of 0.1 s leaves an arm at full speed 0.3 rad behind: the guard says so.
    INFO(text_of(cell.control.fault()));
    if (lookahead < 0.1)
      CHECK_FALSE(faulted);
    else if (faulted)
      CHECK(cell.control.fault().kind == ControlFaultKind::kTracking);
  }
}

TEST_CASE("the loop takes no memory") {
  Cell cell;
  cell.make_run();
  cell.left.setpoints.reserve(5000);
  cell.right.setpoints.reserve(5000);
  const long before = allocations;
  cell.wait(1.0);
  cell.right.protective_stop();
  cell.wait(0.5);
  CHECK(allocations == before);
  CHECK(cell.control.state() == ControlState::kFaulted);
}
