// SPDX-License-Identifier: MIT
#include "map/entity_keys.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "base/text.hpp"
#include "map/world.hpp"

namespace hallway::map {
namespace {

constexpr std::array<std::string_view, 6> kCommonKeys{"classname",  "origin", "angle",
                                                      "targetname", "target", "spawnflags"};

std::string quote(std::string_view text) {
  return "`" + printable(text, 60) + "`";
}

}  // namespace

int EntityKeys::index() const {
  return static_cast<int>(&entity_ - document_.entities.data());
}

Error EntityKeys::error(std::string message, std::string_view key) const {
  int line = entity_.line;
  for (const KeyValue& pair : entity_.keys) {
    if (pair.key == key) line = pair.line;
  }
  std::string element = "entity " + std::to_string(index());
  if (!entity_.classname().empty()) element += " (" + printable(entity_.classname(), 60) + ")";
  return Error(ErrorCode::kBadInput, std::move(message), {document_.file, line, std::move(element)});
}

const KeyValue* EntityKeys::find_once(std::string_view key) const {
  const KeyValue* found = nullptr;
  for (const KeyValue& pair : entity_.keys) {
    if (pair.key != key) continue;
    if (found)
      throw error("key " + quote(key) + " stands twice, first at line " + std::to_string(found->line), key);
    found = &pair;
  }
  return found;
}

const KeyValue& EntityKeys::require(std::string_view key) const {
  const KeyValue* pair = find_once(key);
  if (!pair) throw error("key " + quote(key) + " is missing");
  return *pair;
}

std::string EntityKeys::text(std::string_view key) const {
  const KeyValue& pair = require(key);
  if (pair.value.empty()) throw error("key " + quote(key) + " is empty", key);
  return pair.value;
}

double EntityKeys::number_from(const KeyValue& pair, double low, double high) const {
  const auto value = parse_double(trim(pair.value));
  if (!value)
    throw error("key " + quote(pair.key) + ": " + quote(pair.value) + " is no finite decimal number",
                pair.key);
  if (*value < low || *value > high) {
    throw error("key " + quote(pair.key) + " is " + format_double(*value) + "; it must lie between " +
                    format_double(low) + " and " + format_double(high),
                pair.key);
  }
  return *value;
}

double EntityKeys::number(std::string_view key, double low, double high) const {
  return number_from(require(key), low, high);
}

double EntityKeys::number_or(std::string_view key, double fallback, double low, double high) const {
  const KeyValue* pair = find_once(key);
  return pair ? number_from(*pair, low, high) : fallback;
}

std::int64_t EntityKeys::integer(std::string_view key) const {
  const KeyValue& pair = require(key);
  const auto value = parse_int(trim(pair.value));
  if (!value) throw error("key " + quote(key) + ": " + quote(pair.value) + " is no whole number", key);
  return *value;
}

std::uint64_t EntityKeys::seed_or(std::string_view key, std::uint64_t fallback) const {
  const KeyValue* pair = find_once(key);
  if (!pair) return fallback;
  const auto value = parse_uint(trim(pair->value));
  if (!value)
    throw error("key " + quote(key) + ": " + quote(pair->value) + " is no whole number from 0 to 2^64 - 1",
                key);
  return *value;
}

bool EntityKeys::flag_or(std::string_view key, bool fallback) const {
  const KeyValue* pair = find_once(key);
  if (!pair) return fallback;
  if (pair->value != "0" && pair->value != "1") {
    throw error("key " + quote(key) + " is " + quote(pair->value) + "; it must be 0 or 1", key);
  }
  return pair->value == "1";
}

Vec3 EntityKeys::origin_m() const {
  const KeyValue& pair = require("origin");
  std::vector<double> numbers;
  for (const std::string_view part : split(pair.value, ' ')) {
    if (part.empty()) continue;
    const auto value = parse_double(part);
    if (!value) throw error("key `origin`: " + quote(part) + " is no finite decimal number", "origin");
    if (std::abs(*value) > kMaxCoordinate) {
      throw error("key `origin`: " + quote(part) + " lies beyond " + format_double(kMaxCoordinate) + " units",
                  "origin");
    }
    numbers.push_back(*value);
    if (numbers.size() > 3) break;
  }
  if (numbers.size() != 3)
    throw error("key `origin`: " + quote(pair.value) + " is not three numbers", "origin");
  return Vec3(numbers[0], numbers[1], numbers[2]) * document_.metres_per_unit();
}

double EntityKeys::angle() const {
  constexpr double kLargest_deg = 3600.0;  // far above what editors write, and still exact in radians
  return number_or("angle", 0.0, -kLargest_deg, kLargest_deg) * std::numbers::pi / 180.0;
}

void EntityKeys::refuse_unknown(std::initializer_list<std::string_view> known) const {
  std::vector<std::string> names(kCommonKeys.begin(), kCommonKeys.end());
  names.insert(names.end(), known.begin(), known.end());
  for (const KeyValue& pair : entity_.keys) {
    if (pair.key.starts_with('_') || pair.key.starts_with("//")) continue;
    if (std::find(names.begin(), names.end(), pair.key) != names.end()) continue;
    throw error("unknown key " + quote(pair.key) + suggestion(pair.key, names), pair.key);
  }
}

}  // namespace hallway::map
