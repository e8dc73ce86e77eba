// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "map/document.hpp"
#include "mesh/model.hpp"
#include "world/compiled_world.hpp"

namespace hallway::run {

/// The ending of a model file that is written, in lower case: ".glb", ".obj" or ".ply"; none for another one.
std::optional<std::string> model_ending(const std::string& file);

/// The surface of a world as triangles, a material for each of the map's.
/// @param all  of a sealed world also the faces that nothing inside can see
mesh::Model surface_model(const world::CompiledWorld& world, bool all);

/// Adds the models that stand in a map.
/// @param folder  the map's
/// @param faults  gets why models that are left out could not be read
void add_models(mesh::Model& model, const map::Document& document, const std::filesystem::path& folder,
                std::vector<Error>& faults);

/// Throws Error{kUsage} where the file is a model of the map: it would be replaced by the map.
void check_replaces_no_model(const std::string& file, const map::Document& document,
                             const std::filesystem::path& folder);

/// Writes a model in the format that the ending says; of an OBJ also its material library and images, beside it. Returns the files, the
/// one that was asked for first. Throws Error{kIo} where one cannot be written, Error{kInternal} for another ending.
std::vector<std::string> write_model(const std::string& file, const mesh::Model& model);

}  // namespace hallway::run
