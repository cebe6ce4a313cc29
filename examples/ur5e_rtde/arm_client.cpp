// SPDX-License-Identifier: MIT
// The process that speaks to one arm's controller with ur_rtde; RtdeArm starts it, with its end of a socket
// as the standard input. It ends at the first irregularity, so that the arm's program stops by the
// controller's watchdog, and when its other half is gone, having stopped the arm. Nothing else may use the
// client while this runs.
#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>
#include <ur_rtde/dashboard_client.h>
#include <ur_rtde/rtde_control_interface.h>
#include <ur_rtde/rtde_receive_interface.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstring>
#include <exception>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "reporter.hpp"

namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr int kSocket = STDIN_FILENO;

double now() { return std::chrono::duration<double>(Clock::now().time_since_epoch()).count(); }

class Client {
 public:
  explicit Client(const ur5e::ArmSettings& settings) : settings_(settings), host_(settings.host.data()) {}

  /// Tries until it is there, or RtdeArm loses its patience and kills this process.
  void connect() {
    for (int pause = 100;; pause = std::min(2 * pause, 1000)) {
      try {
        reporter_.trouble(host_ + ": it has told no state yet");
        receive_ = std::make_unique<ur_rtde::RTDEReceiveInterface>(
            host_, 500.0,
            std::vector<std::string>{"timestamp", "actual_q", "speed_scaling", "target_speed_fraction",
                                     "runtime_state", "safety_status_bits", "robot_status_bits"});
        std::uint16_t flags =
            ur_rtde::RTDEControlInterface::FLAG_UPLOAD_SCRIPT | ur_rtde::RTDEControlInterface::FLAG_NO_EXT_FT;
        if (settings_.upper_registers) flags |= ur_rtde::RTDEControlInterface::FLAG_UPPER_RANGE_REGISTERS;
        control_ = std::make_unique<ur_rtde::RTDEControlInterface>(host_, 500.0, flags);
        prepare();
        reporter_.trouble("");
        return;
      } catch (const std::exception& error) {
        reporter_.trouble(host_ + ": " + error.what());
      }
      control_.reset();
      receive_.reset();
      if (gone()) _exit(0);
      std::this_thread::sleep_for(milliseconds(pause));
    }
  }

  /// Obeys until RtdeArm is gone.
  [[noreturn]] void run() {
    std::thread(&Client::observe, this).detach();
    try {
      while (obey_all()) {
        if (!servoing_ && running_ && now() - kicked_ > 0.01) {
          watched([this] { return control_->kickWatchdog(); });
          kicked_ = now();
        }
      }
      alarm(3);  // whatever the library does now, this process ends
      stop();
      control_->stopScript();
    } catch (const std::exception& error) {
      reporter_.leave(host_ + ": " + error.what());
    }
    _exit(0);
  }

 private:
  /// What a freshly started program needs to be told.
  void prepare() {
    if (settings_.payload > 0)
      control_->setPayload(settings_.payload,
                           {settings_.payload_centre.begin(), settings_.payload_centre.end()});
    if (!control_->setWatchdog(settings_.watchdog)) throw std::runtime_error("the watchdog was refused");
  }

  static bool gone() {
    pollfd waiting{kSocket, POLLIN, 0};
    char byte;
    return poll(&waiting, 1, 0) > 0 && recv(kSocket, &byte, 1, MSG_PEEK | MSG_DONTWAIT) == 0;
  }

  /// A call that must not take long: the other thread looks at the clock.
  template <class Call>
  bool watched(const Call& call) {
    called_at_ = now();
    const bool done = call();
    called_at_ = 0;
    return done;
  }

  /// All requests that have come; of setpoints the last one. False where RtdeArm is gone.
  bool obey_all() {
    pollfd waiting{kSocket, POLLIN, 0};
    poll(&waiting, 1, 5);
    std::optional<ur5e::ArmRequest> setpoint;
    for (;;) {
      ur5e::ArmRequest request;
      const ssize_t got = recv(kSocket, &request, sizeof request, MSG_DONTWAIT);
      if (got == 0) return false;
      if (got != sizeof request) break;
      if (request.command == ur5e::ArmCommand::kServo) {
        setpoint = request;
        continue;
      }
      if (setpoint) obey(*setpoint);
      setpoint.reset();
      obey(request);
    }
    if (setpoint) obey(*setpoint);
    return true;
  }

  void obey(const ur5e::ArmRequest& request) {
    const std::vector<double> joints(request.joints.begin(), request.joints.end());
    switch (request.command) {
      case ur5e::ArmCommand::kServo: {
        servoing_ = true;
        const bool taken = watched([&] {
          return control_->servoJ(joints, 0, 0, diabolo::kTick, settings_.lookahead, settings_.gain);
        });
        kicked_ = now();
        if (taken) states_since_refusal_ = kNotRefused;
        if (!taken && states_since_refusal_ == kNotRefused) states_since_refusal_ = 0;
        break;
      }
      case ur5e::ArmCommand::kMove:
        stop_servo();
        if (!control_->moveJ(joints, settings_.move_speed, settings_.move_acceleration, true))
          reporter_.trouble(host_ + ": a move was refused");
        break;
      case ur5e::ArmCommand::kStop:
        stop();
        break;
      case ur5e::ArmCommand::kUnlock:
        unlock();
        break;
    }
  }

  void stop() {
    const bool moves = control_->getAsyncOperationProgressEx().isAsyncOperationRunning();
    if (running_ && !servoing_ && moves) control_->stopJ(kStopDeceleration, true);
    stop_servo();
  }
  void stop_servo() {
    if (running_ && servoing_) control_->servoStop(kStopDeceleration);
    servoing_ = false;
    states_since_refusal_ = kNotRefused;
  }

  void unlock() {
    try {
      if (receive_->isProtectiveStopped()) {
        ur_rtde::DashboardClient dashboard(host_);
        dashboard.connect();
        dashboard.closeSafetyPopup();
        dashboard.unlockProtectiveStop();
        dashboard.disconnect();
      }
      if (!wait([this] { return !receive_->isProtectiveStopped(); }, "the stop was not released")) return;
      servoing_ = false;
      states_since_refusal_ = kNotRefused;
      // The command register still holds the last setpoint's command, and a program that starts would obey
      // it.
      control_->kickWatchdog();
      control_->reuploadScript();
      if (!wait([this] { return running_.load(); }, "the program did not start")) return;
      prepare();
    } catch (const std::exception& error) {
      reporter_.trouble(host_ + ": " + error.what());
    }
  }
  template <class Condition>
  bool wait(const Condition& condition, const std::string& otherwise) {
    for (const double end = now() + 5; now() < end; std::this_thread::sleep_for(milliseconds(5)))
      if (condition()) return true;
    reporter_.trouble(host_ + ": " + otherwise);
    return false;
  }

  /// Reads what the controller says, tick by tick, and ends the process where a call has become stuck.
  void observe() {
    try {
      double told = -1;
      for (double last = 0;; std::this_thread::sleep_for(std::chrono::microseconds(300))) {
        const double called_at = called_at_;
        if (called_at > 0 && now() - called_at > settings_.slow_call)
          reporter_.leave(host_ + ": the client took too long over a setpoint; it had lost its connection");
        // (Both: a setpoint that a broken connection did not take is not one that the controller refused.)
        if (!receive_->isConnected() || !control_->isConnected())
          reporter_.leave(host_ + ": the connection broke");
        const bool fresh = receive_->getTimestamp() != told;
        if (!fresh && now() - last < 0.005) continue;
        told = report(fresh);
        last = now();
      }
    } catch (const std::exception& error) {
      reporter_.leave(host_ + ": " + error.what());
    }
  }

  /// One state of the controller, all of the same packet; returns its time.
  double report(bool fresh) {
    // A refusal may be known before the state that explains it, which comes by a connection of its own.
    int states = states_since_refusal_;
    if (fresh && states >= 0 && states < kStatesThatExplain)
      states_since_refusal_.compare_exchange_strong(states, states + 1);
    double time;
    std::vector<double> actual;
    double scaling;
    std::uint32_t runtime, safety;
    do {
      time = receive_->getTimestamp();
      actual = receive_->getActualQ();
      scaling = receive_->getSpeedScaling() * receive_->getTargetSpeedFraction();
      runtime = receive_->getRuntimeState();
      safety = receive_->getSafetyStatusBits();
    } while (receive_->getTimestamp() != time);
    const bool moving = control_->getAsyncOperationProgressEx().isAsyncOperationRunning();
    running_ = runtime == kPlaying;
    reporter_.tell([&](ur5e::ArmReport& report) {
      report.link = diabolo::LinkState::kConnected;
      report.controller_time = time;
      std::copy(actual.begin(), actual.end(), report.actual.begin());
      report.speed_scaling = scaling;
      report.safety_normal = (safety & kAnyStop) == 0;
      report.protective_stop = (safety & kProtectiveStop) != 0;
      report.emergency_stop = (safety & kEmergencyStop) != 0;
      report.program_running = running_;
      report.moving = moving && running_;
      report.refused = states >= kStatesThatExplain;
    });
    return time;
  }

  static constexpr int kNotRefused = -1, kStatesThatExplain = 3;
  static constexpr double kStopDeceleration = 10;            // [rad/s^2]
  static constexpr std::uint32_t kPlaying = 2;               // runtime_state
  static constexpr std::uint32_t kProtectiveStop = 1u << 2;  // safety_status_bits
  static constexpr std::uint32_t kEmergencyStop = 1u << 5 | 1u << 6 | 1u << 7;
  static constexpr std::uint32_t kAnyStop = 0x7fc;  // bits 2 to 10; a reduced mode is none

  ur5e::ArmSettings settings_;
  std::string host_;
  ur5e::Reporter reporter_{kSocket};
  std::unique_ptr<ur_rtde::RTDEReceiveInterface> receive_;
  std::unique_ptr<ur_rtde::RTDEControlInterface> control_;
  std::atomic<double> called_at_ = 0;
  std::atomic<bool> running_ = true;
  std::atomic<int> states_since_refusal_ = kNotRefused;
  bool servoing_ = false;
  double kicked_ = 0;
};

}  // namespace

int main() {
  std::signal(SIGINT, SIG_IGN);  // a person's Ctrl-C is for RtdeArm, which has the arm brake first
  std::signal(SIGTERM, SIG_IGN);
  ur5e::ArmSettings settings;
  if (recv(kSocket, &settings, sizeof settings, 0) != sizeof settings) return 2;
  if (!settings.talkative) {
    const int nowhere = open("/dev/null", O_WRONLY);
    dup2(nowhere, STDOUT_FILENO);
    dup2(nowhere, STDERR_FILENO);
  }
  Client client(settings);
  client.connect();
  client.run();
}
