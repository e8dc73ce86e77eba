// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "editor/command.hpp"
#include "editor/selection.hpp"
#include "editor/state.hpp"

namespace hallway::editor {

/// A map of space that keeps straight lines straight: x becomes linear * x + shift, map units.
struct Transform {
  enum class Kind {
    kMove,
    kTurn,    ///< about a parallel of an axis
    kScale,   ///< along the axes
    kMirror,  ///< at a plane across an axis
    kUnits,   ///< as kScale, but lengths in metres stay what they are: the map's unit changes
  };
  Kind kind = Kind::kMove;
  Eigen::Matrix3d linear = Eigen::Matrix3d::Identity();
  Vec3 shift = Vec3::Zero();
  int axis = 2;           ///< of kTurn, kMirror
  double turn_deg = 0.0;  ///< of kTurn, 0 to below 360
  Vec3 factors = Vec3::Ones();

  /// Where a point goes. What differs from a decimal of seven places by rounding alone becomes that decimal.
  Vec3 operator()(const Vec3& point) const;
};

Transform move_by(const Vec3& way);
/// Turns counter-clockwise as seen from the axis' far end; quarter turns are exact.
Transform turn_about(const Vec3& centre, int axis, double angle_deg);
Transform scale_about(const Vec3& centre, const Vec3& factors);
Transform mirror_at(int axis, double place);
/// Of a map whose unit is `from` metres into one whose unit is `to`.
Transform change_units(double from, double to);

/// The brush, moved with its textures: they stay where they are on its faces. Fixed texture matrices of brush primitives stay.
/// Throws Error{kUsage} for shapes that are kept as text, and for what would lie beyond the largest coordinate.
map::Brush transformed(const map::Brush& brush, const Transform& transform);

/// The keys of an entity that say where it stands, how it is turned and how large it is. What cannot be said in its keys is
/// added to `notes`. Throws Error{kUsage} for an origin that is not three numbers.
map::Entity transformed(const map::Entity& head, const Transform& transform, std::set<std::string>& notes);

/// Changes brushes of things, those of entities included: what `change` gives replaces the brush. Entities whose brushes all stay are
/// not touched. O(brushes of the entities).
void change_brushes(State& state, const std::vector<Thing>& things,
                    const std::function<std::optional<map::Brush>(const EntityItem& entity,
                                                                  const map::Brush& brush)>& change);

/// Transforms things, their members with them. A group's line of making follows where it then still makes what is there, else it
/// goes. What there is to know besides is added to the report.
void transform_things(Edit& edit, const std::vector<Thing>& things, const Transform& transform);

/// A way in metres as map units, no grid applied, to a tenth of a micrometre.
Vec3 way_units(const Edit& edit, const Vec3& way_m);

}  // namespace hallway::editor
