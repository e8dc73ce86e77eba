// SPDX-License-Identifier: MIT
#include "host/text_parameter.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <system_error>

#include "base/text.hpp"
#include "host/plugin_table.hpp"

namespace hallway::host {
namespace {

namespace fs = std::filesystem;

class PathValue {
 public:
  PathValue(const Parameter& parameter, const fs::path& path) : parameter_(parameter), path_(path) {}

  void require_file() const {
    if (is_missing() && parameter_.writable) make_file();
    std::error_code problem;
    if (fs::is_directory(path_, problem)) refuse("is a folder and not a file");
    if (!fs::exists(path_, problem)) refuse("there is no such file");
    if (::access(path_.c_str(), parameter_.writable ? R_OK | W_OK : R_OK) != 0) refuse(reason());
  }

  void require_folder() const {
    if (is_missing() && parameter_.writable) make_folder();
    std::error_code problem;
    if (!fs::exists(path_, problem)) refuse("there is no such folder");
    if (!fs::is_directory(path_, problem)) refuse("is no folder");
  }

 private:
  bool is_missing() const {
    std::error_code problem;
    return !fs::exists(fs::symlink_status(path_, problem));
  }

  void make_file() const {
    const int fd = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (fd < 0 && errno != EEXIST) fail(ErrorCode::kIo, "cannot be made: " + reason());
    if (fd >= 0) ::close(fd);
  }

  void make_folder() const {
    std::error_code problem;
    fs::create_directory(path_, problem);
    if (problem) fail(ErrorCode::kIo, "cannot be made: " + problem.message());
  }

  static std::string reason() { return std::generic_category().message(errno); }
  [[noreturn]] void refuse(const std::string& what) const { fail(ErrorCode::kBadInput, what); }
  [[noreturn]] void fail(ErrorCode code, const std::string& what) const {
    throw Error(
        code, fmt::format("parameter `{}`: `{}` {}", parameter_.name, printable(path_.string(), 4096), what));
  }

  const Parameter& parameter_;
  const fs::path& path_;
};

fs::path absolute_path(std::string_view text, const Where& where) {
  return fs::absolute(beside(where.file, std::string(text), where.line)).lexically_normal();
}

}  // namespace

std::string text_parameter_value(const Parameter& parameter, std::string_view text, const Where& where) {
  const auto check_length = [&](std::size_t bytes) {
    if (bytes < HW_PARAM_TEXT_BYTES) return;
    throw Error(ErrorCode::kBadInput, fmt::format("parameter `{}`: {} bytes are too many, {} at most",
                                                  parameter.name, bytes, HW_PARAM_TEXT_BYTES - 1));
  };
  check_length(text.size());
  if (text.find('\0') != std::string_view::npos)
    throw Error(ErrorCode::kBadInput, fmt::format("parameter `{}`: has a zero byte", parameter.name));
  if (!parameter.is_path() || text.empty()) return std::string(text);
  const fs::path path = absolute_path(text, where);
  check_length(path.string().size());
  const PathValue value(parameter, path);
  parameter.default_value.type == HW_PARAM_FILE ? value.require_file() : value.require_folder();
  return path.string();
}

}  // namespace hallway::host
