// SPDX-License-Identifier: MIT
#include "host/load/info_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "base/error.hpp"
#include "base/text.hpp"

namespace hallway::host {
namespace {

constexpr std::size_t kMaxIdBytes = 64;

}  // namespace

void fail_info(const std::string& message) {
  throw Error(ErrorCode::kPluginLoad, "describes itself badly: " + message);
}

std::string read_info_text(const char* text, const char* member) {
  if (text == nullptr) fail_info(fmt::format("its {} is null", member));
  return printable({text, strnlen(text, kMaxInfoTextBytes)}, kMaxInfoTextBytes);
}

std::string read_info_id(const char* text) {
  std::string id = read_info_text(text, "id");
  const auto allowed = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-' || c == '.';
  };
  if (id.empty() || id.size() > kMaxIdBytes || !std::ranges::all_of(id, allowed)) {
    fail_info(
        fmt::format("its id `{}` is not 1 to {} letters, digits and _ - .", printable(id), kMaxIdBytes));
  }
  return id;
}

}  // namespace hallway::host
