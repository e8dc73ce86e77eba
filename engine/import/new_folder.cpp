// SPDX-License-Identifier: MIT
#include "import/new_folder.hpp"

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/text.hpp"

namespace hallway::import {

void make_new_folder(const std::filesystem::path& path) {
  make_folder(path);
  std::error_code code;
  const bool empty = std::filesystem::is_empty(path, code);
  if (!code && empty) return;
  throw Error(
      ErrorCode::kIo,
      code ? "cannot read the folder: " + code.message() : "the folder is not empty; a new one is needed",
      {.file = printable(path.string(), 4096)});
}

}  // namespace hallway::import
