// SPDX-License-Identifier: MIT
#include "sim/clouds.hpp"

#include <algorithm>
#include <limits>
#include <string>

#include "base/error.hpp"
#include "base/text.hpp"
#include "map/entity_schema.hpp"
#include "sim/schema.hpp"

namespace hallway::sim {
namespace {

constexpr const char* kCloudClass = "hw_landmark_cloud";
constexpr std::int64_t kMostGroups = 1'000'000;

const map::KeySpec& cloud_key(std::string_view name) {
  const auto keys = map::find_entity_spec(kCloudClass)->keys;
  return *std::find_if(keys.begin(), keys.end(), [&](const map::KeySpec& key) { return key.name == name; });
}

std::vector<std::string> words_of(std::string_view text) {
  std::vector<std::string> words;
  for (const std::string_view word : split(text, ' ')) words.emplace_back(word);
  return words;
}

std::string read_value(TableReader& cloud, const std::string& key) {
  const map::KeySpec& spec = cloud_key(key);
  switch (spec.kind) {
    case map::KeyKind::kChoice: {
      const std::vector<std::string> choices = words_of(spec.choices);
      return choices[cloud.choice(key, choices)];
    }
    case map::KeyKind::kSeed:
      return std::to_string(cloud.whole(key, 0, std::numeric_limits<std::int64_t>::max()));
    case map::KeyKind::kWhole:
      return std::to_string(cloud.whole(key, 1, kMostGroups));
    default:
      return format_double(cloud.number(key, {spec.low, spec.high}));
  }
}

void set_key(map::Entity& entity, const map::KeyValue& wanted) {
  for (map::KeyValue& pair : entity.keys) {
    if (pair.key != wanted.key) continue;
    pair.value = wanted.value;
    return;
  }
  entity.keys.push_back(wanted);
  entity.keys.back().line = entity.line;
}

map::Entity* find_cloud(map::Document& document, std::string_view name) {
  for (map::Entity& entity : document.entities) {
    const std::string* its_name = entity.find("name");
    if (entity.classname() == kCloudClass && its_name != nullptr && *its_name == name) return &entity;
  }
  return nullptr;
}

std::vector<std::string> cloud_names(const map::Document& document) {
  std::vector<std::string> names;
  for (const map::Entity& entity : document.entities) {
    const std::string* name = entity.find("name");
    if (entity.classname() == kCloudClass && name != nullptr) names.push_back(*name);
  }
  return names;
}

}  // namespace

std::vector<map::KeyValue> read_cloud_keys(TableReader& cloud) {
  std::vector<map::KeyValue> keys;
  for (const std::string& key : kCloudKeys) {
    if (cloud.has(key)) keys.push_back({key, read_value(cloud, key)});
  }
  return keys;
}

void set_cloud_keys(std::span<const CloudSpec> clouds, map::Document& document) {
  for (const CloudSpec& cloud : clouds) {
    map::Entity* entity = find_cloud(document, cloud.name);
    if (entity == nullptr) {
      throw Error(ErrorCode::kBadInput,
                  "the map has no hw_landmark_cloud `" + printable(cloud.name) + "`" +
                      suggestion(cloud.name, cloud_names(document)),
                  cloud.where);
    }
    for (const map::KeyValue& key : cloud.keys) set_key(*entity, key);
  }
}

}  // namespace hallway::sim
