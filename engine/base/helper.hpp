// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace hallway {

/// The first argument by which Child tells a helper its limits and who started it.
std::string helper_word(std::uint64_t memory_bytes, std::uint64_t cpu_seconds);

/// What the main() of a helper program calls first. Sets limits of its own (posix_spawn cannot): address space, processor
/// time, no core files, no files written; and arranges to be killed when the thread that started it ends. Under a sanitizer
/// that reserves address space the limit on it is left out.
///
/// @param argument  the program's first argument, made by helper_word()
/// @return false if the argument is none of these, or the starter is already gone; the program then ends
bool begin_helper(std::string_view argument);

/// Arranges to be killed when the thread that started this process ends. @return false if `parent`, which did, is already gone
bool end_with_parent(std::int64_t parent);

/// Whether this program was built with a sanitizer that reserves most of the address space.
bool reserves_addresses();

/// Reads standard input to its end, at most `max_bytes`. Throws Error{kIo}.
std::string read_standard_input(std::uint64_t max_bytes);
/// Writes all of it to standard output. Throws Error{kIo}.
void write_standard_output(std::string_view bytes);

}  // namespace hallway
