// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "base/error.hpp"
#include "editing.hpp"
#include "editor/shapes.hpp"
#include "editor/state.hpp"
#include "map/world.hpp"

/// Geometric questions about a map under edit; metres.
namespace hallway::test {

/// Whether a point is solid: the last body that contains it adds.
inline bool is_solid(const map::World& world, const Vec3& point) {
  bool solid = false;
  for (const map::Solid& each : world.solids) {
    if (each.contains(point)) solid = each.role != map::BrushRole::kSubtract;
  }
  return solid;
}

inline map::World world_of(const Editing& editing) {
  return map::build_world(editor::document_of(editing.session->state(), "map.map"));
}

inline bool is_solid(const Editing& editing, const Vec3& point) {
  return is_solid(world_of(editing), point);
}

/// Sum of the volumes of all brushes of entities of a class.
inline double volume(const Editing& editing, std::string_view classname = {}) {
  const double scale = editor::units_of(editing.session->state()).metres_per_unit;
  double sum = 0.0;
  for (const auto& entity : editing.session->state().entities) {
    if (!classname.empty() && entity->classname() != classname) continue;
    for (const editor::BrushItem& brush : entity->brushes) {
      const auto body = editor::body_of(*brush.brush);
      EXPECT_TRUE(body.has_value()) << "#" << brush.id << " is no body";
      if (body) sum += editor::volume_of(*body) * scale * scale * scale;
    }
  }
  return sum;
}

inline std::size_t brush_count(const Editing& editing) {
  std::size_t count = 0;
  for (const auto& entity : editing.session->state().entities) count += entity->brushes.size();
  return count;
}

/// The most that two brushes of a map have in common, metres cubed.
inline double largest_overlap(const Editing& editing) {
  const double scale = editor::units_of(editing.session->state()).metres_per_unit;
  std::vector<const map::Brush*> brushes;
  for (const auto& entity : editing.session->state().entities) {
    for (const editor::BrushItem& brush : entity->brushes) brushes.push_back(brush.brush.get());
  }
  double most = 0.0;
  for (std::size_t i = 0; i < brushes.size(); ++i) {
    for (std::size_t j = i + 1; j < brushes.size(); ++j) {
      const auto common = editor::intersection(*brushes[i], *brushes[j]);
      const auto body = common ? editor::body_of(*common) : std::nullopt;
      if (body) most = std::max(most, editor::volume_of(*body) * scale * scale * scale);
    }
  }
  return most;
}

/// What the refusal of a line says; empty where it is not refused.
inline std::string refusal(Editing& editing, const std::string& line) {
  const std::string before = editing.text();
  try {
    editing.run(line);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kUsage) << line << ": " << error.what();
    EXPECT_EQ(editing.text(), before) << line;
    return error.what();
  }
  return {};
}

/// Whether a text has another one in it.
inline bool mentions(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// The entity that a name means.
inline const editor::EntityItem& named(const Editing& editing, const std::string& name) {
  const auto thing = editor::resolve_one(editing.session->state(), name);
  return *editing.session->state().entities[thing.entity];
}

}  // namespace hallway::test
