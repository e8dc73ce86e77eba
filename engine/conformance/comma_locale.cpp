// SPDX-License-Identifier: MIT
#include <locale.h>
#include <stdlib.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

#include "base/file.hpp"
#include "conformance/surroundings.hpp"

namespace hallway::conformance {
namespace {

constexpr const char* kName = "hallway_comma";

/// The content of an LC_NUMERIC file of the GNU C library (locale/loadlocale.c): a mark, the number of items, where each begins, the items.
std::string numeric_locale() {
  constexpr std::uint32_t kMark = 0x20031115u ^ LC_NUMERIC;
  constexpr std::uint32_t kComma = ',';
  constexpr std::uint32_t kPoint = '.';
  const std::array<std::string, 6> items{std::string(",\0\0\0", 4), std::string(".\0\0\0", 4),
                                         std::string(4, '\0'),      std::string(4, '\0'),
                                         std::string(4, '\0'),      std::string("UTF-8\0\0\0", 8)};
  std::string text;
  const auto number = [&text](std::uint32_t value) {
    text.append(static_cast<const char*>(static_cast<const void*>(&value)), sizeof value);
  };
  number(kMark);
  number(items.size());
  std::uint32_t offset = 8 + 4 * items.size();
  for (const std::string& item : items) {
    number(offset);
    offset += static_cast<std::uint32_t>(item.size());
  }
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (i == 3 || i == 4) {
      number(i == 3 ? kComma : kPoint);  // the same as wide characters
    } else {
      text += items[i];
    }
  }
  return text;
}

}  // namespace

bool set_comma_locale(const std::filesystem::path& folder) {
  if (folder.empty()) return false;
  std::filesystem::create_directories(folder / kName);
  write_file_atomically(folder / kName / "LC_NUMERIC", numeric_locale());
  ::setenv("LOCPATH", folder.c_str(), 1);
  return ::setlocale(LC_NUMERIC, kName) != nullptr && std::string_view(::localeconv()->decimal_point) == ",";
}

}  // namespace hallway::conformance
