// SPDX-License-Identifier: MIT
#pragma once

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace hallway {

/// How a program ended by itself or by a signal.
struct ProcessEnd {
  bool signalled = false;  ///< `number` is a signal, else an exit status
  int number = 0;
};

/// What a program is started with beside its path.
struct ProcessSetup {
  std::vector<std::string> arguments;  ///< after the program's own name
  std::vector<int> descriptors;  ///< of ours, each above 2: its 0, 1, 2, …; -1: /dev/null. It gets no others
  bool own_session = false;      ///< else only a process group of its own
  std::vector<std::string> environment;  ///< "NAME=value"s that replace or join ours
};

/// The one way in which programs are started: posix_spawn, in a process group of its own, with our working folder, all signals at
/// their default and unblocked. Ends the whole group with its leader, so that nothing that stayed in the group outlives it.
class ProcessGroup {
 public:
  /// Starts `program`. Throws Error{kIo} if it cannot be started.
  ProcessGroup(const std::filesystem::path& program, const ProcessSetup& setup);
  /// kill(), if nobody has asked how it ended.
  ~ProcessGroup();
  ProcessGroup(const ProcessGroup&) = delete;
  ProcessGroup& operator=(const ProcessGroup&) = delete;

  pid_t pid() const { return pid_; }
  /// Waits until the leader has ended, at most until `deadline`. @return whether it has
  bool ended_by(std::chrono::steady_clock::time_point deadline) const;
  /// Sends a signal to every process of the group.
  void signal(int number) const;
  /// Ends what is left of the group by SIGKILL and takes the leader's end, once; the same answer when asked again.
  ProcessEnd kill();

 private:
  pid_t pid_ = -1;
  bool reaped_ = false;
  ProcessEnd end_{};
};

/// Moves a descriptor above 0, 1 and 2, which a started program's own take: in a process that had closed them a new one would be one
/// of these. @return false where that fails; `fd` is then closed
bool move_above_standard(int& fd);

}  // namespace hallway
