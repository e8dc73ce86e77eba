// SPDX-License-Identifier: MIT
#pragma once

#include <fmt/core.h>

#include <string>
#include <utility>
#include <vector>

#include "base/error.hpp"

namespace hallway {

/// Throws Error{kUsage}: a command was given what it cannot do.
[[noreturn]] inline void refuse(const std::string& message) {
  throw Error(ErrorCode::kUsage, message);
}
template <typename First, typename... Rest>
[[noreturn]] void refuse(fmt::format_string<First, Rest...> format, First&& first, Rest&&... rest) {
  refuse(fmt::format(format, std::forward<First>(first), std::forward<Rest>(rest)...));
}

/// The names of the entries of a table, for suggestion(). @param name  pointer to the member that has them
template <typename Table, typename Name>
std::vector<std::string> names_in(const Table& table, Name name) {
  std::vector<std::string> names;
  for (const auto& entry : table) names.emplace_back(entry.*name);
  return names;
}

}  // namespace hallway
