// SPDX-License-Identifier: MIT
#include "map/materials.hpp"

#include <algorithm>
#include <cstdint>
#include <map>

#include "base/file.hpp"
#include "base/table_reader.hpp"
#include "base/text.hpp"
#include "base/toml_reader.hpp"
#include "map/entity_keys.hpp"

namespace hallway::map {
namespace {

constexpr const char* kMaterialsSchema = "hallway.materials/1";
constexpr const char* kMaterialsKey = "_materials";
constexpr std::uint64_t kMaxMaterialsBytes = 4U << 20;

/// Without folders, in small letters.
std::string compared(std::string_view name) {
  const std::size_t slash = name.rfind('/');
  std::string plain(slash == std::string_view::npos ? name : name.substr(slash + 1));
  for (char& c : plain) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return plain;
}

bool is_pattern(std::string_view name) {
  return name.find('*') != std::string_view::npos;
}

/// Whether a text is what a pattern says. O(length of both, multiplied).
bool fits_pattern(std::string_view text, std::string_view pattern) {
  std::size_t at = 0, in_pattern = 0, star = std::string_view::npos, resume = 0;
  while (at < text.size()) {
    if (in_pattern < pattern.size() && pattern[in_pattern] == '*') {
      star = in_pattern++;
      resume = at;
    } else if (in_pattern < pattern.size() && pattern[in_pattern] == text[at]) {
      ++in_pattern;
      ++at;
    } else if (star != std::string_view::npos) {
      in_pattern = star + 1;
      at = ++resume;
    } else {
      return false;
    }
  }
  return pattern.find_first_not_of('*', in_pattern) == std::string_view::npos;
}

std::vector<std::string> entry_keys() {
  std::vector<std::string> keys{"like"};
  for (const MaterialProperty& property : kMaterialProperties) keys.emplace_back(property.key);
  return keys;
}

/// Follows `like` from entry to entry and gives the first ones what the others say.
template <typename Values>
class Inheritance {
 public:
  Inheritance(std::vector<Values>& values, const std::vector<std::size_t>& like)
      : values_(values), like_(like), state_(values.size(), State::kOpen) {}

  /// False where `like` leads round.
  bool resolve(std::size_t entry) {
    std::vector<std::size_t> chain;
    while (entry < values_.size() && state_[entry] == State::kOpen) {
      state_[entry] = State::kUnderWay;
      chain.push_back(entry);
      entry = like_[entry];
    }
    if (entry < values_.size() && state_[entry] == State::kUnderWay) return false;
    for (auto at = chain.rbegin(); at != chain.rend(); ++at) {
      if (entry < values_.size()) {
        for (std::size_t i = 0; i < values_[*at].size(); ++i) {
          if (!values_[*at][i]) values_[*at][i] = values_[entry][i];
        }
      }
      state_[*at] = State::kDone;
      entry = *at;
    }
    return true;
  }

 private:
  enum class State { kOpen, kUnderWay, kDone };

  std::vector<Values>& values_;
  const std::vector<std::size_t>& like_;
  std::vector<State> state_;
};

}  // namespace

MaterialTable MaterialTable::read(const TomlTable& materials, const std::string& file,
                                  std::vector<Setting>& settings) {
  constexpr std::size_t kNone = ~std::size_t{0};
  std::vector<std::string> names;
  for (const TomlEntry& entry : materials) names.push_back(entry.key);
  const TableReader all(file, "material", materials, 0, names, settings);
  if (names.size() > kMostMaterials)
    throw all.error(names.back(),
                    "is one too many: at most " + std::to_string(kMostMaterials) + " materials are allowed");
  std::map<std::string, std::size_t> index;
  std::vector<std::array<std::optional<double>, kMaterialProperties.size()>> values(names.size());
  std::vector<std::string> likes(names.size());
  const std::vector<std::string> known = entry_keys();
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string& name = names[i];
    if (!std::holds_alternative<TomlTable>(find(materials, name)->value))
      throw all.error(name, "must be a table: a material is written as [material.NAME]");
    if (name.empty() || name.find('/') != std::string::npos)
      throw all.error(name, "must be a name without a folder: folders do not count");
    const auto [first, is_new] = index.emplace(compared(name), i);
    if (!is_new) {
      throw all.error(name, "is the same material as `" + printable(names[first->second], 60) + "` at line " +
                                std::to_string(all.line(names[first->second])) + ": case does not count");
    }
    TableReader entry(all.file(name), "material." + name, all.table(name), all.line(name), known, settings);
    for (std::size_t k = 0; k < kMaterialProperties.size(); ++k) {
      const MaterialProperty& property = kMaterialProperties.at(k);
      if (entry.has(property.key))
        values[i].at(k) = entry.number(property.key, {property.low, property.high});
    }
    if (entry.has("like")) likes[i] = entry.text("like");
  }
  std::vector<std::size_t> like(names.size(), kNone);
  const auto error_of = [&](std::size_t i, const std::string& problem) {
    return TableReader(all.file(names[i]), "material." + names[i], all.table(names[i]), all.line(names[i]),
                       known, settings)
        .error("like", problem);
  };
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (likes[i].empty()) continue;
    const auto found = index.find(compared(likes[i]));
    if (found == index.end())
      throw error_of(i, "there is no material `" + printable(likes[i], 60) + "` in this table" +
                            suggestion(likes[i], names));
    like[i] = found->second;
  }
  Inheritance inheritance(values, like);
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (!inheritance.resolve(i)) throw error_of(i, "leads round to the material itself");
  }
  MaterialTable table;
  for (const bool pattern : {false, true}) {
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (is_pattern(names[i]) == pattern)
        table.entries_.push_back({.name = compared(names[i]), .values = values[i]});
    }
  }
  return table;
}

void MaterialTable::add_below(const MaterialTable& other) {
  entries_.insert(entries_.end(), other.entries_.begin(), other.entries_.end());
}

MaterialProperties MaterialTable::of(std::string_view material) const {
  const std::string name = compared(material);
  MaterialProperties properties;
  std::array<bool, kMaterialProperties.size()> is_said{};
  for (const Entry& entry : entries_) {
    if (is_pattern(entry.name) ? !fits_pattern(name, entry.name) : name != entry.name) continue;
    for (std::size_t k = 0; k < kMaterialProperties.size(); ++k) {
      if (is_said.at(k) || !entry.values.at(k)) continue;
      properties.*kMaterialProperties.at(k).member = *entry.values.at(k);
      is_said.at(k) = true;
    }
  }
  return properties;
}

bool MaterialTable::describes(std::string_view material) const {
  const std::string name = compared(material);
  return std::ranges::any_of(entries_, [&](const Entry& entry) {
    return is_pattern(entry.name) ? fits_pattern(name, entry.name) : name == entry.name;
  });
}

MaterialTable load_materials(const std::filesystem::path& file, std::vector<Setting>& settings) {
  const std::string name = file.string();
  const TomlTable root = parse_toml(read_file(file, kMaxMaterialsBytes), name);
  std::vector<Setting> unused;
  TableReader top(name, "", root, 1, {"schema", "material"}, unused);
  if (const std::string schema = top.text("schema"); schema != kMaterialsSchema)
    throw top.error("schema", "\"" + printable(schema) + "\" is not read by this version; it reads \"" +
                                  kMaterialsSchema + "\"");
  return MaterialTable::read(top.table("material"), name, settings);
}

MaterialTable materials_of(const Document& document, const std::filesystem::path& map_folder,
                           std::vector<Setting>& settings) {
  for (const Entity& entity : document.entities) {
    if (entity.classname() != "worldspawn") continue;
    const EntityKeys keys(document, entity);
    if (!keys.has(kMaterialsKey)) return {};
    const std::string name = keys.text(kMaterialsKey);
    const std::filesystem::path path(name);
    const bool leads_out =
        path.is_absolute() || std::ranges::find(path, std::filesystem::path("..")) != path.end();
    if (name.empty() || leads_out)
      throw keys.error("key `_materials`: `" + printable(name, 60) + "` is no file below the map's folder",
                       kMaterialsKey);
    return load_materials((map_folder.empty() ? std::filesystem::path(".") : map_folder) / path, settings);
  }
  return {};
}

}  // namespace hallway::map
