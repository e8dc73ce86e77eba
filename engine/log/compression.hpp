// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace hallway::log {

/// CRC-32 (IEEE 802.3, as in zip and PNG) of `bytes`, going on from the CRC of what came before.
std::uint32_t crc32(std::string_view bytes, std::uint32_t before = 0);

/// `bytes` as one Zstandard frame. Fast rather than small: readings with noise hardly become smaller anyway.
std::string compress_zstd(std::string_view bytes);

/// The content of Zstandard frames, which must be `size` bytes long. Memory grows with what is really there, not with
/// `size`. Throws Error{kBadInput}.
std::string decompress_zstd(std::string_view bytes, std::uint64_t size);

}  // namespace hallway::log
