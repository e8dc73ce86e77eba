// SPDX-License-Identifier: MIT
#include "output_file.hpp"

#include <filesystem>

#include "base/error.hpp"
#include "base/text.hpp"
#include "run/pictures.hpp"

namespace hallway::cli {

namespace fs = std::filesystem;

void check_output_file(const std::string& file) {
  std::error_code code;
  if (fs::exists(file, code) && !fs::is_regular_file(file, code)) {
    throw Error(ErrorCode::kIo, "is not a file that can be replaced", {.file = printable(file, 4096)});
  }
}

void check_picture_file(const std::string& file) {
  run::check_picture_name(file);
  check_output_file(file);
}

void check_replaces_no_input(const std::string& out, std::span<const std::string> inputs) {
  std::error_code none;
  const fs::path place = fs::canonical(out, none);
  if (none) return;
  for (const std::string& input : inputs) {
    for (fs::path part = fs::canonical(input, none); !none && part.has_relative_path();
         part = part.parent_path()) {
      if (part == place)
        throw Error(ErrorCode::kUsage, "--out would replace what is read", {.file = printable(out, 4096)});
    }
  }
}

}  // namespace hallway::cli
