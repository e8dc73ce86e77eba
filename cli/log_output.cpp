// SPDX-License-Identifier: MIT
#include "log_output.hpp"

#include <unistd.h>

#include <utility>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/text.hpp"

namespace hallway::cli {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& path, const std::string& message) {
  throw Error(ErrorCode::kIo, message, {.file = printable(path.string())});
}

void check_free(const fs::path& path, bool replace) {
  std::error_code code;
  const fs::file_status status = fs::status(path, code);
  if (status.type() == fs::file_type::not_found) return;
  if (status.type() != fs::file_type::regular) fail(path, "is there already and is not a regular file");
  if (!replace) fail(path, "is there already; --force replaces it");
}

}  // namespace

NewFile::NewFile(fs::path path, bool replace) : path_(std::move(path)) {
  check_free(path_, replace);
  if (!path_.parent_path().empty()) make_folder(path_.parent_path());
  beside_ = path_.string() + ".part-" + std::to_string(::getpid());
  output_ = std::make_unique<log::FileOutput>(beside_);
}

NewFile::~NewFile() {
  if (!committed_) ::unlink(beside_.c_str());
}

void NewFile::commit() {
  std::error_code code;
  fs::rename(beside_, path_, code);
  if (code) fail(path_, "cannot write: " + code.message());
  committed_ = true;
}

}  // namespace hallway::cli
