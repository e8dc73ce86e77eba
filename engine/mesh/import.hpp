// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "map/document.hpp"
#include "mesh/model.hpp"

namespace hallway::mesh {

struct ImportOptions {
  std::string model{};            ///< path of the model relative to the map's folder, for key `model`
  std::optional<double> units{};  ///< metres in a unit of the file, instead of what the file says
  double margin_m = 2.0;          ///< between the model and the walls and ceiling around it; at least 1
};

/// A map around a model: a closed hull of six blocks outside its bounds, the model as an `hw_mesh` at the origin, and a robot
/// start in the free strip on its low x side, looking along x at the middle of the model. One map unit is a centimetre.
/// Throws Error{kBadInput} if the hull would reach beyond what a map may hold.
map::Document import_document(const Model& model, const ImportOptions& options);

/// The path that an `hw_mesh` of a map in `map_folder` uses for a model. Throws Error{kBadInput}, with advice, if the model
/// lies outside that folder after links are resolved.
std::string path_in_map_folder(const std::filesystem::path& model, const std::filesystem::path& map_folder);

/// Copies the files that were read for a model (Model::files, relative to `root`) to the same relative paths in
/// `map_folder`. Files that stand there already with the same content are left alone.
/// Throws Error{kIo} without copying anything if a file of another content is there and `replace` is false.
void copy_model_files(const std::vector<std::string>& files, const std::filesystem::path& root,
                      const std::filesystem::path& map_folder, bool replace);

}  // namespace hallway::mesh
