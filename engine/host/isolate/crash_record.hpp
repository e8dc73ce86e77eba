// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <string>
#include <vector>

namespace hallway::host {

/// What a dying process leaves in shared memory.
struct CrashRecord {
  std::atomic<std::uint32_t> lines;            ///< of `text` that are complete
  std::atomic<std::uint32_t> complete;         ///< 1: there will be no more
  std::atomic<std::uint32_t> out_of_memory;    ///< 1: operator new has failed
  std::atomic<std::uint32_t> load_step;        ///< a LoadStep: the last one that was begun
  std::array<std::array<char, 320>, 48> text;  ///< a backtrace, innermost first, each line ending with 0
};

/// From now on a fatal signal fills `record` (which must live for ever) before the process ends by that signal, also when the stack of the main
/// thread is used up; kBacktraceSignal fills it and lets the process go on; operator new says so there when it fails.
void keep_crash_record(CrashRecord& record);

/// The signal that asks a process for a backtrace of the thread that gets it.
int backtrace_signal();

/// The lines of a record that nobody vouches for, with names of C++ as people write them, safe to print.
std::vector<std::string> read_crash_record(const CrashRecord& record);

}  // namespace hallway::host
