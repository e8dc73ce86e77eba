// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/planes.h>

#include <cstdint>

#include "host/samples/frame_parts.hpp"

namespace hallway::host {

// For frame_bytes.cpp: the parts of a sample of planes.

/// Checks what can be told without a look at the planes. Throws Error{kBadInput}.
/// @param n_samples  of the frame that they are a sample of
void check_planes(const hw_planes_t& planes, std::uint32_t n_samples);

/// Puts planes that check_planes() accepts.
void put_planes(AlignedByteWriter& to, const hw_planes_t& planes);

/// The planes at `offset`; pointers lead into the bytes, and nothing that they lead to is checked. Throws Error{kBadInput}.
hw_planes_t take_planes(PartCursor& cursor, std::uint64_t offset);

}  // namespace hallway::host
