// SPDX-License-Identifier: MIT
#pragma once

#include <fcntl.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <string>
#include <system_error>
#include <thread>
#include <utility>

#include "arm_messages.hpp"

namespace ur5e {

/// An arm behind ur_rtde's client. The client runs in a process of its own, which ends at the first thing
/// that is not as it should be: the library may block for seconds, reconnect and start the arm's program
/// again unasked, or end its process, and none of that must happen here. The controller's watchdog then stops
/// its program, and begin_connect() starts afresh.
class RtdeArm : public diabolo::ArmLink {
 public:
  /// `client` is the path of the program ur5e_arm_client. Throws std::invalid_argument that names the setting
  /// which the controller would refuse.
  RtdeArm(std::string client, const std::string& host, const ArmSettings& settings = {})
      : client_(std::move(client)), settings_(settings) {
    if (host.empty() || host.size() >= settings_.host.size())
      throw std::invalid_argument("host: '" + host + "'; expected a name or an address");
    host.copy(settings_.host.data(), host.size());
    check("lookahead", settings.lookahead, 0.03, 0.2);
    check("gain", settings.gain, 100, 2000);
    check("move_speed", settings.move_speed, 0.01, 3.14);
    check("move_acceleration", settings.move_acceleration, 0.01, 40);
    check("watchdog", settings.watchdog, 1, 125);
    check("slow_call", settings.slow_call, 0.002, 1);
    check("payload", settings.payload, 0, 5);
  }
  RtdeArm(const RtdeArm&) = delete;
  RtdeArm& operator=(const RtdeArm&) = delete;
  ~RtdeArm() override { end(); }

  void begin_connect() override {
    kill_client();
    report_ = {};
    sent_.reset();
    int ends[2];
    if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) != 0) return lose("no socket");
    socket_ = ends[0];
    fcntl(socket_, F_SETFL, O_NONBLOCK);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[1], STDIN_FILENO);
    char* arguments[] = {client_.data(), nullptr};
    const int failed = posix_spawn(&process_, client_.c_str(), &actions, nullptr, arguments, environ);
    posix_spawn_file_actions_destroy(&actions);
    close(ends[1]);
    if (failed != 0) {
      process_ = -1;
      return lose(client_ + ": " + std::generic_category().message(failed));
    }
    ::send(socket_, &settings_, sizeof settings_, MSG_NOSIGNAL);
  }

  diabolo::ArmReading read() override {
    ArmReport next;
    ssize_t got = -1;
    while (socket_ >= 0 && (got = recv(socket_, &next, sizeof next, 0)) == sizeof next) report_ = next;
    if (socket_ >= 0 && (got == 0 || (got < 0 && errno != EAGAIN && errno != EINTR))) lose(trouble());
    diabolo::ArmReading reading;
    reading.link = socket_ >= 0 ? report_.link : link_when_gone_;
    reading.controller_time = report_.controller_time;
    reading.actual = Eigen::Map<const diabolo::Joints<double>>(report_.actual.data());
    reading.speed_scaling = report_.speed_scaling;
    reading.safety_normal = report_.safety_normal;
    reading.protective_stop = report_.protective_stop;
    reading.emergency_stop = report_.emergency_stop;
    reading.program_running = report_.program_running;
    reading.moving = report_.moving;
    return reading;
  }

  bool servo(const diabolo::Joints<double>& setpoint) override {
    if (!setpoint.allFinite() || !request(ArmCommand::kServo, setpoint)) return false;
    sent_ = setpoint;
    return !report_.refused;
  }
  bool begin_move(const diabolo::Joints<double>& goal) override {
    return goal.allFinite() && request(ArmCommand::kMove, goal);
  }
  void stop() override { request(ArmCommand::kStop); }
  bool begin_unlock() override { return request(ArmCommand::kUnlock); }

  /// The last setpoint that was sent since the connection was made [rad].
  const std::optional<diabolo::Joints<double>>& sent() const { return sent_; }
  /// What the client said went wrong last, a sentence; empty where nothing did.
  std::string trouble() const {
    return {report_.trouble.data(), strnlen(report_.trouble.data(), report_.trouble.size())};
  }
  pid_t process() const { return process_; }

  /// Has the client brake the arm, stop the program on the controller and leave; takes up to two seconds.
  void end() {
    if (socket_ >= 0) shutdown(socket_, SHUT_WR);
    for (int i = 0; i < 400 && process_ > 0; ++i) {
      if (waitpid(process_, nullptr, WNOHANG) == process_)
        process_ = -1;
      else
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    kill_client();
    link_when_gone_ = diabolo::LinkState::kDisconnected;
  }

 private:
  static void check(const char* name, double value, double low, double high) {
    if (value >= low && value <= high) return;
    throw std::invalid_argument(std::string(name) + ": " + diabolo::shown(value) + "; must be within " +
                                diabolo::shown(low) + " and " + diabolo::shown(high));
  }

  bool request(ArmCommand command, const diabolo::Joints<double>& joints = diabolo::Joints<double>::Zero()) {
    if (socket_ < 0) return false;
    ArmRequest request{command};
    Eigen::Map<diabolo::Joints<double>>(request.joints.data()) = joints;
    return ::send(socket_, &request, sizeof request, MSG_NOSIGNAL) == sizeof request;
  }

  void lose(const std::string& why) {
    kill_client();
    report_.trouble.fill('\0');
    why.copy(report_.trouble.data(), report_.trouble.size() - 1);
    link_when_gone_ = diabolo::LinkState::kLost;
  }
  void kill_client() {
    if (socket_ >= 0) close(std::exchange(socket_, -1));
    if (process_ <= 0) return;
    kill(process_, SIGKILL);
    waitpid(process_, nullptr, 0);
    process_ = -1;
  }

  std::string client_;
  ArmSettings settings_;
  ArmReport report_;
  std::optional<diabolo::Joints<double>> sent_;
  diabolo::LinkState link_when_gone_ = diabolo::LinkState::kDisconnected;
  int socket_ = -1;
  pid_t process_ = -1;
};

}  // namespace ur5e
