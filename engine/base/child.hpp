// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/spawn.hpp"

namespace hallway {

/// What a helper program may use up. Memory and processor time are enforced by the helper itself (begin_helper()), the rest
/// from outside.
struct ChildLimits {
  std::chrono::milliseconds wall_time{60'000};          ///< from its start to its end
  std::uint64_t memory_bytes = std::uint64_t{4} << 30;  ///< address space
  std::uint64_t cpu_seconds = 30;                       ///< processor time
  std::uint64_t output_bytes = std::uint64_t{2} << 30;  ///< what it may write to its standard output
};

/// How a helper program ended.
enum class ChildFate {
  kExited,       ///< by itself; `number` is its exit status
  kSignalled,    ///< by a signal that was not ours; `number` is the signal
  kTimeLimit,    ///< ended by us: over `wall_time`
  kOutputLimit,  ///< ended by us: over `output_bytes`
};

struct ChildEnd {
  ChildFate fate = ChildFate::kExited;
  int number = 0;

  /// Ended by itself with exit status 0.
  bool good() const { return fate == ChildFate::kExited && number == 0; }
};

/// What happened, to stand after a subject: "crashed with signal 11 (Segmentation fault)", "took longer than 20 s".
std::string describe(const ChildEnd& end, const ChildLimits& limits);

/// The helper program `name`: `libexec/hallway/<name>` beside the folder of the running executable or up to three folders
/// above it, which holds in the build tree and where it is installed. Throws Error{kIo} naming the folders searched.
std::filesystem::path find_helper(std::string_view name);

/// A helper program that runs beside us in a process group of its own, started by posix_spawn. It has our environment and
/// working folder, its standard input and output are joined to this object, its standard error goes nowhere, no other
/// descriptor and no signal setting of ours reaches it.
///
/// Once it runs, it ends at the latest when the thread that made this object ends (PR_SET_PDEATHSIG goes by thread), so
/// make it in a thread that lives as long. Objects are independent of each other: any number of threads may each use its
/// own. No function raises SIGPIPE or fails for EINTR.
class Child {
 public:
  /// Starts `program`, a helper whose main() calls begin_helper(). Throws Error{kIo} if it cannot be started.
  Child(const std::filesystem::path& program, const std::vector<std::string>& arguments,
        const ChildLimits& limits);
  /// Ends it if it still runs, with every process of its group.
  ~Child();
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// Writes all of `bytes` to its standard input, waiting as long as it must. False if that cannot be done: it has closed
  /// its input, ended, or run out of time; wait() tells.
  bool send(std::string_view bytes);
  /// Lets it see the end of its input.
  void close_input();
  /// Waits for output and reads up to `size` bytes, at least one. 0 at the end of its output, out of time, or over the
  /// output limit; wait() tells.
  std::size_t receive(char* buffer, std::size_t size);
  /// Sends `input`, closes its input and reads until the end of its output, both at once, so that neither side can wait
  /// for the other for ever. What could be read up to an end of any kind; wait() tells.
  std::string exchange(std::string_view input);

  /// Closes both directions and waits for its end; ends it by SIGTERM, then SIGKILL, when its time is up. May be called
  /// again.
  ChildEnd wait();

 private:
  enum class Ready { kInput, kOutput, kNothing };

  void close_output();
  Ready poll_until_deadline(bool want_input, bool want_output);
  std::size_t send_some(std::string_view bytes);
  int remaining_ms() const;
  void stop();

  ChildLimits limits_;
  std::chrono::steady_clock::time_point deadline_;
  std::optional<ProcessGroup> process_;
  int input_ = -1;   ///< our end of its standard input
  int output_ = -1;  ///< our end of its standard output
  std::uint64_t received_ = 0;
  bool out_of_time_ = false;
  bool too_much_output_ = false;
  bool stopped_ = false;
  ChildEnd end_{};
};

}  // namespace hallway
