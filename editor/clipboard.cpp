// SPDX-License-Identifier: MIT
#include "editor/clipboard.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <system_error>
#include <utility>

#include "base/file.hpp"
#include "base/refuse.hpp"
#include "base/text.hpp"
#include "editor/commands/making.hpp"
#include "editor/made_line.hpp"
#include "map/reader.hpp"
#include "map/writer.hpp"

namespace hallway::editor {
namespace {

constexpr std::array kReferenceKeys{"path", "target", "killtarget"};

/// Things with their members; worldspawn as its brushes.
std::vector<Thing> copied_things(const State& state, const std::vector<Thing>& meant) {
  std::vector<Thing> things;
  for (const Thing& thing : with_members(state, meant)) {
    if (thing.brush || !state.entities[thing.entity]->is_world()) {
      things.push_back(thing);
      continue;
    }
    for (std::size_t b = 0; b < state.entities[thing.entity]->brushes.size(); ++b)
      things.push_back({thing.entity, b});
  }
  return things;
}

/// `north` becomes `north-2`, that `north-3`, and so on up to one that is not taken.
std::string next_name(const std::string& name, const std::set<std::string>& taken) {
  const std::size_t dash = name.rfind('-');
  const auto number =
      dash == std::string::npos ? std::nullopt : parse_uint(std::string_view(name).substr(dash + 1));
  const bool numbered = number && dash > 0 && *number > 0 && *number < 1'000'000'000;
  const std::string stem = numbered ? name.substr(0, dash) : name;
  for (std::uint64_t n = numbered ? *number + 1 : 2;; ++n) {
    std::string next = stem + '-' + std::to_string(n);
    if (!taken.contains(next)) return next;
  }
}

/// Changes the value of a key that is there.
void replace(map::Entity& head, std::string_view key, const std::string& value) {
  for (map::KeyValue& pair : head.keys) {
    if (pair.key == key) pair.value = value;
  }
}

/// Copies things into the state of an edit.
class Copier {
 public:
  Copier(Edit& edit, const State& source) : edit_(edit), source_(source), same_map_(&edit.state == &source) {}

  Copies copy(const std::vector<Thing>& meant) {
    const State source = source_;  // what is copied may be part of what is changed
    auto things = copied_things(source, meant);
    leave_out_starts(source, things);
    if (things.empty()) refuse("that leaves nothing to be copied");
    choose_names(source, things);
    std::map<std::size_t, std::vector<BrushItem>> loose;
    for (const Thing& thing : things) {
      if (thing.brush) {
        const BrushItem& item = source.entities[thing.entity]->brushes[*thing.brush];
        loose[same_map_ ? thing.entity : worldspawn(edit_.state)].push_back(item);
      }
    }
    const std::size_t first_new = edit_.state.entities.size();
    for (const auto& [entity, items] : loose) add_loose(entity, items);
    for (const Thing& thing : things) {
      if (!thing.brush) add_copy(*source.entities[thing.entity]);
    }
    for (std::size_t e = first_new; e < edit_.state.entities.size(); ++e) name_host(edit_.state, e);
    return std::move(copies_);
  }

 private:
  void leave_out_starts(const State& source, std::vector<Thing>& things) {
    const auto is_start = [](const EntityItem& entity) {
      return entity.classname() == "hw_robot_start" && entity.value("name").empty();
    };
    if (!find_entity(edit_.state, is_start)) return;
    const auto gone =
        std::erase_if(things, [&](const Thing& thing) { return is_start(*source.entities[thing.entity]); });
    if (gone > 0) copies_.notes.push_back("the robot start without a name is left out: a map has one");
  }

  void choose_names(const State& source, const std::vector<Thing>& things) {
    std::set<std::string> taken, mine;
    const auto add_names = [](const EntityItem& entity, std::set<std::string>& names) {
      for (const char* key : kNameKeys) {
        if (const std::string& name = entity.value(key); !name.empty()) names.insert(name);
      }
    };
    for (const auto& entity : edit_.state.entities) add_names(*entity, taken);
    int number = next_group_number(edit_.state);
    for (const Thing& thing : things) {
      if (thing.brush) continue;
      const EntityItem& entity = *source.entities[thing.entity];
      if (const auto group = group_number(entity)) groups_.emplace(*group, std::to_string(number++));
      if (is_layer(entity)) layers_.emplace(entity.value("_tb_id"), std::to_string(number++));
      add_names(entity, mine);
    }
    std::set<std::string> all = taken;
    all.insert(mine.begin(), mine.end());
    for (const std::string& name : mine) {
      const std::string next = taken.contains(name) ? next_name(name, all) : name;
      all.insert(next);
      names_.emplace(name, next);
    }
  }

  void add_loose(std::size_t entity, const std::vector<BrushItem>& items) {
    EntityItem& host = own(edit_.state, entity);
    for (const BrushItem& item : items) {
      copies_.ids.push_back(edit_.state.next_id++);
      host.brushes.push_back({copies_.ids.back(), item.brush});
    }
    forget_made(edit_.state, {Thing{entity, {}}});
  }

  void add_copy(const EntityItem& entity) {
    auto item = std::make_shared<EntityItem>();
    item->id = edit_.state.next_id++;
    item->head = std::make_shared<const map::Entity>(head_of_copy(entity));
    for (const BrushItem& brush : entity.brushes)
      item->brushes.push_back({edit_.state.next_id++, brush.brush});
    copies_.ids.push_back(item->id);
    const bool joins =
        item->has("_tb_group", entity.value("_tb_group")) && item->head->find(kMadeKey) == nullptr;
    edit_.state.entities.push_back(std::move(item));
    if (joins) forget_made(edit_.state, {Thing{edit_.state.entities.size() - 1, {}}});
  }

  static bool is_layer(const EntityItem& entity) { return entity.has("_tb_type", "_tb_layer"); }

  map::Entity head_of_copy(const EntityItem& entity) {
    map::Entity head = *entity.head;
    const auto follow = [&](const char* key, const std::map<std::string, std::string>& changes) {
      const std::string* value = head.find(key);
      const auto change = value != nullptr ? changes.find(*value) : changes.end();
      if (change == changes.end()) return false;
      replace(head, key, std::string(change->second));
      return true;
    };
    for (const char* key : kNameKeys) follow(key, names_);
    bool path_follows = false;
    for (const char* key : kReferenceKeys) path_follows = follow(key, names_) || path_follows;
    if (head.classname() == "hw_waypoint" && !path_follows) make_last(head);
    follow("_tb_id", is_layer(entity) ? layers_ : groups_);
    if (!follow("_tb_layer", layers_) && !same_map_) head.erase("_tb_layer");
    if (!follow("_tb_group", groups_) && !same_map_) head.erase("_tb_group");
    if (const std::string* line = head.find(kMadeKey); line != nullptr && head.find("_tb_name") != nullptr)
      replace(head, kMadeKey, renamed_line(*line, *head.find("_tb_name"), units_of(edit_.state)));
    return head;
  }

  /// A waypoint's number is its own within its path.
  void make_last(map::Entity& head) {
    const std::string* path = head.find("path");
    std::int64_t next = 0;
    if (path != nullptr) {
      for (const auto& [index, waypoint] : waypoints_of(edit_.state, *path)) {
        if (index && *index < 1'000'000'000) next = std::max(next, *index + 1);
      }
    }
    replace(head, "index", std::to_string(next));
  }

  Edit& edit_;
  const State& source_;
  bool same_map_;
  std::map<std::string, std::string> names_;
  std::map<std::string, std::string> groups_;
  std::map<std::string, std::string> layers_;
  Copies copies_;
};

const std::string& clipboard_of(const Edit& edit) {
  if (edit.clipboard.empty())
    refuse("there is no clipboard: neither XDG_CACHE_HOME nor HOME names a folder for its file");
  return edit.clipboard;
}

/// What brushes of an entity are alone: of groups, brushes of the world; of others, an entity of the same kind.
map::Entity without_group(const EntityItem& entity) {
  map::Entity head = *entity.head;
  std::erase_if(head.keys, [](const map::KeyValue& pair) {
    return pair.key == "_tb_group" || pair.key == "_tb_layer" || pair.key == "targetname" ||
           pair.key == kMadeKey;
  });
  return head;
}

}  // namespace

Copies add_copies(Edit& edit, const State& source, const std::vector<Thing>& things) {
  return Copier(edit, source).copy(things);
}

std::string clipboard_text(const Edit& edit, const std::vector<Thing>& meant) {
  const State& state = edit.state;
  const auto things = copied_things(state, meant);
  map::Document document;
  map::Entity world;
  world.keys = {
      {"classname", "worldspawn"}, {"_hallway", "1"}, {"_scale", format_double(edit.metres_per_unit())}};
  std::set<std::string> groups;
  for (const Thing& thing : things) {
    const auto number = thing.brush ? std::nullopt : group_number(*state.entities[thing.entity]);
    if (number) groups.insert(*number);
  }
  std::map<std::size_t, std::size_t> places;  // of entities of which brushes only are copied
  for (const Thing& thing : things) {
    const EntityItem& entity = *state.entities[thing.entity];
    if (thing.brush && (entity.is_world() || entity.classname() == "func_group")) {
      world.brushes.push_back(*entity.brushes[*thing.brush].brush);
    } else if (thing.brush) {
      const auto [place, is_new] = places.emplace(thing.entity, document.entities.size());
      if (is_new) document.entities.push_back(without_group(entity));
      document.entities[place->second].brushes.push_back(*entity.brushes[*thing.brush].brush);
    } else {
      map::Entity& copy = document.entities.emplace_back(*entity.head);
      for (const BrushItem& item : entity.brushes) copy.brushes.push_back(*item.brush);
      copy.erase("_tb_layer");
      if (const std::string* in = copy.find("_tb_group"); in != nullptr && !groups.contains(*in))
        copy.erase("_tb_group");
    }
  }
  document.entities.insert(document.entities.begin(), std::move(world));
  return map::print(document);
}

void write_clipboard(const Edit& edit, const std::string& text) {
  if (edit.held_clipboard != nullptr) {
    *edit.held_clipboard = text;
    return;
  }
  const std::filesystem::path file = clipboard_of(edit);
  if (file.has_parent_path()) make_folder(file.parent_path());
  write_file_atomically(file, text);
}

State read_clipboard(const Edit& edit) {
  const bool held = edit.held_clipboard != nullptr;
  const std::string file = held ? std::string() : clipboard_of(edit);
  std::error_code none;
  if (!held && !std::filesystem::exists(file, none))
    refuse("the clipboard is empty; `copy` or `cut` fills it");
  State state = state_of(map::parse(held ? *edit.held_clipboard : read_file(file, map::kMaxMapBytes), file));
  if (all_things(state).empty()) refuse("the clipboard is empty; `copy` or `cut` fills it");
  return state;
}

}  // namespace hallway::editor
