// SPDX-License-Identifier: MIT
#pragma once

#include "base/bytes.hpp"
#include "host/output/outputs.hpp"

namespace hallway::host {

/// Writes what a call put: the counterpart of frame_bytes for the way back. Only the two sides of one program read it: it is no format of files.
/// @param n_samples  of the call's frame; 0 of report()
void write_outputs(AlignedByteWriter& writer, const Outputs& outputs, std::uint32_t n_samples);

/// Gives every output that was written to `collector`, which checks them as if a plugin put them here, between its begin() and finish(). Throws
/// BadBytes where the bytes are none of write_outputs().
void read_outputs(AlignedByteReader& reader, OutputCollector& collector);

}  // namespace hallway::host
