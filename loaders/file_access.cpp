// SPDX-License-Identifier: MIT
#include "loaders/file_access.hpp"

#include <algorithm>
#include <system_error>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/text.hpp"

namespace hallway::loaders {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxRefused = 100;
constexpr std::size_t kMaxNameBytes = 4096;

[[noreturn]] void fail(ErrorCode code, const std::string& message, std::string_view name) {
  throw Error(code, message, {.file = printable(name, kMaxNameBytes)});
}

fs::path canonical_or_throw(const fs::path& path, const char* what) {
  std::error_code problem;
  fs::path found = fs::canonical(path, problem);
  if (problem) throw Error(ErrorCode::kIo, std::string(what) + ": " + problem.message());
  return found;
}

bool is_inside(const fs::path& path, const fs::path& root) {
  const auto [rest, unused] = std::mismatch(root.begin(), root.end(), path.begin(), path.end());
  return rest == root.end();
}

/// "http:", "file:", "c:": letters, digits, +, -, . and then a colon, before any slash.
bool has_scheme(std::string_view name) {
  const std::size_t end = name.find_first_of(":/");
  return end != std::string_view::npos && name[end] == ':';
}

}  // namespace

FileAccess::FileAccess(const fs::path& root, const fs::path& model, std::uint64_t byte_limit)
    : root_(canonical_or_throw(root, "the folder that it may read from cannot be opened")),
      model_(canonical_or_throw(model, "cannot open")),
      bytes_left_(byte_limit) {
  if (!is_inside(model_, root_))
    throw Error(ErrorCode::kIo, "lies outside the folder that it may be read from");
}

fs::path FileAccess::resolve(std::string_view name) const {
  if (name.empty() || name.size() > kMaxNameBytes || name.find('\0') != std::string_view::npos)
    fail(ErrorCode::kBadInput, "is no file name", name);
  if (name.front() == '/')
    fail(ErrorCode::kBadInput, "is named by the model, and refused: it is an absolute path", name);
  if (has_scheme(name))
    fail(ErrorCode::kBadInput, "is named by the model, and refused: it is no relative path", name);
  std::error_code problem;
  const fs::path joined = model_.parent_path() / name;
  // Without links resolved first, so that nothing is said about what exists elsewhere.
  if (!is_inside(joined.lexically_normal(), root_))
    fail(ErrorCode::kBadInput, "is named by the model, and refused: it lies outside the folder", name);
  const fs::path path = fs::canonical(joined, problem);
  if (problem) fail(ErrorCode::kIo, "is named by the model and cannot be opened: " + problem.message(), name);
  if (!is_inside(path, root_))
    fail(ErrorCode::kBadInput, "is named by the model, and refused: it leads outside the folder", name);
  return path;
}

std::string FileAccess::read_path(const fs::path& path) {
  std::string content = read_file(path, bytes_left_);
  bytes_left_ -= content.size();
  files_.insert(path.lexically_relative(root_).string());
  return content;
}

std::string FileAccess::read_model() {
  try {
    return read_path(model_);
  } catch (const Error& error) {
    throw Error(error.code(), error.message());
  }
}

std::string FileAccess::read(std::string_view name) {
  try {
    return read_path(resolve(name));
  } catch (const Error& error) {
    if (error.code() == ErrorCode::kBadInput && refused_.size() < kMaxRefused)
      refused_.push_back("`" + printable(name) + "` " + error.message());
    throw Error(ErrorCode::kIo, error.message(), {.file = printable(name, kMaxNameBytes)});
  }
}

bool FileAccess::exists(std::string_view name) const {
  try {
    std::error_code problem;
    return fs::is_regular_file(resolve(name), problem);
  } catch (const Error&) {
    return false;
  }
}

}  // namespace hallway::loaders
