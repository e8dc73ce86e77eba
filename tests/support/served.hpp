// SPDX-License-Identifier: MIT
#pragma once

#include <signal.h>
#include <sys/wait.h>

#include <chrono>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "support/process.hpp"

namespace hallway::test {

/// `hallway serve` of a scenario, started and listening, however long that takes; one that has ended before has no address.
class Served {
 public:
  /// @param more  arguments besides the address
  explicit Served(std::vector<std::string> more) : process_(arguments(std::move(more))) {
    for (bool ended = false; address_.empty() && !ended;) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
      ended = has_ended();
      const std::string printed = process_.err_so_far();
      const std::size_t at = printed.find(" on 127.0.0.1:");
      const std::size_t end = printed.find('\n', at);
      if (at != std::string::npos && end != std::string::npos)
        address_ = printed.substr(at + 4, end - at - 4);
    }
  }
  ~Served() {
    if (!waited_) stop();
  }
  const std::string& address() const { return address_; }
  Ended wait() {
    waited_ = true;
    return process_.wait();
  }
  /// Where no robot has come.
  Ended stop() {
    ::kill(process_.pid(), SIGTERM);
    return wait();
  }

 private:
  bool has_ended() const {
    siginfo_t info{};
    return ::waitid(P_PID, static_cast<id_t>(process_.pid()), &info, WEXITED | WNOHANG | WNOWAIT) == 0 &&
           info.si_pid == process_.pid();
  }
  static std::vector<std::string> arguments(std::vector<std::string> more) {
    std::vector<std::string> all{hallway_program(), "serve", "--udp", "127.0.0.1:0"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }

  Process process_;
  std::string address_;
  bool waited_ = false;
};

}  // namespace hallway::test
