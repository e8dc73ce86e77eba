// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "base/child.hpp"
#include "mesh/model.hpp"

namespace hallway::mesh {

struct LoadLimits {
  ModelLimits model{};
  ChildLimits child{};
};

/// Reads a model file: glTF 2.0 (`.gltf`, `.glb`) by tinygltf, everything else that assimp knows (OBJ, STL, PLY, FBX,
/// COLLADA, …) by assimp, in a helper program, so that whatever these do to themselves is an Error here.
///
/// Axes and units: glTF is y-up metres; COLLADA and FBX say what they are; OBJ, STL, PLY and OFF are taken as they stand
/// (z up, metres); other formats as y-up metres, which assimp makes of them.
///
/// Only regular files inside `root_folder` are opened, after links and `..` are resolved, the model itself included; URIs
/// with a scheme and absolute paths are refused. A glTF file that names anything else, or an image over the limits, is an
/// Error. What a file of another format names outside the folder, and images that are missing or broken, are left out with
/// a warning in the model.
///
/// The same files give the same bytes. Safe to call from several threads. Throws Error{kBadInput} or Error{kIo} naming
/// the file.
Model load_model(const std::filesystem::path& file, const std::filesystem::path& root_folder,
                 const LoadLimits& limits = {});

/// The same by a given helper program instead of the one that find_helper() finds.
Model load_model_by(const std::filesystem::path& program, const std::filesystem::path& file,
                    const std::filesystem::path& root_folder, const LoadLimits& limits = {});

}  // namespace hallway::mesh
