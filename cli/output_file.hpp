// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <span>
#include <string>

namespace hallway::cli {

/// Throws Error{kIo} where an output file could not be replaced: a folder, a pipe or a device.
void check_output_file(const std::string& file);

/// The same for a picture, whose name ends in .png: so no map or log is replaced by one. Throws Error{kUsage} too.
void check_picture_file(const std::string& file);

/// Throws Error{kUsage} where `out` is one of the inputs, a folder that holds one, or in a folder that is one: it would be replaced by what is made of it.
/// An `out` that is not there is none of them.
void check_replaces_no_input(const std::string& out, std::span<const std::string> inputs);

/// For a command that writes several files to a folder: throws Error{kIo} where the folder is a run's, or has results of such a command already and `replace`
/// is false.
/// @param document  the file that each result of the command has, by which it is known
void check_output_folder(const std::filesystem::path& folder, const char* document, bool replace);

/// Throws Error{kIo} where a file is there already and may not be replaced.
void check_new_file(const std::filesystem::path& file, bool replace);

/// The folder of --out; where it is not given out/NAME.
std::filesystem::path output_folder(const std::string& out, const std::string& name);

}  // namespace hallway::cli
