// SPDX-License-Identifier: MIT
#include "watch/keys.hpp"

#include <algorithm>
#include <array>

namespace hallway::watch {
namespace {

constexpr std::array kLeave{int{'q'}, int{'Q'}};
constexpr std::array kPause{int{' '}, int{'p'}};
constexpr std::array kStep{int{'.'}, int{'n'}};
constexpr std::array kStepBack{int{','}, int{'b'}};
constexpr std::array kFaster{int{'+'}, int{'='}};
constexpr std::array kSlower{int{'-'}, int{'_'}};
constexpr std::array kAhead{int{']'}};
constexpr std::array kBack{int{'['}};
constexpr std::array kFirst{int{kKeyHome}, int{'<'}};
constexpr std::array kLast{int{kKeyEnd}, int{'>'}};
constexpr std::array kFollow{int{'f'}};
constexpr std::array kFit{int{'a'}};
constexpr std::array kZoomIn{int{'z'}, int{'i'}};
constexpr std::array kZoomOut{int{'Z'}, int{'o'}};
constexpr std::array kLeft{int{kKeyLeft}, int{'h'}};
constexpr std::array kRight{int{kKeyRight}, int{'l'}};
constexpr std::array kUp{int{kKeyUp}, int{'k'}};
constexpr std::array kDown{int{kKeyDown}, int{'j'}};
constexpr std::array kDots{int{'d'}};
constexpr std::array kHelp{int{'?'}};

constexpr std::array kTable{
    KeyRow{Action::kLeave, kLeave, "q", "close the view"},
    KeyRow{Action::kPause, kPause, "SPACE", "pause, go on"},
    KeyRow{Action::kStep, kStep, ". n", "one frame ahead"},
    KeyRow{Action::kStepBack, kStepBack, ", b", "one frame back"},
    KeyRow{Action::kAhead, kAhead, "]", "10 s ahead"},
    KeyRow{Action::kBack, kBack, "[", "10 s back"},
    KeyRow{Action::kFirst, kFirst, "HOME <", "to the first frame"},
    KeyRow{Action::kLast, kLast, "END >", "to the last frame"},
    KeyRow{Action::kFaster, kFaster, "+", "twice as fast"},
    KeyRow{Action::kSlower, kSlower, "-", "half as fast"},
    KeyRow{Action::kFollow, kFollow, "f", "follow the robot"},
    KeyRow{Action::kFit, kFit, "a", "show all"},
    KeyRow{Action::kZoomIn, kZoomIn, "z i", "zoom in"},
    KeyRow{Action::kZoomOut, kZoomOut, "Z o", "zoom out"},
    KeyRow{Action::kLeft, kLeft, "LEFT h", "move the view"},
    KeyRow{Action::kRight, kRight, "RIGHT l", "likewise"},
    KeyRow{Action::kUp, kUp, "UP k", "likewise"},
    KeyRow{Action::kDown, kDown, "DOWN j", "likewise"},
    KeyRow{Action::kDots, kDots, "d", "other dots"},
    KeyRow{Action::kHelp, kHelp, "?", "this list"},
};

}  // namespace

std::span<const KeyRow> key_table() {
  return kTable;
}

std::optional<Action> action_of(int key) {
  const auto found = std::ranges::find_if(
      kTable, [key](const KeyRow& row) { return std::ranges::find(row.keys, key) != row.keys.end(); });
  return found == kTable.end() ? std::nullopt : std::optional(found->action);
}

}  // namespace hallway::watch
