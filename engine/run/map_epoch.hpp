// SPDX-License-Identifier: MIT
#pragma once

#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "eval/path_parts.hpp"
#include "host/outputs.hpp"

namespace hallway::run {

/// The counter by which a plugin says which connected part of its map a pose is in; with `_N` after it, in report(): into which part N was joined.
inline constexpr std::string_view kMapEpoch = "map_epoch";

/// A counter's value as the number of a part; empty for what is no whole number from 0 to 2^53.
inline std::optional<std::uint64_t> part_number(double value) {
  constexpr double kMost = 9007199254740992.0;
  if (!(value >= 0.0) || value > kMost || value != std::floor(value)) return std::nullopt;
  return static_cast<std::uint64_t>(value);
}

/// The part that the pose of this answer is in; empty where the plugin does not say so.
inline std::optional<std::uint64_t> map_epoch_of(const host::Outputs& outputs) {
  for (const host::Counter& counter : outputs.counters()) {
    if (counter.name == kMapEpoch) return part_number(counter.value);
  }
  return std::nullopt;
}

/// The parts that a report says to be joined; none for no report.
inline std::vector<eval::JoinedEpoch> joined_epochs_of(const host::Outputs* report) {
  std::vector<eval::JoinedEpoch> joined;
  if (report == nullptr) return joined;
  for (const host::Counter& counter : report->counters()) {
    const std::string_view name = counter.name;
    if (name.size() < kMapEpoch.size() + 2 || !name.starts_with(kMapEpoch) || name[kMapEpoch.size()] != '_')
      continue;
    const std::string_view digits = name.substr(kMapEpoch.size() + 1);
    std::uint64_t epoch = 0;
    const auto [end, code] = std::from_chars(digits.data(), digits.data() + digits.size(), epoch);
    const auto into = part_number(counter.value);
    if (code == std::errc() && end == digits.data() + digits.size() && into) joined.push_back({epoch, *into});
  }
  return joined;
}

}  // namespace hallway::run
