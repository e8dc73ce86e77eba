// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "editor/command.hpp"
#include "editor/selection.hpp"

namespace hallway::editor {

/// Three numbers as maps write them: "1 2.5 3".
std::string vector_text(const Vec3& vector);
/// The axis that a choice "x y z" means.
int axis_of(std::string_view choice);
/// An angle in degrees, without what rounding left below 1e-9.
double degrees(double angle_rad);

// What commands say of the things that they touched: a line and the numbers under "made", "changed" or "removed" in the data.
void say_made(Edit& edit, const std::vector<Id>& ids);
void say_changed(Edit& edit, const std::vector<Thing>& things);
void say_removed(Edit& edit, const std::vector<Thing>& things);

/// The index of worldspawn. Throws Error{kUsage} in a map without one.
std::size_t worldspawn(const State& state);

/// What a shape is made of.
struct Parts {
  std::vector<map::Brush> added{};       ///< solid
  std::vector<map::Brush> subtracted{};  ///< cut out of whatever is there before them
  int order = 1;                         ///< when `subtracted` apply: the key `order` of `hw_subtract`
  /// When `added` apply: 0 with all other brushes, before anything is cut out; else the key `order` of an `hw_add`.
  int added_order = 0;
  bool remembered =
      false;  ///< a group even where it is one brush without a name: others depend on what made it
};

/// A new group as TrenchBroom writes it, with the next free number. @param name  may be empty
map::Entity new_group(const State& state, const std::string& name);

/// Adds a shape: a brush alone without a name goes into worldspawn; all else becomes a group, which remembers under the key `_hw_made` the line that
/// made it. Returns the number of the brush or group. @param name  may be empty
Id add_shape(Edit& edit, const std::string& name, const std::string& made, Parts parts);

/// Gives a group other parts; it keeps its number, keys and all members that are no parts of its shape.
void replace_shape(Edit& edit, Id group, Parts parts);

/// The order in which bodies must be added so that nothing that is cut out already takes them away: 0 where they stand in no
/// `hw_subtract`, else one more than the highest `order` of those. Rooms, doors and windows alike count, but not what belongs to the
/// group of the number `but_of`. O(brushes of hw_subtract).
int order_among_cuts(const State& state, const std::vector<map::Brush>& brushes,
                     const std::string& but_of = {});

/// The key `order` of an entity, 0 where it has none.
int order_of(const EntityItem& entity);

/// What brushes occupy together, map units.
Box bounds_of(const std::vector<map::Brush>& brushes);

/// False where a brush has certainly nothing in common with a box; much faster than overlap(). O(faces).
bool may_overlap(const Box& box, const map::Brush& brush);

/// Whether two brushes have a volume in common.
bool overlap(const map::Brush& a, const map::Brush& b);
/// Whether one of the brushes, which occupy `box` together, has a volume in common with another brush.
bool any_overlaps(const std::vector<map::Brush>& brushes, const Box& box, const map::Brush& other);
/// The first of `count` things by name, and how many more there are: "a, b and 3 more".
std::string listed(const std::vector<std::string>& names, std::size_t count);
/// Whether all of a brush lies in another one, or on its faces.
bool lies_within(const map::Brush& brush, const map::Brush& other);

/// Whether an entity is the cut of a door or window.
bool is_opening(const EntityItem& entity);

/// Whether an entity is the pane or leaf that a door or window was made with.
bool is_fill(const EntityItem& entity);
/// The panes or leaves of a door or window, and the door or window that one of those is in, by index in State::entities. They overlap, and
/// belong to the same group or to none.
std::vector<Thing> fills_of(const State& state, std::size_t opening);
std::optional<std::size_t> opening_of(const State& state, std::size_t fill);
/// Adds to things the panes and leaves of the doors and windows among them. The things are then sorted, none twice.
void add_fills(const State& state, std::vector<Thing>& things);

/// The number of the group that an entity is, or belongs to; or the empty text.
std::string group_of(const EntityItem& entity);

/// The entities that carry the number of a group.
std::vector<Thing> members_of(const State& state, const std::string& number);

/// Gives an entity other brushes; as many as it had keep their numbers. O(brushes).
void set_brushes(State& state, std::size_t entity, std::vector<map::Brush> brushes);

/// The next free number for a TrenchBroom group.
int next_group_number(const State& state);

/// Refuses a name that something has already.
void check_new_name(const State& state, const std::string& name);

}  // namespace hallway::editor
