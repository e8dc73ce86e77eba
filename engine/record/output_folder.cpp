// SPDX-License-Identifier: MIT
#include "record/output_folder.hpp"

#include <fcntl.h>
#include <stdio.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>
#include <utility>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/text.hpp"

namespace hallway::record {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& path, const std::string& message) {
  throw Error(ErrorCode::kIo, message, {.file = printable(path.string())});
}

/// Throws unless nothing stands at `path`, or something that commit() may replace.
void check_free(const fs::path& path, bool replace) {
  std::error_code code;
  const fs::file_status status = fs::symlink_status(path, code);
  if (status.type() == fs::file_type::not_found) return;
  if (status.type() == fs::file_type::none) fail(path, "cannot write there: " + code.message());
  if (status.type() != fs::file_type::directory) fail(path, "is there already and is not a folder");
  if (fs::is_empty(path, code)) return;
  if (!replace) fail(path, "is there already; --force replaces an earlier run");
  if (!fs::exists(path / "run.json", code))
    fail(path, "is not a run folder (it has no run.json); not replaced");
}

}  // namespace

OutputFolder::OutputFolder(fs::path path, bool replace) : path_(std::move(path)), replace_(replace) {
  if (path_.filename().empty()) path_ = path_.parent_path();  // "out/" means "out"
  if (path_.empty() || path_.filename() == "." || path_.filename() == "..") {
    fail(path_, "is no name for an output folder");
  }
  check_free(path_, replace_);
  const fs::path parent = path_.parent_path();
  if (!parent.empty()) make_folder(parent);
  working_path_ = path_.string() + ".part-" + std::to_string(::getpid());
  std::error_code code;
  fs::remove_all(working_path_, code);
  if (!fs::create_directory(working_path_, code)) fail(path_, "cannot make the folder: " + code.message());
}

OutputFolder::~OutputFolder() {
  if (committed_) return;
  std::error_code code;
  fs::remove_all(working_path_, code);
}

void OutputFolder::commit() {
  check_free(path_, replace_);
  std::error_code code;
  if (fs::exists(path_, code)) {
    // The two change names in one step; what was there is then removed under the working name.
    if (::renameat2(AT_FDCWD, working_path_.c_str(), AT_FDCWD, path_.c_str(), RENAME_EXCHANGE) != 0) {
      fail(path_, "cannot replace: " + std::generic_category().message(errno));
    }
    committed_ = true;
    fs::remove_all(working_path_, code);
  } else {
    fs::rename(working_path_, path_, code);
    if (code) fail(path_, "cannot write: " + code.message());
    committed_ = true;
  }
}

}  // namespace hallway::record
