// SPDX-License-Identifier: MIT
#pragma once

#include <exception>
#include <string>

namespace hallway {

/// What kind of failure an Error is; each kind has one exit status (see exit_status()).
enum class ErrorCode {
  kUsage,        ///< the command line is wrong
  kBadInput,     ///< a file's content is not what it should be
  kIo,           ///< a file cannot be read or written
  kPluginLoad,   ///< a plugin was not found or cannot be loaded
  kPluginFault,  ///< a loaded plugin misbehaved
  kInterrupted,  ///< a signal asked the program to stop
  kInternal,     ///< a bug in Hallway
};

/// Where a failure stands in the input. Members that do not apply are empty or zero.
struct Where {
  std::string file{};     ///< path as the user gave it
  int line = 0;           ///< 1-based line, 0 where there is none
  std::string element{};  ///< e.g. "entity 3, brush 7", "key `noise_m`"
};

/// The one exception of Hallway. Thrown by libraries, caught at the ABI border and in main().
class Error : public std::exception {
 public:
  Error(ErrorCode code, std::string message, Where where = {});

  ErrorCode code() const noexcept { return code_; }
  /// The cause alone, without the place.
  const std::string& message() const noexcept { return message_; }
  const Where& where() const noexcept { return where_; }
  /// "file:line: element: message", leaving out what is empty.
  const char* what() const noexcept override { return what_.c_str(); }

 private:
  ErrorCode code_;
  std::string message_;
  Where where_;
  std::string what_;
};

/// A stable name for the code, e.g. "bad_input"; used in JSON.
const char* error_code_name(ErrorCode code) noexcept;

/// The documented exit status of the command line: 2 usage, 3 input or I/O, 4 plugin not loadable, 5 plugin
/// misbehaved, 130 interrupted, 6 a bug in Hallway.
int exit_status(ErrorCode code) noexcept;

}  // namespace hallway
