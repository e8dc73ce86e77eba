// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "planes/cloud.hpp"
#include "planes/scene.hpp"

namespace hallway::planes {

/// A scene of a folder.
struct SceneFile {
  std::string name{};              ///< "scene_07"
  std::filesystem::path points{};  ///< scene_07.csv: x,y,z,label
  std::filesystem::path planes{};  ///< scene_07_planes.csv; empty where it is not there
};

/// The files `NAME.csv` of a folder, by name, with `NAME_planes.csv` where it is there. Throws Error{kIo, kBadInput}, also for a
/// folder that has none.
std::vector<SceneFile> list_scenes(const std::filesystem::path& folder);

/// Points, and what is true of them.
struct LabelledCloud {
  Cloud cloud{};
  Truth truth{};
};

/// Reads a scene. Without a file of its planes they are those of the labels (truth_of_labels()). Throws Error{kIo, kBadInput} with file and line.
LabelledCloud read_scene(const SceneFile& file);

/// A generated scene as one that was read.
LabelledCloud as_read(const Scene& scene);

/// The text of a scene's points, `x,y,z,label`, and of its planes, `label,cx,cy,cz,nx,ny,nz,ux,uy,uz,half_u,half_v,points,sigma`.
std::string print_scene_points(const Scene& scene);
std::string print_scene_planes(const Scene& scene);

}  // namespace hallway::planes
