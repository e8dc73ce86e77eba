// SPDX-License-Identifier: MIT
#pragma once

#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <csignal>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "support/process.hpp"
#include "support/temp_folder.hpp"

namespace hallway::test {

/// Where a master at this port of the loopback device is.
inline std::string uri_of(int port) {
  return "http://127.0.0.1:" + std::to_string(port);
}

/// The environment of a ROS program with that master.
inline std::vector<std::string> environment_of(int port) {
  return with_sanitizer_options({"PATH=/usr/bin:/bin", "ROS_MASTER_URI=" + uri_of(port), "ROS_IP=127.0.0.1"});
}

/// A ROS master.
class Master {
 public:
  explicit Master(int port) : process_(arguments_of(port), {}, environment_of(port)) {
    for (int i = 0; i < 600 && !listens(port); ++i) ::usleep(100'000);
  }
  ~Master() { kill(SIGKILL); }

  void send(int signal) const { ::kill(process_.pid(), signal); }
  void kill(int signal) {
    if (std::exchange(ended_, true)) return;
    send(signal);
    process_.wait();
  }

 private:
  std::vector<std::string> arguments_of(int port) const {
    return {"/usr/bin/env",
            "ROS_LOG_DIR=" + folder_.path().string(),
            "ROS_HOME=" + folder_.path().string(),
            "HOME=" + folder_.path().string(),
            ROSMASTER,
            "--core",
            "-p",
            std::to_string(port)};
  }
  static bool listens(int port) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    const int socket = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    const bool connected =
        ::connect(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
    ::close(socket);
    return connected;
  }

  TempFolder folder_;
  Process process_;
  bool ended_ = false;
};

}  // namespace hallway::test
