// SPDX-License-Identifier: MIT
#pragma once

namespace hallway {

/// Which system calls stay allowed.
enum class FileWrites {
  kAllowed,  ///< something else restrains them
  kNone,     ///< no file is opened for writing, made, renamed or removed
};

/// Refuses from now on, for this thread and those it makes (seccomp): sockets but pairs, other programs and processes, signals to, tracing and
/// memory of other processes, higher limits, and what administers a machine. A refused call fails with EPERM. Needs no_new_privs.
/// @return false if the kernel has no such filter
bool filter_system_calls(FileWrites writes);

}  // namespace hallway
