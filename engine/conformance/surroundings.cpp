// SPDX-License-Identifier: MIT
#include "conformance/surroundings.hpp"

#include <fmt/format.h>
#include <malloc.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cfenv>
#include <charconv>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <thread>

#include "base/text.hpp"
#include "host/isolate/process_use.hpp"

#if defined(__x86_64__)
#include <xmmintrin.h>
#endif

namespace hallway::conformance {
namespace {

namespace fs = std::filesystem;

/// Processes whose parent is `parent`.
std::vector<pid_t> children_of(pid_t parent) {
  std::vector<pid_t> children;
  for (const auto& entry : fs::directory_iterator("/proc")) {
    const auto pid = parse_int(entry.path().filename().string());
    if (!pid) continue;
    std::ifstream file(entry.path() / "stat");
    std::string line;
    std::getline(file, line);
    const std::size_t bracket = line.rfind(')');
    if (bracket == std::string::npos) continue;
    const auto fields = split(std::string_view(line).substr(bracket + 2), ' ');
    if (fields.size() > 1 && parse_int(fields[1]) == parent) children.push_back(static_cast<pid_t>(*pid));
  }
  return children;
}

}  // namespace

std::vector<std::string> open_descriptors() {
  std::vector<std::string> open;
  for (int fd = 0; fd < 1024; ++fd) {
    std::error_code problem;
    const fs::path target = fs::read_symlink("/proc/self/fd/" + std::to_string(fd), problem);
    if (!problem) open.push_back(fmt::format("{} ({})", fd, printable(target.string())));
  }
  return open;
}

std::size_t count_threads() {
  const auto use = host::read_process_use(::getpid());
  return use ? use->threads : 0;
}

std::size_t count_threads_down_to(std::size_t wanted) {
  using namespace std::chrono_literals;
  const auto end = std::chrono::steady_clock::now() + 1s;
  while (count_threads() > wanted && std::chrono::steady_clock::now() < end) std::this_thread::sleep_for(2ms);
  return count_threads();
}

bool has_children() {
  siginfo_t info{};
  return ::waitid(P_ALL, 0, &info, WEXITED | WNOHANG | WNOWAIT) == 0;
}

void end_children() {
  while (has_children()) {
    for (const pid_t child : children_of(::getpid())) ::kill(child, SIGKILL);
    ::waitpid(-1, nullptr, 0);
  }
}

std::size_t heap_bytes() {
  const struct mallinfo2 info = ::mallinfo2();
  return info.uordblks + info.hblkhd;
}

std::size_t resident_bytes() {
  const auto use = host::read_process_use(::getpid());
  return use ? static_cast<std::size_t>(use->memory_bytes) : 0;
}

std::string signal_settings() {
  std::string text;
  for (int number = 1; number < NSIG; ++number) {
    struct sigaction action {};
    if (::sigaction(number, nullptr, &action) != 0) continue;
    const bool takes_info = (action.sa_flags & SA_SIGINFO) != 0;
    const void* handler = takes_info ? reinterpret_cast<const void*>(action.sa_sigaction)
                                     : reinterpret_cast<const void*>(action.sa_handler);
    text += fmt::format("signal {}: {} {:x}\n", number, handler, action.sa_flags);
  }
  sigset_t blocked;
  sigemptyset(&blocked);
  ::pthread_sigmask(SIG_SETMASK, nullptr, &blocked);
  for (int number = 1; number < NSIG; ++number) {
    if (sigismember(&blocked, number) == 1) text += fmt::format("signal {} is blocked\n", number);
  }
  return text;
}

std::string float_settings() {
  std::string text = fmt::format("rounding {}", std::fegetround());
#if defined(__x86_64__)
  text += fmt::format(", MXCSR {:x}", _mm_getcsr() & ~static_cast<unsigned>(_MM_EXCEPT_MASK));
#elif defined(__aarch64__)
  std::uint64_t control = 0;  // flush to zero, default NaN, traps; flags that were raised stand elsewhere
  asm volatile("mrs %0, fpcr" : "=r"(control));
  text += fmt::format(", FPCR {:x}", control);
#endif
  return text;
}

std::vector<std::string> environment_now() {
  std::vector<std::string> all;
  for (char** entry = ::environ; entry != nullptr && *entry != nullptr; ++entry) all.emplace_back(*entry);
  std::ranges::sort(all);
  return all;
}

unsigned file_mask() {
  const mode_t mask = ::umask(0);
  ::umask(mask);
  return mask;
}

}  // namespace hallway::conformance
