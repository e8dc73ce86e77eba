// SPDX-License-Identifier: MIT
#include "map/material_check.hpp"

#include <cstddef>
#include <filesystem>
#include <set>
#include <string_view>

#include "map/content.hpp"
#include "map/materials.hpp"

namespace hallway::map {

std::vector<UndescribedFace> undescribed_faces(const Document& document) {
  constexpr std::size_t kMost = 20;
  std::vector<UndescribedFace> found;
  const Entity* world = document.worldspawn();
  if (!world || !world->find("_materials")) return found;
  std::vector<Setting> unused;
  const MaterialTable table =
      materials_of(document, std::filesystem::path(document.file).parent_path(), unused);
  std::set<std::string_view> seen;
  for (const Entity& entity : document.entities) {
    for (const Brush& brush : entity.brushes) {
      if (!brush_content(entity, brush).role) continue;
      for (const Face& face : brush.faces) {
        if (!is_drawn(face.material) || !seen.insert(face.material).second) continue;
        if (table.describes(face.material)) continue;
        found.push_back({face.material, face.line});
        if (found.size() == kMost) return found;
      }
    }
  }
  return found;
}

}  // namespace hallway::map
