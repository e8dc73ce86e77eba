// SPDX-License-Identifier: MIT
#pragma once

#include <poll.h>
#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace hallway::test {

/// A program that runs in a terminal of its own, as a person would use it: keys go in, what it shows comes out.
class Terminal {
 public:
  /// @param arguments    the program's path and what follows it
  /// @param environment  "NAME=value" entries, all that it gets
  Terminal(std::vector<std::string> arguments, std::vector<std::string> environment,
           const std::filesystem::path& folder) {
    winsize size{};
    size.ws_row = 50;
    size.ws_col = 200;
    pid_ = ::forkpty(&fd_, nullptr, nullptr, &size);
    if (pid_ < 0) throw std::runtime_error("no terminal");
    if (pid_ > 0) return;
    std::vector<char*> argv, envp;
    for (std::string& text : arguments) argv.push_back(text.data());
    for (std::string& text : environment) envp.push_back(text.data());
    argv.push_back(nullptr);
    envp.push_back(nullptr);
    if (::chdir(folder.c_str()) == 0) ::execve(argv[0], argv.data(), envp.data());
    ::_exit(127);
  }
  ~Terminal() {
    ::kill(pid_, SIGKILL);
    ::waitpid(pid_, nullptr, 0);
    ::close(fd_);
  }
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  void type(const std::string& keys) {
    if (::write(fd_, keys.data(), keys.size()) != static_cast<ssize_t>(keys.size()))
      throw std::runtime_error("the terminal takes no keys");
  }

  /// Waits until it has shown `text` since the last call that found one. @return false if it does not come, or the program ends
  bool shows(const std::string& text) {
    const auto give_up = std::chrono::steady_clock::now() + std::chrono::minutes(2);
    while (shown_.find(text) == std::string::npos) {
      pollfd ready{.fd = fd_, .events = POLLIN, .revents = 0};
      if (std::chrono::steady_clock::now() > give_up) return false;
      if (::poll(&ready, 1, 1000) <= 0) continue;
      char block[4096];
      const ssize_t n = ::read(fd_, block, sizeof block);
      if (n <= 0) return false;
      for (const char c : std::string_view(block, static_cast<std::size_t>(n))) {
        if (c == '\a') continue;  // a bell between letters
        shown_ += c;
        all_ += c;
      }
    }
    shown_.erase(0, shown_.find(text) + text.size());
    return true;
  }
  /// Everything that it has shown.
  const std::string& all() const { return all_; }

 private:
  int fd_ = -1;
  pid_t pid_ = -1;
  std::string shown_;
  std::string all_;
};

}  // namespace hallway::test
