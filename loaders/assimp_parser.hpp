// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "loaders/file_access.hpp"
#include "loaders/scene.hpp"

namespace hallway::loaders {

/// Parses a model of any format that assimp knows. Files that it names are read through `access`. Textures that are missing,
/// broken or refused become warnings. Throws Error{kBadInput} or Error{kIo}, and whatever assimp throws.
Scene parse_by_assimp(FileAccess& access, const mesh::ModelLimits& limits);

}  // namespace hallway::loaders
