// SPDX-License-Identifier: MIT
// Plays a motion of the stick tips on two UR5e. This is not a safety function: read README.md first.
#include <poll.h>
#include <CLI/CLI.hpp>

#include <csignal>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <iostream>
#include <string>

#include "cell.hpp"
#include "circular_motion.hpp"
#include "diabolo/robot/control/servo_lag.hpp"
#include "diabolo/robot/motion/check_plan.hpp"
#include "diabolo/robot/motion/tip_plan_file.hpp"

namespace {

using diabolo::ControlState;
using diabolo::Side;

volatile std::sig_atomic_t interrupted = 0;
void interrupt(int) { interrupted = 1; }

struct Options {
  std::string left, right, plan, log;
  double seconds = 20, speed = 0.2, stale = 0.01;
  bool yes = false, dry_run = false;
  ur5e::ArmSettings arm;
};

/// What the person types, while the loop goes on: nothing moves. True for "yes".
bool confirmed(ur5e::Cell& cell, const Options& options, const char* question) {
  if (options.yes) return true;
  std::printf("%s Type yes and Enter to go on: ", question);
  std::fflush(stdout);
  pollfd waiting{0, POLLIN, 0};
  while (!interrupted && cell.control.state() != ControlState::kFaulted && poll(&waiting, 1, 0) == 0)
    cell.tick();
  std::string answer;
  return !interrupted && cell.control.state() != ControlState::kFaulted && std::getline(std::cin, answer) &&
         answer == "yes";
}

/// Prints what can be said against the plan; true where there is nothing.
bool playable(const diabolo::StickPlanner& planner, const diabolo::TipMotion<double>& motion) {
  const diabolo::PlanCheck check = diabolo::check_plan(planner, motion);
  for (const diabolo::PlanTrouble& trouble : check.troubles)
    std::printf("%s, %.2f to %.2f s: %s.\n", trouble.who.c_str(), trouble.from, trouble.to,
                trouble.why.c_str());
  if (!check.playable()) return false;
  std::printf("Planned %.2f s, played in %.2f s: %.2f times slower on the whole, %.2f times at %.2f s.\n",
              check.as_planned, check.as_played, check.as_played / check.as_planned, check.worst_factor,
              check.worst_at);
  if (check.worst_factor > 1.02) std::printf("Slower than planned, it does something else to the diabolo.\n");
  std::printf("The arms stay %.2f m apart (%s).\n", check.least_clearance, check.nearest_parts.c_str());
  return true;
}

void print_lag(const ur5e::SessionRecording& session) {
  if (session.size() < 500) return;
  const diabolo::ServoLag lag = diabolo::estimate_lag(session.commanded(), session.actual());
  if (lag.certain)
    std::printf("The arms follow %.1f ms late; %.4f rad (rms) are left at that.\n", 1e3 * lag.lag,
                lag.residual);
}

/// From connecting to the end of the plan. Returns what is wrong, an empty text where nothing is.
std::string play(ur5e::Cell& cell, const diabolo::StickPlan& plan, const Options& options) {
  const auto stopped = [&cell] { return interrupted || cell.control.state() == ControlState::kFaulted; };
  const auto why = [&cell](const std::string& otherwise) {
    std::string reason = cell.control.fault().kind != diabolo::ControlFaultKind::kNone
                             ? diabolo::text_of(cell.control.fault())
                             : otherwise;
    for (const ur5e::RtdeArm* arm : {&cell.left, &cell.right})
      if (!arm->trouble().empty()) reason += " (" + arm->trouble() + ")";
    return interrupted ? std::string() : reason;
  };
  cell.control.connect(cell.now);
  if (!cell.until(ControlState::kIdle, 15, stopped)) return why("no connection");
  std::printf("Both arms are connected.\n");
  if (!confirmed(cell, options, "The arms will go home, slowly, the left one first."))
    return why("not confirmed");
  if (const std::string refused = cell.control.home(plan.setpoints.front(), cell.now); !refused.empty())
    return refused;
  if (!cell.until(ControlState::kReady, 130, stopped)) return why("the arms did not arrive");
  if (!confirmed(cell, options, "The arms will play.")) return why("not confirmed");
  const auto loaded = std::make_shared<diabolo::LoadedPlan>(plan);
  if (const std::string refused = cell.control.run(loaded, cell.now); !refused.empty()) return refused;
  std::printf("Playing.\n");
  std::fflush(stdout);
  const double settling = 0.3 / diabolo::kTick;
  while (!stopped() && cell.control.state() == ControlState::kRunning &&
         cell.control.plan_ticks() < static_cast<double>(plan.setpoints.size()) + settling)
    cell.tick();
  if (cell.control.state() == ControlState::kStopping) cell.until(ControlState::kFaulted, 1);
  return cell.control.state() == ControlState::kFaulted ? why("") : std::string();
}

int run(const Options& options, const std::string& client) {
  const diabolo::TipMotion<double> motion =
      options.plan.empty() ? diabolo::sampled(ur5e::circular_motion(options.seconds), 1.0 / 120)
                           : diabolo::load_tip_plan(options.plan);
  const diabolo::StickPlanner planner = ur5e::paper_planner();
  const diabolo::TipMotion<double> slower = ur5e::at_speed(motion, options.speed);
  std::printf("Speed %g: %.2f s of motion in %.2f s.\n", options.speed, motion.end() - motion.begin(),
              slower.end() - slower.begin());
  if (!playable(planner, slower)) return 1;
  if (options.dry_run) {
    std::printf("A dry run: nothing was connected to.\n");
    return 0;
  }
  const diabolo::StickPlan plan = planner.start(slower);
  if (!plan.ok()) throw std::logic_error("the plan that was checked cannot be played");
  ur5e::CellOptions cell_options{client, options.left, options.right, options.arm};
  cell_options.settings.slow_call = options.stale;
  cell_options.control.stale_after = cell_options.control.late_after = options.stale;
  cell_options.longest_session = plan.as_played + 60;
  ur5e::Cell cell(planner, cell_options);
  const std::string wrong = play(cell, plan, options);
  cell.end();
  if (interrupted) std::printf("Interrupted: both arms have been braked.\n");
  print_lag(cell.session);
  if (!options.log.empty() && cell.session.size() > 0) {
    cell.save(options.log);
    std::printf("The session is in %s.\n", options.log.c_str());
  }
  if (!wrong.empty()) std::fprintf(stderr, "ur5e_diabolo: %s\n", wrong.c_str());
  return wrong.empty() ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("Plays a motion of the stick tips on two UR5e. Not a safety function: read README.md first.");
  app.add_option("--left", options.left, "Controller of the left arm, a name or an address");
  app.add_option("--right", options.right, "Controller of the right arm");
  auto* plan = app.add_option("--plan", options.plan, "Motion of the tips: a plan or a tidy recording, CSV")
                   ->check(CLI::ExistingFile);
  std::string motion = "circular";
  app.add_option("--motion", motion, "Motion that is planned here")
      ->check(CLI::IsMember({"circular"}))
      ->capture_default_str()
      ->excludes(plan);
  app.add_option("--seconds", options.seconds, "Of that motion, at its own speed")
      ->check(CLI::Range(1.0, 600.0))
      ->capture_default_str();
  app.add_option("--speed", options.speed, "Share of the motion's own speed; begin low")
      ->check(CLI::Range(0.01, 1.0))
      ->capture_default_str();
  app.add_option("--log", options.log, "Where the session is written: FILE.csv, and FILE_commanded.csv")
      ->check([](const std::string& name) {
        return name.ends_with(".csv") ? std::string() : "'" + name + "'; expected a name that ends in .csv";
      });
  app.add_option("--lookahead", options.arm.lookahead, "Of servoj [s]")
      ->check(CLI::Range(0.03, 0.2))
      ->capture_default_str();
  app.add_option("--gain", options.arm.gain, "Of servoj")
      ->check(CLI::Range(100, 2000))
      ->capture_default_str();
  app.add_option("--payload", options.arm.payload,
                 "Mass of the stick with what holds it [kg]; 0: as set there")
      ->check(CLI::Range(0.0, 5.0))
      ->capture_default_str();
  app.add_option("--stale", options.stale,
                 "Silence of a controller, or of this loop, that stops both arms [s]")
      ->check(CLI::Range(0.004, 1.0))
      ->capture_default_str();
  app.add_option("--watchdog", options.arm.watchdog,
                 "The controller stops its program after a silence of 1 / this [Hz]")
      ->check(CLI::Range(1.0, 125.0))
      ->capture_default_str();
  app.add_flag("--upper-registers", options.arm.upper_registers, "Where a fieldbus has the lower ones");
  app.add_flag("--dry-run", options.dry_run, "Plans and checks; connects to nothing");
  app.add_flag("--yes", options.yes, "Asks nothing: for tests on simulators only");
  app.add_flag("--talkative", options.arm.talkative, "Lets the client library print");
  app.failure_message([](const CLI::App*, const CLI::Error& error) {
    return "ur5e_diabolo: " + std::string(error.what()) + "; see --help\n";
  });
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  struct sigaction action {};
  action.sa_handler = interrupt;  // without SA_RESTART: a sleep ends, and the loop sees the flag
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  try {
    if (!options.dry_run && (options.left.empty() || options.right.empty()))
      throw std::invalid_argument("--left and --right: expected a controller each, or --dry-run");
    const std::filesystem::path here = std::filesystem::read_symlink("/proc/self/exe").parent_path();
    return run(options, here / "ur5e_arm_client");
  } catch (const std::exception& error) {
    std::fprintf(stderr, "ur5e_diabolo: %s\n", error.what());
    return 2;
  }
}
