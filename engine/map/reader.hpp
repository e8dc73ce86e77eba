// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "map/document.hpp"

namespace hallway::map {

inline constexpr std::size_t kMaxMapBytes = std::size_t{512} << 20;  ///< largest map file that load() reads
inline constexpr std::size_t kMaxKeyBytes = 1024;                    ///< longest key or material name
inline constexpr std::size_t kMaxValueBytes = std::size_t{1} << 20;  ///< longest value or comment

/// Reads the text of a `.map` file (grammar: docs/formats.md). O(size of the text); not recursive.
///
/// Faces in the Standard format, which may stand beside Valve 220 ones, get the texture axes that the format implies
/// (texture_axes.hpp), so that the document holds Valve data throughout. Of brush primitives (`brushDef`) the texture's matrix is
/// kept and not interpreted. Patches and `brushDef3` are kept as text (Brush::unread).
///
/// A UTF-8 byte order mark and CRLF line ends are accepted. Comments are kept with the entity, key, brush or face that
/// follows them, except for the running numbers that editors write (`// entity 3`, `// brush 7`).
///
/// @param file  name of the file for messages
/// Throws Error{kBadInput} with file, line and cause for anything else than the format: cut files, numbers that are not
/// finite decimals, other encodings, texts over the limits above.
Document parse(std::string_view text, const std::string& file);

/// Reads a file and parses it. Throws also Error{kIo} if the file cannot be read.
Document load(const std::filesystem::path& path);

}  // namespace hallway::map
