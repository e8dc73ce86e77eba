// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "map/document.hpp"

namespace hallway::editor {

/// The text of one brush in the map format, from its comments to its closing brace.
std::string text_of(const map::Brush& brush);

/// The text of an entity in the map format.
std::string text_of(const map::Entity& entity);

/// The brush of such a text, the entity of such a text. Throws Error{kBadInput} for a text that is not exactly one of them.
map::Brush brush_of(const std::string& text);
map::Entity head_of(const std::string& text);

}  // namespace hallway::editor
