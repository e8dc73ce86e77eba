// SPDX-License-Identifier: MIT
#include "log/byte_io.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "base/bytes.hpp"
#include "base/error.hpp"
#include "base/text.hpp"

namespace hallway::log {
namespace {

[[noreturn]] void fail(const std::string& file, const std::string& message) {
  throw Error(ErrorCode::kIo, message, {.file = file});
}

[[noreturn]] void fail(const std::string& file, const std::string& what, int error_number) {
  fail(file, what + ": " + std::generic_category().message(error_number));
}

void write_all(int fd, std::string_view bytes, const std::string& name) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(fd, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail(name, "cannot write", errno);
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

}  // namespace

void MemoryInput::read(std::uint64_t offset, std::uint64_t count, std::string& out) const {
  out.assign(bytes_.substr(offset, count));
}

FileInput::FileInput(const std::filesystem::path& path) : name_(printable(path.string())) {
  // O_NONBLOCK: opening a pipe without a writer must not wait for ever.
  fd_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (fd_ < 0) fail(name_, "cannot open", errno);
  struct stat info {};
  const bool known = ::fstat(fd_, &info) == 0;
  if (known && S_ISREG(info.st_mode)) {
    size_ = static_cast<std::uint64_t>(info.st_size);
    return;
  }
  ::close(fd_);
  fail(name_, known && S_ISDIR(info.st_mode) ? "is a folder, not a file" : "is not a regular file");
}

FileInput::~FileInput() {
  ::close(fd_);
}

void FileInput::read(std::uint64_t offset, std::uint64_t count, std::string& out) const {
  out.resize(count);
  std::uint64_t done = 0;
  while (done < count) {
    const ssize_t got = ::pread(fd_, out.data() + done, count - done, static_cast<off_t>(offset + done));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) fail(name_, "cannot read", errno);
    if (got == 0) fail(name_, "became shorter while it was read");
    done += static_cast<std::uint64_t>(got);
  }
}

std::filesystem::path tail_path(const std::filesystem::path& path) {
  return path.string() + ".tail";
}

FileOutput::FileOutput(const std::filesystem::path& path)
    : name_(printable(path.string())), tail_path_(tail_path(path)) {
  fd_ = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (fd_ < 0) fail(name_, "cannot write", errno);
}

FileOutput::~FileOutput() {
  if (fd_ >= 0) ::close(fd_);
  if (tail_fd_ >= 0) ::close(tail_fd_);
}

void FileOutput::write(std::string_view bytes) {
  write_all(fd_, bytes, name_);
  written_ += bytes.size();
  drop_kept();
}

void FileOutput::keep(std::string_view bytes) {
  if (tail_fd_ < 0) {
    tail_fd_ =
        ::open(tail_path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_APPEND | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (tail_fd_ < 0) fail(printable(tail_path_.string()), "cannot write", errno);
  }
  std::string all;
  if (!has_kept_) {
    all = kTailMagic;
    ByteAppender(all).put(written_);
  }
  all += bytes;  // in one call, so that no head stands there alone
  write_all(tail_fd_, all, printable(tail_path_.string()));
  has_kept_ = true;
}

/// After the write that makes it needless, so that at any moment one of the two is there.
void FileOutput::drop_kept() {
  if (!has_kept_) return;
  if (::ftruncate(tail_fd_, 0) != 0) fail(printable(tail_path_.string()), "cannot write", errno);
  has_kept_ = false;
}

void FileOutput::close() {
  if (::fsync(fd_) != 0) fail(name_, "cannot write", errno);
  if (tail_fd_ >= 0) {
    ::close(std::exchange(tail_fd_, -1));
    ::unlink(tail_path_.c_str());
  }
  if (::close(std::exchange(fd_, -1)) != 0) fail(name_, "cannot write", errno);
}

}  // namespace hallway::log
