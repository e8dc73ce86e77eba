// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace hallway::conformance {

/// The open descriptors of this process and what they lead to, sorted.
std::vector<std::string> open_descriptors();
/// Number of threads of this process.
std::size_t count_threads();
/// Number of threads, once it is at most `wanted` or after a second: threads that were told to end take a while.
std::size_t count_threads_down_to(std::size_t wanted);
/// Whether this process has a child, or a zombie of one. Children whose parent has ended count where this process takes them in.
bool has_children();
/// Ends all of them.
void end_children();

/// Bytes that malloc() has given out.
std::size_t heap_bytes();
/// Bytes of memory that stand behind the addresses of this process.
std::size_t resident_bytes();

/// What is done on each signal, and which are blocked, as text.
std::string signal_settings();
/// Rounding, exceptions that are signals, and whether the smallest numbers count as zero, as text.
std::string float_settings();
/// The environment, sorted.
std::vector<std::string> environment_now();
/// umask().
unsigned file_mask();

/// Makes the decimal point of this process a comma, as many languages have it (de_DE), by a locale that is written into `folder`: which locales
/// a machine has cannot be relied on. @return false where that cannot be done
bool set_comma_locale(const std::filesystem::path& folder);

}  // namespace hallway::conformance
