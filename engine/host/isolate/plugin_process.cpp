// SPDX-License-Identifier: MIT
#include "host/isolate/plugin_process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <thread>
#include <utility>

#include "base/bytes.hpp"
#include "base/child.hpp"
#include "base/text.hpp"
#include "host/isolate/plugin_server.hpp"
#include "host/isolate/process_use.hpp"

namespace hallway::host {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

constexpr auto kSlice = 10ms;           ///< between looks at a process that does not answer
constexpr auto kBusySlice = 200us;      ///< while it writes a lot
constexpr auto kBacktraceTime = 300ms;  ///< for a backtrace of a process that hangs
constexpr int kPipeBytes = 1 << 20;
constexpr std::size_t kMaxPacket = 20'000;

[[noreturn]] void fail_io(const char* what) {
  throw Error(ErrorCode::kIo, fmt::format("{}: {}", what, std::generic_category().message(errno)));
}

void close_fd(int& fd) {
  if (fd >= 0) ::close(fd);
  fd = -1;
}

/// Two ends of a connection, closed with the object unless taken.
struct Pair {
  std::array<int, 2> ends{-1, -1};

  Pair() = default;
  Pair(const Pair&) = delete;
  Pair& operator=(const Pair&) = delete;
  ~Pair() {
    for (int& fd : ends) close_fd(fd);
  }
  int take(std::size_t i) { return std::exchange(ends[i], -1); }
};

void open_pipe(Pair& pair) {
  if (::pipe2(pair.ends.data(), O_CLOEXEC) != 0) fail_io("cannot make a pipe");
  for (int& fd : pair.ends) {
    if (!move_above_standard(fd)) fail_io("cannot make a pipe");
  }
  ::fcntl(pair.ends[0], F_SETPIPE_SZ, kPipeBytes);  // a refusal only makes it slower
  if (::fcntl(pair.ends[0], F_SETFL, O_NONBLOCK) != 0) fail_io("cannot make a pipe");
}

/// A socket of packets, so that messages of several threads stay apart.
void open_packets(Pair& pair) {
  if (::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, pair.ends.data()) != 0) {
    fail_io("cannot make a socket");
  }
  for (int& fd : pair.ends) {
    if (!move_above_standard(fd)) fail_io("cannot make a socket");
  }
}

}  // namespace

std::uint64_t data_limit(const Isolation& isolation) {
  constexpr std::uint64_t kMargin = std::uint64_t{256} << 20;
  return isolation.memory_bytes + kMargin;
}

ScratchFolder::ScratchFolder(const fs::path& parent) {
  if (parent.empty()) return;
  std::string name = (fs::absolute(parent) / "hallway-plugin-XXXXXX").string();
  if (::mkdtemp(name.data()) != nullptr) path_ = name;
}

ScratchFolder::~ScratchFolder() {
  std::error_code problem;
  if (!path_.empty()) fs::remove_all(path_, problem);
}

PluginProcess::PluginProcess(const Isolation& isolation, LogSink log, std::string wanted)
    : isolation_(isolation),
      log_(std::move(log)),
      plugin_(printable(wanted, 4096)),
      where_{"", 0, fmt::format("plugin `{}`", plugin_)},
      scratch_(isolation.temporary) {
  Pair output;
  Pair log_packets;
  open_pipe(output);
  open_packets(log_packets);
  ProcessSetup setup{.arguments = {fmt::to_string(::getpid())},
                     .descriptors = {-1, output.ends[1], output.ends[1], channel_.request_descriptor(),
                                     channel_.reply_descriptor(), log_packets.ends[1]},
                     .own_session = true,
                     .environment = {}};
  if (!scratch_.path().empty()) setup.environment.push_back("TMPDIR=" + scratch_.path().string());
  process_.emplace(find_helper(kPluginProgram), setup);
  output_ = output.take(0);
  log_socket_ = log_packets.take(0);
}

PluginProcess::~PluginProcess() {
  end();
  close_fd(output_);
  close_fd(log_socket_);
}

void PluginProcess::set_plugin(const std::string& id, const fs::path& file) {
  plugin_ = id;
  where_ = {file.string(), 0, fmt::format("plugin `{}`", id)};
}

void PluginProcess::submit(Request request, std::size_t size) {
  if (!process_) throw Error(ErrorCode::kInternal, "a call of a plugin whose process has ended");
  if (under_way() == 0) call_begin_ = Clock::now();
  channel_.submit(request, size);
}

HostChannel::Answer PluginProcess::await(Request request) {
  std::chrono::nanoseconds slice = kSlice;
  while (!channel_.wait(slice)) {
    const std::size_t before = captured_.bytes();
    supervise(request);
    slice = captured_.bytes() != before ? std::chrono::nanoseconds(kBusySlice) : kSlice;
  }
  const Clock::time_point now = Clock::now();
  if (now >= next_check_) check_use(request);
  call_begin_ = now;
  read_log();
  try {
    return channel_.take();
  } catch (const BadBytes& bad) {
    fail_protocol(request, bad.what);
  }
}

std::chrono::milliseconds PluginProcess::limit_of(Request request) const {
  return request == Request::kReport ? isolation_.report_time() : isolation_.call_time;
}

void PluginProcess::supervise(Request request) {
  read_log();
  read_output();
  const Clock::time_point now = Clock::now();
  if (process_->ended_by(now)) {
    if (!channel_.wait(0ns)) fail_ended(request);
    return;  // it answered before it ended
  }
  if (now >= next_check_) check_use(request);
  if (now - call_begin_ >= limit_of(request)) fail_timeout(request);
}

void PluginProcess::check_use(Request request) {
  next_check_ = Clock::now() + kSlice;
  read_output();
  const std::optional<ProcessUse> use = read_process_use(process_->pid());
  if (!use) return;
  // What it is given stands in its memory too.
  if (use->memory_bytes > isolation_.memory_bytes + channel_.request_bytes()) {
    fail(request, {.what = Misdeed::kMemory},
         fmt::format("took more than {} MiB of memory", isolation_.memory_bytes >> 20));
  }
  if (use->threads > isolation_.threads) {
    fail(request, {.what = Misdeed::kThreads}, fmt::format("made more than {} threads", isolation_.threads));
  }
}

void PluginProcess::fail_ended(Request request) {
  const ProcessEnd how = process_->kill();
  if (channel_.crash().out_of_memory != 0) {
    fail(request, {.what = Misdeed::kMemory},
         fmt::format("took more than {} MiB of memory", isolation_.memory_bytes >> 20));
  }
  if (!how.signalled) {
    fail(request, {.what = Misdeed::kExit, .exit_status = how.number},
         fmt::format("ended its process with status {}", how.number));
  }
  const char* name = ::sigdescr_np(how.number);
  fail(request, {.what = Misdeed::kCrash, .signal = how.number},
       fmt::format("crashed with signal {}{}", how.number, name ? fmt::format(" ({})", name) : ""));
}

void PluginProcess::fail_timeout(Request request) {
  channel_.crash().complete = 0;
  ::syscall(SYS_tgkill, process_->pid(), process_->pid(), backtrace_signal());
  const Clock::time_point end = Clock::now() + kBacktraceTime;
  while (channel_.crash().complete == 0 && Clock::now() < end) std::this_thread::sleep_for(1ms);
  fail(request, {.what = Misdeed::kTimeout},
       fmt::format("did not return within {} s",
                   format_double(std::chrono::duration<double>(limit_of(request)).count())));
}

void PluginProcess::fail_protocol(Request request, const std::string& what) {
  fail(request, {.what = Misdeed::kProtocol}, "gave an answer that is none: " + what);
}

void PluginProcess::fail(Request request, Verdict verdict, const std::string& what) {
  if (verdict.what == Misdeed::kCrash || verdict.what == Misdeed::kTimeout) {
    verdict.backtrace = read_crash_record(channel_.crash());
  }
  const std::uint32_t load_step = channel_.crash().load_step;
  end();
  verdict.call = call_name(request, load_step);
  verdict.plugin = plugin_;
  verdict.message = fmt::format("{}(): {}", verdict.call, what);
  throw PluginFailure(ErrorCode::kPluginFault, verdict.message, where_, verdict);
}

void PluginProcess::end() {
  if (!process_) return;
  process_->kill();
  process_.reset();
  read_log();
  read_output();
  captured_.finish(log_, plugin_);
}

void PluginProcess::read_output() {
  std::array<char, 65536> buffer;
  // So much at a time: a process that never stops writing shall not keep us from ending it.
  for (int i = 0; i < 64; ++i) {
    const ssize_t got = ::read(output_, buffer.data(), buffer.size());
    if (got <= 0) return;
    captured_.add({buffer.data(), static_cast<std::size_t>(got)}, log_, plugin_);
  }
}

void PluginProcess::read_log() {
  std::array<char, kMaxPacket> packet;
  for (int i = 0; i < 1000; ++i) {
    const ssize_t got = ::recv(log_socket_, packet.data(), packet.size(), MSG_DONTWAIT);
    if (got < static_cast<ssize_t>(sizeof(LogHead))) return;
    ByteReader reader(std::string_view(packet.data(), static_cast<std::size_t>(got)));
    const auto head = reader.get<LogHead>();
    if (log_) log_(plugin_, head.level, printable(reader.take_rest(), kMaxPacket));
  }
}

}  // namespace hallway::host
