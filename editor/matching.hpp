// SPDX-License-Identifier: MIT
#pragma once

#include "editor/state.hpp"

namespace hallway::editor {

/// A document as the successor of a state: entities and brushes that were there keep their numbers and stay shared, the rest gets new
/// ones. An entity is known again by its text without brushes, else by its place if its class there is the same; brushes by
/// their text. O(size of the map).
State matched(const State& before, const map::Document& document);

}  // namespace hallway::editor
