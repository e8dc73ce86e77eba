// SPDX-License-Identifier: MIT
#include "log/byte_io.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

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

FileOutput::FileOutput(const std::filesystem::path& path) : name_(printable(path.string())) {
  fd_ = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (fd_ < 0) fail(name_, "cannot write", errno);
}

FileOutput::~FileOutput() {
  if (fd_ >= 0) ::close(fd_);
}

void FileOutput::write(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(fd_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail(name_, "cannot write", errno);
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

void FileOutput::close() {
  if (::fsync(fd_) != 0) fail(name_, "cannot write", errno);
  const int fd = fd_;
  fd_ = -1;
  if (::close(fd) != 0) fail(name_, "cannot write", errno);
}

}  // namespace hallway::log
