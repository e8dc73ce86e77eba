// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "base/error.hpp"
#include "map/document.hpp"

namespace hallway::map {

enum class Severity { kError, kWarning };

/// Something that is wrong with a map, or likely to be.
struct Finding {
  Severity severity = Severity::kError;
  Where where{};
  std::string message{};  ///< the cause, safe to print
  std::string id{};       ///< short stable name, such as "two-robot-starts" (list: docs/formats.md)
};

/// Names of all findings that check() can have, sorted.
const std::vector<std::string>& finding_ids();

/// More paths than this are not tried.
inline constexpr std::size_t kMostPathsChecked = 100;

/// All that can be said of a document without compiling it: brushes that are no bodies, keys that are unknown, missing,
/// doubled or of the wrong kind, references that lead nowhere, paths that cannot be made. Never throws for what a document
/// holds. Ordered by line, then by id, message and element.
///
/// An entity whose own keys are at fault is not reported again for what follows from that. O(entities log entities) besides
/// the brushes (see build_world()) and paths.
std::vector<Finding> check(const Document& document);

}  // namespace hallway::map
