// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>

namespace hallway::cli {

/// Throws Error{kIo} where an output file could not be replaced: a folder, a pipe or a device.
void check_output_file(const std::string& file);

/// The same for a picture, whose name ends in .png: so no map or log is replaced by one. Throws Error{kUsage} too.
void check_picture_file(const std::string& file);

/// Throws Error{kUsage} where `out` is one of the inputs, or a folder that holds one: it would be replaced by what is made of it. An `out` that is not there
/// is none of them.
void check_replaces_no_input(const std::string& out, std::span<const std::string> inputs);

}  // namespace hallway::cli
