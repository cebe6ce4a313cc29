// SPDX-License-Identifier: MIT
#pragma once

#include <poll.h>

#include <chrono>
#include <list>
#include <memory>
#include <mutex>
#include <sstream>
#include <stop_token>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "dashboard.hpp"
#include "rtde_session.hpp"
#include "socket.hpp"

namespace stand_in {

/// A servo command as it came.
struct Arrival {
  double time;  ///< [s] of the machine's steady clock
  JointVector setpoint;
};

inline double steady_now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// A controller on a loopback address: dashboard, script port and RTDE on UR's own port numbers, and faults
/// on request, as lines of text on port 29998 or by order(). Lives on a thread of its own, for `seconds` at
/// the most.
class Server {
 public:
  /// Throws as listening() does.
  Server(const std::string& address, const JointVector& joints, double seconds)
      : controller_(joints), end_(steady_now() + seconds) {
    for (const auto& [port, kind] :
         {std::pair{29998, Kind::kOrders}, std::pair{29999, Kind::kDashboard},
          std::pair{30002, Kind::kScript}, std::pair{30003, Kind::kScript}, std::pair{30004, Kind::kRtde}})
      doors_.push_back({listening(address, static_cast<std::uint16_t>(port)), kind});
    thread_ = std::jthread([this](std::stop_token stop) { run(stop); });
  }

  /// What happened up to now.
  std::vector<Tick> ticks() const { return locked(ticks_); }
  std::vector<Arrival> arrivals() const { return locked(arrivals_); }
  std::string reason() const { return locked(controller_.reason()); }
  /// Why a connection was closed last; empty where none was.
  std::string complaint() const { return locked(complaint_); }
  int uploads() const {
    const std::lock_guard lock(mutex_);
    return controller_.uploads();
  }
  /// Until `seconds` are over.
  void join() {
    if (thread_.joinable()) thread_.join();
  }

  /// Makes a fault; returns "ok", or what was not understood.
  std::string order(std::string_view line) {
    const std::lock_guard lock(mutex_);
    return obey(line);
  }

 private:
  enum class Kind { kOrders, kDashboard, kScript, kRtde };
  struct Door {
    Socket socket;
    Kind kind;
  };
  struct Connection {
    Socket socket;
    Kind kind;
    std::unique_ptr<RtdeSession> session{};
    PacketReader packets{};
    std::string text{}, unsent{};
    bool closing = false;
  };

  template <class T>
  T locked(const T& value) const {
    const std::lock_guard lock(mutex_);
    return value;
  }

  void run(const std::stop_token& stop) {
    next_ = steady_now();
    while (!stop.stop_requested() && steady_now() < end_) {
      wait_until(next_);
      const std::lock_guard lock(mutex_);
      for (const Door& door : doors_) greet(door);
      const bool stalled = steady_now() < stalled_until_;
      for (Connection& connection : connections_)
        if (connection.kind != Kind::kRtde || !stalled) serve(connection);
      while (tick_if_due()) {
      }
      if (std::exchange(untold_, false) && !stalled && !silent_)
        for (Connection& connection : connections_)
          if (connection.session && connection.unsent.empty()) push(connection, connection.session->data());
      connections_.remove_if([](const Connection& connection) { return connection.closing; });
    }
  }

  /// The tick that is due, if one is. After a longer pause of the machine the controller goes on from now.
  bool tick_if_due() {
    const double now = steady_now();
    if (next_ > now) return false;
    next_ = std::max(next_ + diabolo::kTick, now - kLongestPause);
    controller_.frozen = now < frozen_until_;
    if (now >= scaled_until_) controller_.scaling = 1;
    controller_.tick();
    ticks_.push_back(controller_.look(now));
    untold_ = true;
    return true;
  }

  void wait_until(double next) {
    std::vector<pollfd> waiting;
    {
      const std::lock_guard lock(mutex_);
      for (const Door& door : doors_) waiting.push_back({door.socket.fd(), POLLIN, 0});
      if (steady_now() >= stalled_until_)
        for (const Connection& connection : connections_)
          waiting.push_back({connection.socket.fd(), POLLIN, 0});
    }
    const double left = std::clamp(next - steady_now(), 0.0, diabolo::kTick);
    const timespec time{0, static_cast<long>(left * 1e9)};
    ppoll(waiting.data(), waiting.size(), &time, nullptr);
  }

  void greet(const Door& door) {
    for (int fd; (fd = accept4(door.socket.fd(), nullptr, nullptr, Socket::kFlags)) >= 0;) {
      Socket socket(fd);
      if (refusing_ && door.kind != Kind::kOrders) continue;
      Connection& connection = connections_.emplace_back(std::move(socket), door.kind);
      if (door.kind == Kind::kRtde)
        connection.session =
            std::make_unique<RtdeSession>(controller_.outputs(), controller_.inputs(), holders_);
      if (door.kind == Kind::kDashboard) push(connection, kDashboardGreeting);
    }
  }

  void push(Connection& connection, std::string_view bytes) {
    connection.unsent.append(bytes);
    if (connection.unsent.empty()) return;
    const std::optional<std::size_t> sent = connection.socket.send_some(connection.unsent);
    if (sent)
      connection.unsent.erase(0, *sent);
    else
      connection.closing = true;
  }

  void serve(Connection& connection) {
    push(connection, {});
    const std::optional<std::string> bytes = connection.socket.receive();
    if (!bytes) connection.closing = true;
    if (!bytes || bytes->empty()) return;
    switch (connection.kind) {
      case Kind::kOrders:
      case Kind::kDashboard:
        connection.text += *bytes;
        for (std::size_t end; (end = connection.text.find('\n')) != std::string::npos;) {
          const std::string line = connection.text.substr(0, end);
          connection.text.erase(0, end + 1);
          push(connection,
               (connection.kind == Kind::kOrders ? obey(line) : dashboard_answer(controller_, line)) + "\n");
        }
        break;
      case Kind::kScript: {  // whole at a line "end" that is not indented
        constexpr std::string_view kEnd = "\nend\n";
        connection.text += *bytes;
        for (std::size_t end; (end = connection.text.find(kEnd)) != std::string::npos;) {
          controller_.upload(std::string_view(connection.text).substr(0, end + kEnd.size()));
          connection.text.erase(0, end + kEnd.size());
        }
        break;
      }
      case Kind::kRtde:
        converse(connection, *bytes);
        break;
    }
  }

  void converse(Connection& connection, std::string_view bytes) {
    try {
      connection.packets.append(bytes);
      while (const std::optional<Packet> packet = connection.packets.next()) {
        push(connection, connection.session->answer(*packet));
        const auto writer = holders_.find(controller_.command_register());
        if (packet->type != PacketType::kData || writer == holders_.end() ||
            writer->second != connection.session.get())
          continue;
        controller_.command_written();
        if (controller_.inputs().get<std::int32_t>(controller_.command_register()) == kServoJ)
          arrivals_.push_back({steady_now(), controller_.servo_target()});
        // After a pause of the machine each command has a tick of its own, as it would have had.
        tick_if_due();
      }
    } catch (const WireError& error) {
      complaint_ = error.what();
      connection.closing = true;
    }
  }

  std::string obey(std::string_view line);

  static constexpr double kLongestPause = 0.2;  // [s] of the machine, that is made up for

  mutable std::mutex mutex_;
  Controller controller_;
  InputHolders holders_;
  std::vector<Door> doors_;
  std::list<Connection> connections_;
  std::vector<Tick> ticks_;
  std::vector<Arrival> arrivals_;
  std::string complaint_;
  double next_ = 0;  ///< when the next tick is due [s]
  double end_, stalled_until_ = 0, frozen_until_ = 0, scaled_until_ = 0;
  bool untold_ = false;  ///< a state that clients have not been told
  bool refusing_ = false, silent_ = false;
  std::jthread thread_;
};

/// The faults that can be asked for, a word and what it needs each.
inline constexpr const char* kOrders =
    "drop | stall SECONDS | freeze SECONDS | scaling SHARE SECONDS | pstop | estop on|off | pause | play | "
    "stop | "
    "remote on|off | refuse on|off | silent on|off | fieldbus on|off";

inline std::string Server::obey(std::string_view line) {
  std::istringstream words{std::string(line)};
  std::string word, state;
  double number = 0;
  words >> word;
  const auto seconds = [&] { return words >> number && number >= 0 && number <= 60; };
  const auto on_off = [&] { return words >> state && (state == "on" || state == "off"); };
  const bool on =
      (word == "estop" || word == "remote" || word == "refuse" || word == "silent" || word == "fieldbus") &&
      on_off();
  if (word == "drop") {
    connections_.remove_if([](const Connection& c) { return c.kind != Kind::kOrders; });
  } else if (word == "stall" && seconds()) {
    stalled_until_ = steady_now() + number;
  } else if (word == "freeze" && seconds()) {
    frozen_until_ = steady_now() + number;
  } else if (double share = 0; word == "scaling" && words >> share && share >= 0 && share <= 1 && seconds()) {
    controller_.scaling = share;
    scaled_until_ = steady_now() + number;
  } else if (word == "pstop") {
    controller_.protective_stop("asked for");
  } else if (word == "pause") {
    controller_.pause();
  } else if (word == "play") {
    controller_.play();
  } else if (word == "stop") {
    controller_.stop_program("asked for");
  } else if (on && word == "estop") {
    controller_.emergency_stop(state == "on");
  } else if (on && word == "remote") {
    controller_.remote = state == "on";
  } else if (on && word == "refuse") {
    refusing_ = state == "on";
  } else if (on && word == "silent") {
    silent_ = state == "on";
  } else if (on && word == "fieldbus") {
    for (int i = 0; i < 24; ++i) {
      const std::string name = "input_int_register_" + std::to_string(i);
      if (state == "on")
        holders_.insert_or_assign(name, this);
      else
        holders_.erase(name);
    }
  } else {
    return "'" + std::string(line) + "'; expected " + kOrders;
  }
  return "ok";
}

}  // namespace stand_in
