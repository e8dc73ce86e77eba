// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/sample.h>

#include <string>

namespace hallway::host {

// Samples as JSON, by the rows of their kinds (PayloadMember): docs/formats.md, Samples as JSON. The text has no blanks, and one sample has one
// text. Numbers are the shortest decimals that read back as the same value.

/// Appends a sample: its sensor, kind, number, times and flags, and its payload where the kind is known. O(its elements).
/// @param sample  as frame_bytes.hpp demands; of an unknown kind the payload is not looked at
void append_sample_json(std::string& out, const hw_sample_t& sample);

/// A frame with all its samples: {"sequence":…,"t_ns":…,"samples":[…]}. O(their elements).
/// @param frame  as FrameReader and FrameBuilder give it
std::string frame_json(const hw_frame_t& frame);

}  // namespace hallway::host
