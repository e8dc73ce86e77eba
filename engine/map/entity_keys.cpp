// SPDX-License-Identifier: MIT
#include "map/entity_keys.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "base/text.hpp"
#include "map/world.hpp"

namespace hallway::map {
namespace {

constexpr double kAnything = std::numeric_limits<double>::max();

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

bool EntityKeys::is_doubled(std::string_view key) const {
  return std::count_if(entity_.keys.begin(), entity_.keys.end(),
                       [&](const KeyValue& pair) { return pair.key == key; }) > 1;
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

void EntityKeys::check_range(const KeySpec& key, double value) const {
  if (value >= key.low && value <= key.high && !(key.above_low && value == key.low)) return;
  const std::string low = format_double(key.low), high = format_double(key.high);
  throw error("key " + quote(key.name) + ": " + format_double(value) + " is out of range: must be " +
                  (key.above_low ? "above " : "at least ") + low + " and at most " + high,
              key.name);
}

double EntityKeys::number_from(const KeyValue& pair, double low, double high) const {
  const auto value = parse_double(trim(pair.value));
  if (!value)
    throw error("key " + quote(pair.key) + ": " + quote(pair.value) + " is no finite decimal number",
                pair.key);
  check_range({.name = pair.key, .low = low, .high = high}, *value);
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

std::vector<double> EntityKeys::numbers_from(const KeyValue& pair) const {
  constexpr std::size_t kMost = 4;  // one more than any key has: enough to see that there are too many
  std::vector<double> numbers;
  for (const std::string_view part : split(pair.value, ' ')) {
    if (part.empty()) continue;
    const auto value = parse_double(part);
    if (!value)
      throw error("key " + quote(pair.key) + ": " + quote(part) + " is no finite decimal number", pair.key);
    numbers.push_back(*value);
    if (numbers.size() == kMost) break;
  }
  return numbers;
}

Vec3 EntityKeys::vector(std::string_view key) const {
  const KeyValue& pair = require(key);
  const std::vector<double> numbers = numbers_from(pair);
  if (numbers.size() != 3)
    throw error("key " + quote(key) + ": " + quote(pair.value) + " is not three numbers", key);
  return {numbers[0], numbers[1], numbers[2]};
}

Vec3 EntityKeys::point(std::string_view key) const {
  const Vec3 point = vector(key);
  for (const double coordinate : point) {
    if (std::abs(coordinate) <= kMaxCoordinate) continue;
    throw error("key " + quote(key) + ": `" + format_double(coordinate) + "` lies beyond " +
                    format_double(kMaxCoordinate) + " units",
                key);
  }
  return point;
}

Vec3 EntityKeys::origin_m() const {
  return point("origin") * document_.metres_per_unit();
}

double EntityKeys::angle() const {
  constexpr double kLargest_deg = 3600.0;  // far above what editors write, and still exact in radians
  return number_or("angle", 0.0, -kLargest_deg, kLargest_deg) * std::numbers::pi / 180.0;
}

std::vector<Error> EntityKeys::unknown_keys() const {
  const EntitySpec* spec = find_entity_spec(entity_.classname());
  if (!spec || spec->open) return {};
  std::vector<std::string> names(common_keys().begin(), common_keys().end());
  const std::string_view variant = variant_of(*spec, entity_);
  for (const KeySpec& key : spec->keys) {
    if (belongs(key, variant)) names.emplace_back(key.name);
  }
  constexpr std::size_t kMost = 20;  // of one entity; each takes a walk over all of its keys
  std::vector<Error> unknown;
  for (const KeyValue& pair : entity_.keys) {
    if (unknown.size() == kMost) break;
    if (pair.key.starts_with('_') || pair.key.starts_with("//")) continue;
    if (std::find(names.begin(), names.end(), pair.key) != names.end()) continue;
    unknown.push_back(error("unknown key " + quote(pair.key) + suggestion(pair.key, names), pair.key));
  }
  return unknown;
}

void EntityKeys::refuse_unknown() const {
  const std::vector<Error> unknown = unknown_keys();
  if (!unknown.empty()) throw unknown.front();
}

void EntityKeys::check_scale(std::string_view key) const {
  const KeyValue& pair = require(key);
  const std::vector<double> numbers = numbers_from(pair);
  const bool in_range = std::all_of(numbers.begin(), numbers.end(),
                                    [](double n) { return std::abs(n) >= 1e-6 && std::abs(n) <= 1e6; });
  if ((numbers.size() == 1 || numbers.size() == 3) && in_range) return;
  throw error("key " + quote(key) + ": " + quote(pair.value) +
                  " is not one number or three, each of 1e-6 to 1e6 or its negative",
              key);
}

void EntityKeys::check_numbers(const KeySpec& key) const {
  const KeyValue& pair = require(key.name);
  const std::vector<double> numbers = numbers_from(pair);
  if (key.kind != KeyKind::kList && numbers.size() != 3 &&
      (numbers.size() != 1 || key.kind == KeyKind::kVector)) {
    throw error("key " + quote(key.name) + ": " + quote(pair.value) +
                    (key.kind == KeyKind::kVector ? " is not three numbers" : " is not one number or three"),
                key.name);
  }
  if (key.low == key.high) return;
  for (const double number : numbers) check_range(key, number);
}

void EntityKeys::check_choice(const KeySpec& key) const {
  const std::string value = text(key.name);
  std::vector<std::string> choices;
  for (const std::string_view choice : split(key.choices, ' ')) choices.emplace_back(choice);
  if (std::find(choices.begin(), choices.end(), value) != choices.end()) return;
  std::string message =
      "unknown " + std::string(key.name) + " " + quote(value) + suggestion(value, choices) + "; there are";
  for (const std::string& choice : choices) message += " `" + choice + "`";
  throw error(message, key.name);
}

void EntityKeys::check_value(const KeySpec& key) const {
  switch (key.kind) {
    case KeyKind::kText:
    case KeyKind::kName:
      text(key.name);
      break;
    case KeyKind::kNumber:
      check_range(key, number(key.name, -kAnything, kAnything));
      break;
    case KeyKind::kWhole:
      if (const auto value = static_cast<double>(integer(key.name)); key.low != key.high)
        check_range(key, value);
      break;
    case KeyKind::kSeed:
      seed_or(key.name, 0);
      break;
    case KeyKind::kFlag:
      flag_or(key.name, false);
      break;
    case KeyKind::kChoice:
      check_choice(key);
      break;
    case KeyKind::kPoint:
      point(key.name);
      break;
    case KeyKind::kVector:
    case KeyKind::kNumbers:
    case KeyKind::kList:
      check_numbers(key);
      break;
    case KeyKind::kScale:
      check_scale(key.name);
      break;
  }
}

}  // namespace hallway::map
