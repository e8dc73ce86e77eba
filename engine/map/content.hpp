// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "map/document.hpp"

namespace hallway::map {

/// What a brush does to the world.
enum class BrushRole {
  kAdd,       ///< solid; seals the map and bounds what can be seen
  kDetail,    ///< solid; neither seals the map nor bounds what the visible sets say
  kSubtract,  ///< takes away what stands before it
  kHint,      ///< not solid: its planes are where a compiler may split
};

/// Whether brushes of that role add matter to the world.
constexpr bool is_material(BrushRole role) {
  return role == BrushRole::kAdd || role == BrushRole::kDetail;
}

/// Why brushes of a map have no part in its world.
enum class LeftOut {
  kLiquid,    ///< water, lava, slime, a teleporter's surface
  kClip,      ///< stops players or monsters only
  kTrigger,   ///< marks a region
  kOrigin,    ///< marks the point about which an entity turns
  kPortal,    ///< a door of visibility for a game
  kPassable,  ///< an entity that is drawn but stops nothing
  kMoving,    ///< an entity that moves, breaks or comes and goes
  kOmitted,   ///< an entity with the key `_omitbrushes`
  kOther,     ///< an entity of a class that is not in the table
};

/// "liquid", "clip", …: a short stable name.
std::string_view to_string(LeftOut reason);

/// A line of the table of materials. Names are compared without their folders and without regard to case.
struct MaterialRule {
  std::string_view name{};            ///< of a material; of a folder where it ends in a slash
  bool prefix = false;                ///< the material's name need only begin so
  bool hint = false;                  ///< one such face makes the brush a hint
  std::optional<LeftOut> left_out{};  ///< one such face makes the brush be left out
  bool drawn = true;                  ///< whether pictures show such a face
};

/// A line of the table of classes of entities that have brushes. Names are compared without regard to case, but for those
/// that begin with `hw_`.
struct ClassRule {
  std::string_view name{};
  bool prefix = false;
  std::optional<BrushRole> role{};    ///< of the entity's brushes
  bool ordered = false;               ///< they apply after all others, by the entity's key `order`
  std::optional<LeftOut> left_out{};  ///< where they have no role
};

/// The whole tables, as docs/formats.md has them; the first line that fits counts. A brush of several materials is what
/// the first line says that fits any of them.
std::span<const MaterialRule> material_rules();
std::span<const ClassRule> class_rules();

/// What a brush is by its entity and materials: a role, or why it has none.
struct BrushContent {
  std::optional<BrushRole> role{};
  bool ordered = false;                ///< see ClassRule
  LeftOut left_out = LeftOut::kOther;  ///< where there is no role
};

/// The role of one of an entity's brushes. The materials of a kSubtract brush do not matter, but for hints.
BrushContent brush_content(const Entity& entity, const Brush& brush);

/// Whether a face of this material is a sky: it closes the world, and nothing is to be seen on it.
bool is_sky(std::string_view material);

/// Whether pictures show faces of this material.
bool is_drawn(std::string_view material);

}  // namespace hallway::map
