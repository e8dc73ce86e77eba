// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "editor/state.hpp"

namespace hallway::editor {

/// What a user's words for things mean. Terms are joined by `+`:
///
///     12, #12        the thing of that number          12..15           those numbers
///     north          the thing of that name            wall*            names that fit (`*` any text, `?` one character)
///     class=hw_*     entities of a class               material=brick*  brushes with a face of it
///     group=NAME     what is in a group                box=X,Y,Z,X,Y,Z  what lies in a box (metres)
///     all            every entity but worldspawn, and worldspawn's brushes
///     selected       what `select` chose
///
/// A name is a group's, or the value of an entity's `name` or `targetname`. Entities stand for all their brushes. Sorted, none twice;
/// a brush whose entity is there too is left out. O(things).
///
/// Throws Error{kUsage} for a term that means nothing: an unknown name (with the nearest known one), a number that no thing has, and
/// where all together mean nothing.
std::vector<Thing> resolve(const State& state, std::string_view what);

/// Everything of a map that can be copied: all entities but worldspawn, and worldspawn's brushes.
std::vector<Thing> all_things(const State& state);

/// The things of those numbers, as far as they are there. O(things).
std::vector<Thing> things_of(const State& state, const std::vector<Id>& ids);

/// The one thing that is meant; Error{kUsage} if there are several.
Thing resolve_one(const State& state, std::string_view what);

/// The keys that name an entity, the first that is there before the others.
inline constexpr std::array kNameKeys{"_tb_name", "name", "targetname"};

/// The name of an entity, or the empty text.
std::string name_of(const EntityItem& entity);

/// "#12 wall north", "#13 brush of #12", the way messages name a thing.
std::string describe(const State& state, const Thing& thing);

/// Things with all that moves with them: of a group its members, of members that are groups theirs; of an `hw_path` its waypoints.
/// O(entities x depth of groups).
std::vector<Thing> with_members(const State& state, const std::vector<Thing>& things);

/// Whether an entity is a group as TrenchBroom and Hallway write it (`func_group` with `_tb_type` `_tb_group`), and its number there.
std::optional<std::string> group_number(const EntityItem& entity);

/// The state without what is hidden, as pictures and plans show it; worldspawn stays.
State without_hidden(const State& state);

/// The group of that number, by index in State::entities.
std::optional<std::size_t> find_group(const State& state, std::string_view number);

/// The groups that a thing is in, the innermost first; a group counts as in itself. Indices in State::entities.
std::vector<std::size_t> groups_of(const State& state, const Thing& thing);

/// The brushes of a thing: those of an entity, or the one that it is.
std::vector<const map::Brush*> brushes_of(const State& state, const Thing& thing);

/// The volume of a brush, cubic map units; 0 for one that is no body.
double volume_of(const map::Brush& brush);

/// What a brush occupies, map units; empty for one that is no body. O(1) for upright boxes, else O(faces squared).
Box bounds_of(const map::Brush& brush);

/// What a thing occupies, map units: an entity's brushes, else its origin.
Box bounds_of(const State& state, const Thing& thing);

/// What things occupy together with all that belongs to them (see with_members()), map units.
Box bounds_together(const State& state, const std::vector<Thing>& things);

/// The waypoints of a path in their order: their number, none where `index` is no whole number, and the entity.
std::vector<std::pair<std::optional<std::int64_t>, std::size_t>> waypoints_of(const State& state,
                                                                              std::string_view path);

/// Three numbers with blanks between them, as keys have places and angles.
std::optional<Vec3> three_numbers(std::string_view text);

/// The value of `origin`, map units, if there is one that is three numbers.
std::optional<Vec3> origin_of(const EntityItem& entity);

/// Whether a text fits a pattern of `*` (any text) and `?` (one byte). O(text x pattern).
bool fits(std::string_view text, std::string_view pattern);

}  // namespace hallway::editor
