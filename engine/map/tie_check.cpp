// SPDX-License-Identifier: MIT
#include "map/tie_check.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>
#include <utility>

#include "map/entity_keys.hpp"

namespace hallway::map {
namespace {

/// By boxes, swept along x; gives up after so many pairs that the rest would take seconds.
std::optional<std::pair<const Solid*, const Solid*>> find_tie(std::vector<const Solid*>& solids) {
  constexpr std::size_t kMostPairs = 100'000'000;
  std::stable_sort(solids.begin(), solids.end(),
                   [](const Solid* a, const Solid* b) { return a->box.min().x() < b->box.min().x(); });
  std::size_t pairs = 0;
  for (std::size_t i = 0; i < solids.size(); ++i) {
    for (std::size_t j = i + 1; j < solids.size() && ++pairs < kMostPairs; ++j) {
      const Solid &a = *solids[i], &b = *solids[j];
      if (b.box.min().x() >= a.box.max().x()) break;
      if (a.role == b.role) continue;
      const Box common = a.box.intersection(b.box);
      if ((common.sizes().array() > 0.0).all())
        return a.entity < b.entity ? std::pair{&a, &b} : std::pair{&b, &a};
    }
  }
  return std::nullopt;
}

}  // namespace

std::vector<Tie> tied_brushes(const Document& document, const World& world) {
  std::map<std::int64_t, std::vector<const Solid*>> by_order;
  for (const Solid& solid : world.solids) {
    const Entity& entity = document.entities[static_cast<std::size_t>(solid.entity)];
    if (entity.classname() != "hw_add" && entity.classname() != "hw_subtract") continue;
    if (solid.role == BrushRole::kHint) continue;
    const EntityKeys keys(document, entity);
    by_order[keys.has("order") ? keys.integer("order") : 0].push_back(&solid);
  }
  std::vector<Tie> ties;
  for (auto& [order, solids] : by_order) {
    if (const auto tie = find_tie(solids)) ties.push_back({order, tie->first, tie->second});
  }
  return ties;
}

}  // namespace hallway::map
