// SPDX-License-Identifier: MIT
#include "editor/state.hpp"

#include <deque>
#include <string>
#include <unordered_map>
#include <utility>

#include "editor/item_text.hpp"

namespace hallway::editor {
namespace {

/// Indices by text; of equal texts the first comes first.
using ByText = std::unordered_map<std::string, std::deque<std::size_t>>;  // only asked

std::optional<std::size_t> take(ByText& texts, const std::string& text) {
  const auto found = texts.find(text);
  if (found == texts.end() || found->second.empty()) return std::nullopt;
  const std::size_t index = found->second.front();
  found->second.pop_front();
  return index;
}

void match_brushes(const EntityItem* before, const std::vector<map::Brush>& brushes, EntityItem& item,
                   Id& next_id) {
  ByText old;
  if (before != nullptr) {
    for (std::size_t b = 0; b < before->brushes.size(); ++b)
      old[text_of(*before->brushes[b].brush)].push_back(b);
  }
  for (const map::Brush& brush : brushes) {
    if (const auto known = take(old, text_of(brush))) {
      item.brushes.push_back(before->brushes[*known]);
    } else {
      item.brushes.push_back({next_id++, std::make_shared<const map::Brush>(brush)});
    }
  }
}

}  // namespace

State matched(const State& before, const map::Document& document) {
  State state;
  state.next_id = before.next_id;
  state.closing_comments = document.closing_comments;
  state.desk = before.desk;
  ByText heads;
  for (std::size_t e = 0; e < before.entities.size(); ++e)
    heads[text_of(*before.entities[e]->head)].push_back(e);
  std::vector<std::optional<std::size_t>> origin;
  std::vector<bool> taken(before.entities.size(), false);
  for (const map::Entity& entity : document.entities) {
    origin.push_back(take(heads, text_of(without_brushes(entity))));
    if (origin.back()) taken[*origin.back()] = true;
  }
  for (std::size_t e = 0; e < origin.size() && e < before.entities.size(); ++e) {
    if (origin[e] || taken[e] || before.entities[e]->classname() != document.entities[e].classname())
      continue;
    origin[e] = e;
    taken[e] = true;
  }
  for (std::size_t e = 0; e < document.entities.size(); ++e) {
    const map::Entity& entity = document.entities[e];
    const EntityItem* old = origin[e] ? before.entities[*origin[e]].get() : nullptr;
    auto item = std::make_shared<EntityItem>();
    item->id = old != nullptr ? old->id : state.next_id++;
    map::Entity head = without_brushes(entity);
    const bool same = old != nullptr && text_of(*old->head) == text_of(head);
    item->head = same ? old->head : std::make_shared<const map::Entity>(std::move(head));
    match_brushes(old, entity.brushes, *item, state.next_id);
    state.entities.push_back(std::move(item));
  }
  return state;
}

}  // namespace hallway::editor
