// SPDX-License-Identifier: MIT
#include "base/child.hpp"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <system_error>

#include "base/error.hpp"
#include "base/helper.hpp"
#include "base/text.hpp"

namespace hallway {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr int kFoldersUp = 3;
constexpr std::chrono::milliseconds kTermGrace{300};  ///< between SIGTERM and SIGKILL
constexpr std::size_t kReadBytes = std::size_t{1} << 20;

[[noreturn]] void fail(const fs::path& program, const std::string& what, int error_number) {
  throw Error(ErrorCode::kIo, what + ": " + std::generic_category().message(error_number),
              {.file = printable(program.string(), 4096)});
}

void close_if_open(int& fd) {
  if (fd >= 0) ::close(fd);
  fd = -1;
}

/// The four ends of the two connections; closes what is left open.
struct Ends {
  int parent_in = -1;
  int child_in = -1;
  int child_out = -1;
  int parent_out = -1;

  Ends() = default;
  Ends(const Ends&) = delete;
  Ends& operator=(const Ends&) = delete;
  ~Ends() {
    for (int* fd : {&parent_in, &child_in, &child_out, &parent_out}) close_if_open(*fd);
  }
};

/// The way in is a socket, since only send() can be told not to raise SIGPIPE.
bool open_ends(Ends& ends) {
  std::array<int, 2> in{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, in.data()) != 0) return false;
  ends.parent_in = in[0];
  ends.child_in = in[1];
  std::array<int, 2> out{};
  if (::pipe2(out.data(), O_CLOEXEC) != 0) return false;
  ends.parent_out = out[0];
  ends.child_out = out[1];
  for (int* fd : {&ends.parent_in, &ends.child_in, &ends.child_out, &ends.parent_out}) {
    if (!move_above_standard(*fd)) return false;
  }
  ::fcntl(ends.parent_out, F_SETPIPE_SZ, static_cast<int>(kReadBytes));  // a refusal only makes it slower
  return ::fcntl(ends.parent_out, F_SETFL, O_NONBLOCK) == 0;
}

std::string seconds(std::chrono::milliseconds time) {
  return format_double(static_cast<double>(time.count()) / 1000.0) + " s";
}

}  // namespace

std::string describe(const ChildEnd& end, const ChildLimits& limits) {
  switch (end.fate) {
    case ChildFate::kExited:
      return end.number == 0 ? "ended" : "ended with status " + std::to_string(end.number);
    case ChildFate::kTimeLimit:
      return "took longer than " + seconds(limits.wall_time);
    case ChildFate::kOutputLimit:
      return "wrote more than " + std::to_string(limits.output_bytes) + " bytes";
    case ChildFate::kSignalled:
      break;
  }
  if (end.number == SIGXCPU)
    return "used more than " + std::to_string(limits.cpu_seconds) + " s of processor time";
  const char* name = ::sigdescr_np(end.number);
  return "crashed with signal " + std::to_string(end.number) + (name ? " (" + std::string(name) + ")" : "");
}

fs::path find_helper(std::string_view name) {
  std::error_code problem;
  const fs::path executable = fs::read_symlink("/proc/self/exe", problem);
  if (problem)
    throw Error(ErrorCode::kIo, "cannot be read: " + problem.message(), {.file = "/proc/self/exe"});
  std::string searched;
  fs::path folder = executable.parent_path();
  for (int up = 0; up <= kFoldersUp; ++up, folder = folder.parent_path()) {
    const fs::path candidate = folder / "libexec" / "hallway" / name;
    if (fs::is_regular_file(candidate, problem)) return candidate;
    searched += (searched.empty() ? "" : ", ") + printable(candidate.parent_path().string(), 4096);
  }
  throw Error(ErrorCode::kIo, "the helper program " + printable(name) + " is in none of " + searched);
}

Child::Child(const fs::path& program, const std::vector<std::string>& arguments, const ChildLimits& limits)
    : limits_(limits), deadline_(Clock::now() + limits.wall_time) {
  Ends ends;
  if (!open_ends(ends)) fail(program, "cannot make a pipe", errno);
  ProcessSetup setup{.arguments = {helper_word(limits.memory_bytes, limits.cpu_seconds)},
                     .descriptors = {ends.child_in, ends.child_out, -1},
                     .own_session = false,
                     .environment = {}};
  setup.arguments.insert(setup.arguments.end(), arguments.begin(), arguments.end());
  process_.emplace(program, setup);
  std::swap(input_, ends.parent_in);
  std::swap(output_, ends.parent_out);
}

Child::~Child() {
  if (!stopped_) stop();
  close_input();
  close_output();
}

void Child::close_input() {
  close_if_open(input_);
}

void Child::close_output() {
  close_if_open(output_);
}

int Child::remaining_ms() const {
  const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline_ - Clock::now()).count();
  return static_cast<int>(std::clamp<std::chrono::milliseconds::rep>(left, 0, 1'000'000));
}

Child::Ready Child::poll_until_deadline(bool want_input, bool want_output) {
  while (!out_of_time_) {
    std::array<pollfd, 2> fds{pollfd{want_input ? input_ : -1, POLLOUT, 0},
                              pollfd{want_output ? output_ : -1, POLLIN, 0}};
    const int count = ::poll(fds.data(), fds.size(), remaining_ms());
    if (count > 0) return fds[1].revents != 0 ? Ready::kOutput : Ready::kInput;
    if (Clock::now() >= deadline_) out_of_time_ = true;
  }
  return Ready::kNothing;
}

/// @return bytes written; closes the input where the other side no longer reads
std::size_t Child::send_some(std::string_view bytes) {
  const ssize_t sent = ::send(input_, bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
  if (sent >= 0) return static_cast<std::size_t>(sent);
  if (errno != EINTR && errno != EAGAIN) close_input();
  return 0;
}

bool Child::send(std::string_view bytes) {
  while (!bytes.empty() && input_ >= 0) {
    if (poll_until_deadline(true, false) == Ready::kNothing) return false;
    bytes.remove_prefix(send_some(bytes));
  }
  return bytes.empty();
}

std::size_t Child::receive(char* buffer, std::size_t size) {
  while (output_ >= 0 && poll_until_deadline(false, true) == Ready::kOutput) {
    const ssize_t got = ::read(output_, buffer, size);
    if (got < 0 && (errno == EINTR || errno == EAGAIN)) continue;
    if (got <= 0) break;
    received_ += static_cast<std::size_t>(got);
    if (received_ > limits_.output_bytes) {
      too_much_output_ = true;
      break;
    }
    return static_cast<std::size_t>(got);
  }
  return 0;
}

std::string Child::exchange(std::string_view input) {
  std::string output;
  std::size_t used = 0;
  for (;;) {
    if (input.empty()) close_input();
    const Ready ready = poll_until_deadline(input_ >= 0, true);
    if (ready == Ready::kNothing) break;
    if (ready == Ready::kInput) {
      input.remove_prefix(send_some(input));
      continue;
    }
    if (output.size() - used < kReadBytes) output.resize(std::max(2 * output.size(), used + kReadBytes));
    const std::size_t got = receive(output.data() + used, kReadBytes);
    if (got == 0) break;
    used += got;
  }
  output.resize(used);
  return output;
}

void Child::stop() {
  if (!process_->ended_by(Clock::now())) {
    process_->signal(SIGTERM);
    process_->ended_by(Clock::now() + kTermGrace);
  }
  const ProcessEnd end = process_->kill();
  end_ = {end.signalled ? ChildFate::kSignalled : ChildFate::kExited, end.number};
  stopped_ = true;
}

ChildEnd Child::wait() {
  if (stopped_) return end_;
  close_input();
  if (!too_much_output_) close_output();
  if (!out_of_time_ && !too_much_output_ && !process_->ended_by(deadline_)) out_of_time_ = true;
  stop();
  if (too_much_output_) end_ = {ChildFate::kOutputLimit, 0};
  if (out_of_time_) end_ = {ChildFate::kTimeLimit, 0};
  return end_;
}

}  // namespace hallway
