// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "host/output/outputs.hpp"
#include "log/run_log.hpp"

namespace hallway::run {

/// The commands of a replay beside those in its log. The replay is an open loop: its frames are those of the log, whatever is commanded.
class CommandComparison {
 public:
  /// Takes the answer to a frame.
  /// @param then     the command in the log
  /// @param outputs  of the plugin that is called for it; null where it has failed
  void add(std::uint32_t iteration, const std::optional<log::CommandAnswer>& then,
           const host::Outputs* outputs);

  /// Frames that have a command in the log.
  std::uint64_t compared() const { return compared_; }
  /// Of them and of those without one: where the answer has another command, or none, or one that the log does not have.
  std::uint64_t different() const { return different_; }
  /// The first of those.
  std::optional<std::uint32_t> first_different() const { return first_different_; }

 private:
  std::uint64_t compared_ = 0;
  std::uint64_t different_ = 0;
  std::optional<std::uint32_t> first_different_;
};

/// The member `replayed_commands` of run.json (docs/formats.md).
nlohmann::ordered_json to_json(const CommandComparison& comparison);

}  // namespace hallway::run
