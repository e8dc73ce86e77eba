// SPDX-License-Identifier: MIT
#include "base/helper.hpp"

#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <system_error>

#include "base/error.hpp"
#include "base/text.hpp"

namespace hallway {
namespace {

constexpr std::string_view kPrefix = "hallway-child";
constexpr rlim_t kOpenFiles = 64;

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kReservesAddresses = true;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || __has_feature(memory_sanitizer)
constexpr bool kReservesAddresses = true;
#else
constexpr bool kReservesAddresses = false;
#endif
#else
constexpr bool kReservesAddresses = false;
#endif

bool limit(int resource, rlim_t soft, rlim_t hard) {
  const rlimit wanted{soft, hard};
  return ::setrlimit(static_cast<__rlimit_resource_t>(resource), &wanted) == 0;
}

[[noreturn]] void fail(const char* what) {
  throw Error(ErrorCode::kIo, std::string(what) + ": " + std::generic_category().message(errno));
}

}  // namespace

std::string helper_word(std::uint64_t memory_bytes, std::uint64_t cpu_seconds) {
  return std::string(kPrefix) + ":" + std::to_string(memory_bytes) + ":" + std::to_string(cpu_seconds) + ":" +
         std::to_string(::getpid());
}

bool reserves_addresses() {
  return kReservesAddresses;
}

bool end_with_parent(std::int64_t parent) {
  // The second question, for a parent that ended before the first was answered.
  return ::prctl(PR_SET_PDEATHSIG, SIGKILL) == 0 && ::getppid() == parent;
}

bool begin_helper(std::string_view argument) {
  const auto parts = split(argument, ':');
  if (parts.size() != 4 || parts[0] != kPrefix) return false;
  const auto memory = parse_uint(parts[1]);
  const auto cpu = parse_uint(parts[2]);
  const auto parent = parse_int(parts[3]);
  if (!memory || !cpu || !parent) return false;
  if (!end_with_parent(*parent)) return false;
  // SIGXCPU at the soft limit names the cause; the hard one is for a program that ignores that.
  bool good = limit(RLIMIT_CPU, *cpu, *cpu + 1) && limit(RLIMIT_CORE, 0, 0) && limit(RLIMIT_FSIZE, 0, 0) &&
              limit(RLIMIT_NOFILE, kOpenFiles, kOpenFiles);
  if (!kReservesAddresses) good = good && limit(RLIMIT_AS, *memory, *memory);
  return good;
}

std::string read_standard_input(std::uint64_t max_bytes) {
  std::string input;
  std::array<char, 4096> buffer{};
  for (;;) {
    const ssize_t got = ::read(STDIN_FILENO, buffer.data(), buffer.size());
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) fail("cannot read standard input");
    if (got == 0) return input;
    input.append(buffer.data(), static_cast<std::size_t>(got));
    if (input.size() > max_bytes) throw Error(ErrorCode::kIo, "standard input is too long");
  }
}

void write_standard_output(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(STDOUT_FILENO, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail("cannot write standard output");
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

}  // namespace hallway
