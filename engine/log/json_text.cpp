// SPDX-License-Identifier: MIT
#include "log/json_text.hpp"

#include <fmt/format.h>

#include "base/error.hpp"

namespace hallway::log {
namespace {

constexpr std::size_t kMaxBytes = 32u << 20;
constexpr int kMaxDepth = 16;

}  // namespace

void check_json_size(std::string_view text) {
  if (text.size() > kMaxBytes)
    throw Error(ErrorCode::kBadInput, fmt::format("{} bytes of JSON", text.size()));
  int depth = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_string && c == '\\') {
      ++i;
    } else if (c == '"') {
      in_string = !in_string;
    } else if (!in_string && (c == '[' || c == '{')) {
      if (++depth > kMaxDepth) throw Error(ErrorCode::kBadInput, "JSON that is nested too deeply");
    } else if (!in_string && (c == ']' || c == '}')) {
      --depth;
    }
  }
}

}  // namespace hallway::log
