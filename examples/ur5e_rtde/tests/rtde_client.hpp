// SPDX-License-Identifier: MIT
#pragma once

#include <fcntl.h>
#include <poll.h>

#include <stdexcept>
#include <string>
#include <vector>

#include "../stand_in/socket.hpp"
#include "../stand_in/wire.hpp"

/// A connection to a port of a stand-in, for tests: waits two seconds for an answer, no longer.
class TestSocket {
 public:
  TestSocket(const std::string& address, std::uint16_t port)
      : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    const sockaddr_in place = stand_in::loopback(address, port);
    if (connect(socket_.fd(), reinterpret_cast<const sockaddr*>(&place), sizeof place) != 0)
      throw std::runtime_error("no connection to " + address);
    fcntl(socket_.fd(), F_SETFL, O_NONBLOCK);
  }

  void send(std::string_view bytes) { socket_.send_some(bytes); }
  /// What comes next, empty where nothing does, or the other side is gone.
  std::string receive() {
    pollfd waiting{socket_.fd(), POLLIN, 0};
    if (poll(&waiting, 1, 2000) <= 0) return {};
    const std::optional<std::string> bytes = socket_.receive();
    closed_ = !bytes;
    return bytes.value_or("");
  }
  /// A line's answer, without its end.
  std::string ask(const std::string& line) {
    send(line + "\n");
    return this->line();
  }
  std::string line() {
    while (text_.find('\n') == text_.npos) {
      const std::string bytes = receive();
      if (bytes.empty()) return {};
      text_ += bytes;
    }
    const std::string first = text_.substr(0, text_.find('\n'));
    text_.erase(0, first.size() + 1);
    return first;
  }
  /// Waits for the other side to close.
  bool closed() {
    while (!receive().empty()) {
    }
    return closed_;
  }

 private:
  stand_in::Socket socket_;
  std::string text_;
  bool closed_ = false;
};

/// A small client of RTDE.
class RtdeClient {
 public:
  explicit RtdeClient(const std::string& address) : socket_(address, 30004) {}

  stand_in::Packet next() {
    for (;;) {
      if (std::optional<stand_in::Packet> packet = packets_.next()) return *packet;
      const std::string bytes = socket_.receive();
      if (bytes.empty()) throw std::runtime_error("no packet came");
      packets_.append(bytes);
    }
  }
  /// The payload of the answer.
  std::string ask(stand_in::PacketType type, std::string_view payload = {}) {
    send(type, payload);
    for (;;) {
      const stand_in::Packet packet = next();
      if (packet.type == type) return packet.payload;
    }
  }
  void send(stand_in::PacketType type, std::string_view payload = {}) {
    send(stand_in::packed(type, payload));
  }
  void send(const std::string& bytes) { socket_.send(bytes); }
  /// The types of the variables; the first byte is the recipe.
  std::string outputs(const std::string& names, double frequency = 500) {
    std::string payload;
    stand_in::put(payload, frequency);
    return ask(stand_in::PacketType::kOutputs, payload + names);
  }
  std::string inputs(const std::string& names) { return ask(stand_in::PacketType::kInputs, names); }
  /// Writes a recipe's values.
  void write(std::uint8_t recipe, const std::vector<stand_in::Value>& values) {
    std::string payload;
    stand_in::put(payload, recipe);
    for (const stand_in::Value& value : values) stand_in::put(payload, value);
    send(stand_in::PacketType::kData, payload);
  }
  /// The newest state that has come, of outputs that are all of type T; the first must be waited for.
  template <class T>
  std::vector<T> state() {
    stand_in::Packet packet = next();
    while (std::optional<stand_in::Packet> newer = packets_.next()) packet = *newer;
    std::string_view bytes = packet.payload;
    bytes.remove_prefix(1);
    std::vector<T> values;
    while (!bytes.empty()) values.push_back(stand_in::taken<T>(bytes));
    return values;
  }
  bool closed() { return socket_.closed(); }

 private:
  TestSocket socket_;
  stand_in::PacketReader packets_;
};
