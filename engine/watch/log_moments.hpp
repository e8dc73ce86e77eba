// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "log/mcap_reader.hpp"
#include "watch/moment.hpp"

namespace hallway::watch {

/// Reads the moments of a log one after the other. One frame is in memory at a time.
class LogMoments {
 public:
  /// Reads `run.mcap`, also of a run that did not come to its end. Throws Error{kBadInput} if it is no MCAP file, Error{kIo}.
  explicit LogMoments(const std::filesystem::path& file);
  ~LogMoments();
  LogMoments(const LogMoments&) = delete;
  LogMoments& operator=(const LogMoments&) = delete;

  /// The next moment; nothing at the end, or where the log is damaged. Throws Error{kBadInput} for a message that is not what its channel
  /// promises, Error{kIo}.
  std::optional<Moment> next();
  /// Begins again with the first one.
  void restart();
  /// Where the log is damaged; known after next() gave nothing.
  std::optional<log::McapDamage> damage() const;

 private:
  struct Reading;

  std::filesystem::path file_;
  std::unique_ptr<Reading> reading_;
};

}  // namespace hallway::watch
