// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "map/document.hpp"

namespace hallway::map {

/// The canonical text of a document: one line per key, face and comment, keys before brushes, numbers as the shortest
/// decimals that read back as the same value. Faces are written in the Valve 220 format, and a brush whose faces all have a
/// texture matrix as a brush primitive. For every document d that parse() can give, parse(print(d)) equals d but for
/// line numbers; print(parse(print(d))) is print(d) byte for byte.
///
/// Throws Error{kBadInput} for a document that the format cannot hold: a line break or NUL in a text, a
/// key that ends in a backslash, a number that is not finite, text over the limits of parse().
std::string print(const Document& document);

}  // namespace hallway::map
