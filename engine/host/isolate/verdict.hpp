// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/error.hpp"

namespace hallway::host {

/// What a plugin did.
enum class Misdeed {
  kFault,     ///< failed by its own account, let an exception escape, or put a wrong output
  kCrash,     ///< ended by a signal
  kExit,      ///< ended its process by itself
  kTimeout,   ///< did not return within the time of a call
  kMemory,    ///< took more memory than it may
  kThreads,   ///< made more threads than it may
  kProtocol,  ///< the memory that it shares with us does not hold what the other side of it writes
};

/// A stable name: "fault", "crash", "exit", "timeout", "memory", "threads", "protocol".
const char* misdeed_name(Misdeed what);

/// How a plugin failed.
struct Verdict {
  Misdeed what = Misdeed::kFault;
  int signal = 0;                        ///< of kCrash; else 0
  int exit_status = 0;                   ///< of kExit; else 0
  std::string call{};                    ///< "process", "report", "activate", "load", …
  std::string plugin{};                  ///< its id, or what was asked for where it never came to that
  std::string message{};                 ///< one line, safe to print
  std::vector<std::string> backtrace{};  ///< innermost first, safe to print; empty where it cannot be had
};

/// A plugin that failed; its code is kPluginFault, of refusals at activation kBadInput.
class PluginFailure : public Error {
 public:
  PluginFailure(ErrorCode code, const std::string& message, const Where& where, Verdict verdict)
      : Error(code, message, where), verdict_(std::move(verdict)) {}

  const Verdict& verdict() const noexcept { return verdict_; }

 private:
  Verdict verdict_;
};

}  // namespace hallway::host
