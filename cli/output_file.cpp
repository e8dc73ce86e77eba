// SPDX-License-Identifier: MIT
#include "output_file.hpp"

#include "base/error.hpp"
#include "base/text.hpp"
#include "console.hpp"
#include "run/pictures/pictures.hpp"
#include "run/pictures/record.hpp"

namespace hallway::cli {

namespace fs = std::filesystem;

namespace {

/// Whether a canonical path is `folder`, or below it.
bool lies_in(fs::path path, const fs::path& folder) {
  for (; path.has_relative_path(); path = path.parent_path()) {
    if (path == folder) return true;
  }
  return false;
}

}  // namespace

void check_output_file(const std::string& file) {
  std::error_code code;
  if (fs::exists(file, code) && !fs::is_regular_file(file, code)) {
    throw Error(ErrorCode::kIo, "is not a file that can be replaced", {.file = path_text(file)});
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
    const fs::path read = fs::canonical(input, none);
    if (!none && (lies_in(read, place) || lies_in(place, read)))
      throw Error(ErrorCode::kUsage, "--out would replace what is read", {.file = path_text(out)});
  }
}

void check_new_file(const fs::path& file, bool replace) {
  std::error_code none;
  if (!replace && fs::exists(fs::symlink_status(file, none)))
    throw Error(ErrorCode::kIo, "is there already; --force replaces it", {.file = path_text(file)});
}

fs::path output_folder(const std::string& out, const std::string& name) {
  return out.empty() ? fs::path("out") / name : fs::path(out);
}

void check_output_folder(const fs::path& folder, const char* document, bool replace) {
  const Where where{.file = path_text(folder)};
  if (run::is_run_folder(folder))
    throw Error(ErrorCode::kIo, "is the folder of a run; --out names another one", where);
  std::error_code none;
  if (replace || !fs::exists(folder / document, none)) return;
  throw Error(ErrorCode::kIo, std::string("has earlier results (") + document + "); --force replaces them",
              where);
}

}  // namespace hallway::cli
