// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace hallway {

/// What a process that runs foreign code may do from now on.
struct Confinement {
  std::uint64_t data_bytes =
      0;  ///< private writable memory (RLIMIT_DATA); left out under sanitizers, which reserve more
  std::uint64_t file_bytes = 0;                   ///< largest file that it may write
  std::uint64_t open_files = 256;                 ///< descriptors at a time
  std::filesystem::path scratch{};                ///< the folder it may write in; empty: none
  std::vector<std::filesystem::path> writable{};  ///< further files and folders that it may write
};

/// Confines this process, for good, before it makes a second thread: limits; no core file; no new privileges, and of root's only
/// those to read files; no files written but under `scratch`, `writable` and to /dev/null (Landlock; where the kernel has none, no file is opened for
/// writing at all); no sockets but pairs, no other programs or processes, no signals to or memory of other processes (seccomp).
/// @return what this kernel does not provide, as one sentence each; empty where all of it stands
std::vector<std::string> confine(const Confinement& confinement);

/// Which files a filter of system calls leaves writable.
enum class FileWrites {
  kAllowed,  ///< something else restrains them
  kNone,     ///< no file is opened for writing, made, renamed or removed
};

/// The part of confine() that refuses system calls, from now on, for this thread and those it makes (seccomp): sockets but pairs, other programs
/// and processes, signals to, tracing and memory of other processes, higher limits, and what administers a machine. A refused call fails with
/// EPERM. Needs no_new_privs.
/// @return false if the kernel has no such filter
bool filter_system_calls(FileWrites writes);

}  // namespace hallway
