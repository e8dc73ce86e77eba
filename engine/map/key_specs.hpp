// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "map/entity_schema.hpp"

// Makes the rows of entity_schema().
namespace hallway::map::key_specs {

constexpr KeySpec number(std::string_view name, double low, double high, std::string_view fallback) {
  return {.name = name, .kind = KeyKind::kNumber, .low = low, .high = high, .fallback = fallback};
}

constexpr KeySpec number_above(std::string_view name, double low, double high, std::string_view fallback) {
  KeySpec key = number(name, low, high, fallback);
  key.above_low = true;
  return key;
}

constexpr KeySpec required_number(std::string_view name, double low, double high) {
  return {.name = name, .kind = KeyKind::kNumber, .required = true, .low = low, .high = high};
}

/// One number or three (kNumbers), three (kVector), or any number of them (kList).
constexpr KeySpec numbers(std::string_view name, KeyKind kind, double low, double high,
                          std::string_view fallback) {
  return {.name = name, .kind = kind, .low = low, .high = high, .fallback = fallback};
}

constexpr KeySpec whole(std::string_view name, double low, double high, std::string_view fallback) {
  return {.name = name, .kind = KeyKind::kWhole, .low = low, .high = high, .fallback = fallback};
}

constexpr KeySpec flag(std::string_view name, std::string_view fallback) {
  return {.name = name, .kind = KeyKind::kFlag, .fallback = fallback};
}

constexpr KeySpec choice(std::string_view name, std::string_view choices, std::string_view fallback) {
  return {.name = name, .kind = KeyKind::kChoice, .fallback = fallback, .choices = choices};
}

constexpr KeySpec required(std::string_view name, KeyKind kind) {
  return {.name = name, .kind = kind, .required = true};
}

constexpr KeySpec about(KeySpec key, std::string_view text) {
  key.about = text;
  return key;
}

constexpr KeySpec of_variant(std::string_view variant, KeySpec key) {
  key.variant = variant;
  return key;
}

constexpr KeySpec of_variant(std::string_view variant, KeySpec key, std::string_view about) {
  key.variant = variant;
  key.about = about;
  return key;
}

}  // namespace hallway::map::key_specs
