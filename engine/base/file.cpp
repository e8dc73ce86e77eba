// SPDX-License-Identifier: MIT
#include "base/file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>

#include "base/error.hpp"
#include "base/text.hpp"

namespace hallway {
namespace {

/// Between the name that a file will have and the number of the process that writes it.
constexpr std::string_view kUnfinished = ".tmp-";

/// Owns a file descriptor.
class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const { return fd_; }
  /// Closes now, so that an error of the last write is seen.
  bool close_now() {
    const int fd = fd_;
    fd_ = -1;
    return ::close(fd) == 0;
  }

 private:
  int fd_;
};

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& what, int error_number) {
  throw Error(ErrorCode::kIo, what + ": " + std::generic_category().message(error_number),
              {.file = printable(path.string())});
}

void sync_folder(const std::filesystem::path& folder) {
  const Descriptor fd(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (fd.get() >= 0) ::fsync(fd.get());  // some file systems refuse to sync a folder; the rename still stands
}

void write_all(int fd, std::string_view content, const std::filesystem::path& path) {
  while (!content.empty()) {
    const ssize_t written = ::write(fd, content.data(), content.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail(path, "cannot write", errno);
    content.remove_prefix(static_cast<std::size_t>(written));
  }
}

/// A rename would put a file in the place of a device or a pipe.
void refuse_special_target(const std::filesystem::path& path) {
  struct stat info {};
  if (::stat(path.c_str(), &info) != 0 || S_ISREG(info.st_mode)) return;
  throw Error(ErrorCode::kIo, S_ISDIR(info.st_mode) ? "is a folder, not a file" : "is not a regular file",
              {.file = printable(path.string())});
}

}  // namespace

std::string read_file(const std::filesystem::path& path, std::uint64_t max_bytes) {
  // O_NONBLOCK: opening a pipe without a writer must not wait for ever.
  const Descriptor fd(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (fd.get() < 0) fail(path, "cannot open", errno);
  struct stat info {};
  if (::fstat(fd.get(), &info) != 0) fail(path, "cannot read", errno);
  if (!S_ISREG(info.st_mode)) {
    throw Error(ErrorCode::kIo, S_ISDIR(info.st_mode) ? "is a folder, not a file" : "is not a regular file",
                {.file = printable(path.string())});
  }
  const auto size = static_cast<std::uint64_t>(info.st_size);
  if (size > max_bytes) {
    throw Error(ErrorCode::kIo,
                "is " + std::to_string(size) + " bytes; at most " + std::to_string(max_bytes) + " are read",
                {.file = printable(path.string())});
  }
  std::string content(static_cast<std::size_t>(size), '\0');
  std::size_t done = 0;
  while (done < content.size()) {
    const ssize_t got = ::read(fd.get(), content.data() + done, content.size() - done);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) fail(path, "cannot read", errno);
    if (got == 0) break;
    done += static_cast<std::size_t>(got);
  }
  content.resize(done);
  return content;
}

std::string_view unfinished_file_of(std::string_view name) {
  const std::size_t place = name.rfind(kUnfinished);
  if (place == std::string_view::npos) return {};
  const std::string_view process = name.substr(place + kUnfinished.size());
  const bool number = !process.empty() && process.find_first_not_of("0123456789") == std::string_view::npos;
  return number ? name.substr(0, place) : std::string_view();
}

void write_file_atomically(const std::filesystem::path& path, std::string_view content) {
  refuse_special_target(path);
  const std::filesystem::path beside = path.string() + std::string(kUnfinished) + std::to_string(::getpid());
  try {
    Descriptor fd(::open(beside.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
    if (fd.get() < 0) fail(path, "cannot write", errno);
    write_all(fd.get(), content, path);
    if (::fsync(fd.get()) != 0) fail(path, "cannot write", errno);
    if (!fd.close_now()) fail(path, "cannot write", errno);
    if (::rename(beside.c_str(), path.c_str()) != 0) fail(path, "cannot replace", errno);
  } catch (...) {
    ::unlink(beside.c_str());
    throw;
  }
  const std::filesystem::path folder = path.parent_path();
  sync_folder(folder.empty() ? std::filesystem::path(".") : folder);
}

void make_folder(const std::filesystem::path& path) {
  std::error_code code;
  std::filesystem::create_directories(path, code);
  if (code) fail(path, "cannot make the folder", code.value());
  if (!std::filesystem::is_directory(path, code)) fail(path, "cannot make the folder", ENOTDIR);
}

}  // namespace hallway
