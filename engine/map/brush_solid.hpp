// SPDX-License-Identifier: MIT
#pragma once

#include "map/world.hpp"

namespace hallway::map {

/// A brush as a body, whatever its materials say.
/// @param what  it is, for messages: "a zone"
/// Throws Error{kBadInput} with file and line for one that is no convex solid.
Solid solid_of(const Document& document, const Brush& brush, const char* what);

}  // namespace hallway::map
