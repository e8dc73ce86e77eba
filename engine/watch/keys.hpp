// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <string_view>

namespace hallway::watch {

/// Keys that are no characters; others are their ASCII codes.
enum Key : int {
  kKeyLeft = 1000,
  kKeyRight,
  kKeyUp,
  kKeyDown,
  kKeyHome,
  kKeyEnd,
};

/// What a key does, beside those of layers.
enum class Action {
  kLeave,
  kPause,
  kStep,
  kStepBack,
  kFaster,
  kSlower,
  kAhead,
  kBack,
  kFirst,
  kLast,
  kFollow,
  kFit,
  kZoomIn,
  kZoomOut,
  kLeft,
  kRight,
  kUp,
  kDown,
  kDots,
  kHelp,
};

/// A row of the table of keys.
struct KeyRow {
  Action action = Action::kHelp;
  std::span<const int> keys{};
  std::string_view shown{};  ///< how help names the keys
  std::string_view help{};
};

std::span<const KeyRow> key_table();

/// What a key does; nothing for a key without a meaning.
std::optional<Action> action_of(int key);

}  // namespace hallway::watch
