// SPDX-License-Identifier: MIT
#pragma once

#include <sys/socket.h>
#include <unistd.h>

#include <mutex>
#include <string>

#include "arm_messages.hpp"

namespace ur5e {

/// Tells RtdeArm what is. Both threads use it.
class Reporter {
 public:
  explicit Reporter(int socket) : socket_(socket) {}

  void trouble(const std::string& sentence) {
    const std::lock_guard lock(mutex_);
    report_.trouble.fill('\0');
    sentence.copy(report_.trouble.data(), report_.trouble.size() - 1);
    send();
  }
  template <class Change>
  void tell(const Change& change) {
    const std::lock_guard lock(mutex_);
    change(report_);
    send();
  }
  /// The end of this process, at once: whatever state the client library is in must not keep it.
  [[noreturn]] void leave(const std::string& sentence) {
    trouble(sentence);
    _exit(1);
  }

 private:
  void send() { ::send(socket_, &report_, sizeof report_, MSG_NOSIGNAL | MSG_DONTWAIT); }

  int socket_;
  std::mutex mutex_;
  ArmReport report_;
};

}  // namespace ur5e
