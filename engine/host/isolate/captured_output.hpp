// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

#include "host/stage.hpp"

namespace hallway::host {

/// What a plugin's process writes to its standard output and error, which a plugin should not, as lines of its log: the first kMaxLines of them, of
/// kMaxLineBytes each. The rest is read and dropped, so that the process never waits for us for long.
class CapturedOutput {
 public:
  static constexpr std::size_t kMaxLines = 50;
  static constexpr std::size_t kMaxLineBytes = 400;

  /// Gives `sink` (which may be empty) what complete lines there are in `text`.
  void add(std::string_view text, const LogSink& sink, const std::string& plugin);
  /// All bytes so far.
  std::uint64_t bytes() const { return bytes_; }
  /// Gives it what is left without a line end, and how much was dropped.
  void finish(const LogSink& sink, const std::string& plugin);

 private:
  void add_line(const LogSink& sink, const std::string& plugin);

  std::string line_;
  std::size_t lines_ = 0;
  std::uint64_t bytes_ = 0;
  std::uint64_t dropped_bytes_ = 0;
};

}  // namespace hallway::host
