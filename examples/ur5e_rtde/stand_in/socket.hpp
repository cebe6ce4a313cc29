// SPDX-License-Identifier: MIT
#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

namespace stand_in {

/// A TCP socket that never blocks, closed with its owner and in programs that are started.
class Socket {
 public:
  static constexpr int kFlags = SOCK_NONBLOCK | SOCK_CLOEXEC;  ///< that `fd` must have been made with

  explicit Socket(int fd) : fd_(fd) {
    const int on = 1;
    setsockopt(fd, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  }
  Socket(Socket&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
  Socket& operator=(Socket&& other) noexcept {
    std::swap(fd_, other.fd_);
    return *this;
  }
  ~Socket() {
    if (fd_ >= 0) close(fd_);
  }

  int fd() const { return fd_; }

  /// What has come, empty where nothing has; nothing at all where the other side is gone.
  std::optional<std::string> receive() const {
    std::string bytes(65536, '\0');
    const ssize_t got = recv(fd_, bytes.data(), bytes.size(), 0);
    if (got == 0 || (got < 0 && errno != EAGAIN && errno != EINTR)) return {};
    bytes.resize(got < 0 ? 0 : static_cast<std::size_t>(got));
    return bytes;
  }
  /// How many bytes of the front went out; nothing at all where the other side is gone.
  std::optional<std::size_t> send_some(std::string_view bytes) const {
    const ssize_t sent = send(fd_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (sent < 0 && errno != EAGAIN && errno != EINTR) return {};
    return sent < 0 ? 0 : static_cast<std::size_t>(sent);
  }

 private:
  int fd_;
};

/// A port of a loopback address. Throws std::invalid_argument where it is none: a stand-in has no place on a
/// network on which arms may be.
inline sockaddr_in loopback(const std::string& address, std::uint16_t port) {
  sockaddr_in place{};
  place.sin_family = AF_INET;
  place.sin_port = htons(port);
  if (inet_pton(AF_INET, address.c_str(), &place.sin_addr) != 1 || ntohl(place.sin_addr.s_addr) >> 24 != 127)
    throw std::invalid_argument("address: '" + address + "'; expected a loopback address, 127.x.x.x");
  return place;
}

/// Throws std::invalid_argument as loopback() does, std::system_error where the port is taken.
inline Socket listening(const std::string& address, std::uint16_t port) {
  const sockaddr_in place = loopback(address, port);
  Socket socket(::socket(AF_INET, SOCK_STREAM | Socket::kFlags, 0));
  const int on = 1;
  setsockopt(socket.fd(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  if (bind(socket.fd(), reinterpret_cast<const sockaddr*>(&place), sizeof place) != 0 ||
      listen(socket.fd(), 8) != 0)
    throw std::system_error(errno, std::generic_category(), address + ", port " + std::to_string(port));
  return socket;
}

}  // namespace stand_in
