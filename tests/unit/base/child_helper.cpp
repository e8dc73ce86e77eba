// SPDX-License-Identifier: MIT
// A helper program that behaves as its argument says.
#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <new>
#include <string>
#include <thread>
#include <vector>

#include "base/helper.hpp"

namespace {

using hallway::write_standard_output;

[[noreturn]] void hang() {
  for (;;) std::this_thread::sleep_for(std::chrono::hours(1));
}

int echo() {
  write_standard_output(hallway::read_standard_input(std::uint64_t{1} << 30));
  return 0;
}

/// Echoes as it reads, so that both directions are full at once.
int relay() {
  char buffer[4096];
  for (;;) {
    const ssize_t got = ::read(0, buffer, sizeof buffer);
    if (got <= 0) return 0;
    write_standard_output({buffer, static_cast<std::size_t>(got)});
  }
}

[[noreturn]] void flood() {
  const std::string block(65'536, 'x');
  for (;;) write_standard_output(block);
}

int open_descriptors() {
  std::string open;
  for (int fd = 0; fd < 1024; ++fd) {
    if (::fcntl(fd, F_GETFD) >= 0) open += std::to_string(fd) + " ";
  }
  write_standard_output(open);
  return 0;
}

int signal_state() {
  sigset_t blocked;
  ::sigprocmask(SIG_BLOCK, nullptr, &blocked);
  struct sigaction pipe {};
  ::sigaction(SIGPIPE, nullptr, &pipe);
  write_standard_output(std::string(::sigismember(&blocked, SIGUSR1) ? "blocked " : "open ") +
                        (pipe.sa_handler == SIG_DFL ? "default" : "other"));
  return 0;
}

/// Takes memory until there is none. @return 0 if it was told so
int take_memory() {
  try {
    std::vector<std::string> blocks;
    for (int i = 0; i < 1024; ++i) blocks.emplace_back(std::size_t{16} << 20, 'x');
  } catch (const std::bad_alloc&) {
    write_standard_output("no memory");
  }
  return 0;
}

/// Starts a process of its own that holds standard output open, and ends.
int leave_one_behind() {
  const pid_t pid = ::fork();
  if (pid == 0) hang();
  write_standard_output(std::to_string(pid));
  ::close(1);
  return 0;
}

int write_file(const char* path) {
  ::signal(SIGXFSZ, SIG_IGN);
  const int fd = ::open(path, O_WRONLY | O_CREAT, 0600);
  return fd >= 0 && ::write(fd, "x", 1) == 1 ? 1 : 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3 || !hallway::begin_helper(argv[1])) return 2;
  const std::string_view what = argv[2];
  if (what == "echo") return echo();
  if (what == "relay") return relay();
  if (what == "flood") flood();
  if (what == "hang") hang();
  if (what == "hang deaf") {
    ::signal(SIGTERM, SIG_IGN);
    hang();
  }
  if (what == "spin") {
    for (std::atomic<unsigned> turns = 0;;) ++turns;
  }
  if (what == "crash") {
    ::signal(SIGSEGV, SIG_DFL);
    ::raise(SIGSEGV);
  }
  if (what == "abort") {
    ::signal(SIGABRT, SIG_DFL);
    ::raise(SIGABRT);
  }
  if (what == "status") return 7;
  if (what == "descriptors") return open_descriptors();
  if (what == "signals") return signal_state();
  if (what == "memory") return take_memory();
  if (what == "leave one behind") return leave_one_behind();
  if (what == "write file" && argc == 4) return write_file(argv[3]);
  return 2;
}
