// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "bsp/compile.hpp"
#include "pvs/visible_sets.hpp"

namespace hallway::world {

/// What is kept of a compilation.
struct Cached {
  bsp::Compiled partition;
  std::optional<pvs::VisibleSets> visible;
};

/// As bytes, with a checksum.
std::string encode(const bsp::Compiled& partition, const std::optional<pvs::VisibleSets>& visible);
/// Empty if the bytes are not, whole and unchanged, what encode() made.
std::optional<Cached> decode(std::string_view bytes);

}  // namespace hallway::world
