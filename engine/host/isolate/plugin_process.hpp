// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>

#include "base/spawn.hpp"
#include "host/isolate/captured_output.hpp"
#include "host/isolate/channel.hpp"
#include "host/isolate/isolation.hpp"
#include "host/isolate/verdict.hpp"

namespace hallway::host {

/// The program that PluginProcess starts, found by find_helper().
inline constexpr const char* kPluginProgram = "hallway-plugin";

/// The limit on private memory of a plugin's process: above what is watched, so that a breach is seen before an allocation fails, but not by much.
std::uint64_t data_limit(const Isolation& isolation);

/// A folder of our own that is removed with everything in it.
class ScratchFolder {
 public:
  /// Makes one in `parent`; none where that is empty or it cannot be made: path() is then empty.
  explicit ScratchFolder(const std::filesystem::path& parent);
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// The process of one isolated plugin, supervised: every wait for an answer ends with the answer or with a PluginFailure, whatever the process
/// does. It ends at the latest with this object, or with the thread that made it.
class PluginProcess {
 public:
  /// Starts it. `wanted` stands for the plugin until set_plugin() says more. Throws Error{kIo}.
  PluginProcess(const Isolation& isolation, LogSink log, std::string wanted);
  ~PluginProcess();
  PluginProcess(const PluginProcess&) = delete;
  PluginProcess& operator=(const PluginProcess&) = delete;

  /// The plugin for messages and its log.
  void set_plugin(const std::string& id, const std::filesystem::path& file);
  const std::filesystem::path& scratch() const { return scratch_.path(); }

  /// Whether it has not been ended, by a failure or by end().
  bool runs() const { return process_.has_value(); }
  std::uint32_t under_way() const { return channel_.under_way(); }
  std::span<std::byte> room() { return channel_.room(); }
  /// Submits a request of the first `size` bytes of room(). Throws Error{kInternal} after a failure.
  void submit(Request request, std::size_t size);
  /// Waits for the answer to the oldest request under way, which is a `request`. Throws PluginFailure, after which the process is no more.
  HostChannel::Answer await(Request request);
  /// Ends the process with a failure of its protocol.
  [[noreturn]] void fail_protocol(Request request, const std::string& what);

  /// Ends it. May be called again.
  void end();

 private:
  using Clock = std::chrono::steady_clock;

  void read_output();
  void read_log();
  std::chrono::milliseconds limit_of(Request request) const;
  void supervise(Request request);
  void check_use(Request request);
  [[noreturn]] void fail_ended(Request request);
  [[noreturn]] void fail_timeout(Request request);
  [[noreturn]] void fail(Request request, Verdict verdict, const std::string& what);

  Isolation isolation_;
  LogSink log_;
  std::string plugin_;
  Where where_;
  ScratchFolder scratch_;
  HostChannel channel_;
  std::optional<ProcessGroup> process_;
  CapturedOutput captured_;
  int output_ = -1;
  int log_socket_ = -1;
  Clock::time_point call_begin_{};  ///< of the oldest call under way, or later
  Clock::time_point next_check_{};
};

}  // namespace hallway::host
