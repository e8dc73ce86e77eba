// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace hallway::loaders {

/// True for the bytes of a binary glTF file.
bool is_glb(std::string_view bytes);

/// Checks what the glTF parser relies on: lengths of a GLB header and its chunks within the file, and JSON that is nested no
/// deeper than a recursive parser stands. Throws Error{kBadInput} with the cause.
void check_gltf_container(std::string_view bytes);

}  // namespace hallway::loaders
