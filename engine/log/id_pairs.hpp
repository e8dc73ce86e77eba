// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hallway::log {

/// The two columns of a table of ids, e.g. `submap_id,landmark_id`.
struct IdColumns {
  std::string_view first;
  std::string_view second;
};

/// Which landmarks belong to which submaps (`submaps.csv`).
inline constexpr IdColumns kSubmapColumns{"submap_id", "landmark_id"};
/// Which true landmark a landmark of the map was made from (`matches.csv`).
inline constexpr IdColumns kMatchColumns{"landmark_id", "true_landmark_id"};

struct IdPair {
  std::uint64_t first = 0;
  std::uint64_t second = 0;
};

/// Reads a CSV table of two id columns. Throws Error{kBadInput} with the line of the first thing that is wrong. O(length).
std::vector<IdPair> parse_id_pairs(std::string_view text, const std::string& file, const IdColumns& columns);

/// parse_id_pairs() of a file. Throws Error{kIo} if it cannot be read.
std::vector<IdPair> read_id_pairs(const std::filesystem::path& path, const IdColumns& columns);

/// The text that parse_id_pairs() reads back to the same values.
std::string print_id_pairs(std::span<const IdPair> pairs, const IdColumns& columns);

/// print_id_pairs() to a file, atomically. Throws Error{kIo}.
void write_id_pairs(const std::filesystem::path& path, std::span<const IdPair> pairs,
                    const IdColumns& columns);

}  // namespace hallway::log
