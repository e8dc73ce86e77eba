// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "map/document.hpp"

namespace hallway::map {

/// The first face of a material that the map's table does not describe.
struct UndescribedFace {
  std::string material{};  ///< as the face names it
  int line = 0;
};

/// Of a map with a table of materials (`_materials` of its worldspawn): of each material of solid faces that can be seen and that the table has no entry for, the first face; at most
/// 20. Empty for a map without a table. Throws what materials_of() throws.
std::vector<UndescribedFace> undescribed_faces(const Document& document);

}  // namespace hallway::map
