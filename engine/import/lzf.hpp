// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace hallway::import {

/// Most bytes that one byte of LZF data can stand for: three bytes repeat up to 264.
inline constexpr std::uint64_t kMaxLzfRatio = 88;

/// Undoes the LZF compression of Marc Lehmann's liblzf: literal runs of 1 to 32 bytes, and repetitions of 3 to 264 bytes from at most 8192
/// bytes back. Throws Error{kBadInput} unless the data gives exactly `size` bytes; before anything is allocated where it cannot.
std::string decompress_lzf(std::string_view data, std::uint64_t size);

}  // namespace hallway::import
