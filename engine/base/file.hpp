// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace hallway {

/// Largest file that read_file() accepts unless told otherwise, in bytes.
inline constexpr std::uint64_t kMaxFileBytes = 2ull << 30;

/// Reads a whole regular file. Folders, pipes, devices and files larger than `max_bytes` are refused before anything
/// is read. Throws Error{kIo} naming the path and the cause.
std::string read_file(const std::filesystem::path& path, std::uint64_t max_bytes = kMaxFileBytes);

/// Writes a file so that at every moment either the old content or the new one stands there: written beside, synced,
/// renamed, folder synced. A folder, pipe or device under that name is refused. Throws Error{kIo} naming the path and the
/// cause; the old content then stays.
void write_file_atomically(const std::filesystem::path& path, std::string_view content);

/// Of a name in a folder: the name of the file that it was to become, if write_file_atomically() writes under that name, or was killed while it did; else
/// empty.
std::string_view unfinished_file_of(std::string_view name);

/// Makes a folder and its parents where missing. Throws Error{kIo} if that cannot be done or `path` is a file.
void make_folder(const std::filesystem::path& path);

}  // namespace hallway
