// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "loaders/file_access.hpp"
#include "loaders/gltf_document.hpp"

namespace hallway::loaders::gltf {

/// Parses a `.gltf` or `.glb` file by tinygltf. Files that it names are read through `access`; one that leads outside, or a
/// buffer that is missing, is refused. Throws Error{kBadInput} or Error{kIo}, and whatever tinygltf throws.
Document parse(const std::string& bytes, FileAccess& access);

}  // namespace hallway::loaders::gltf
