// SPDX-License-Identifier: MIT
#include "base/spill_list.hpp"

#include <fcntl.h>
#include <stdlib.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "base/error.hpp"
#include "base/text.hpp"

namespace hallway {
namespace {

[[noreturn]] void fail_unlisted(const std::string& folder, const char* what, int error_number) {
  throw Error(ErrorCode::kIo,
              std::string(what) + " records of the run: " + std::generic_category().message(error_number),
              {.file = folder});
}

}  // namespace

UnlistedFile::UnlistedFile(const std::filesystem::path& folder) : name_(printable(folder.string())) {
  std::string name = (folder / ".records-XXXXXX").string();
  fd_ = ::mkostemp(name.data(), O_CLOEXEC);
  if (fd_ < 0) fail_unlisted(name_, "cannot keep", errno);
  ::unlink(name.c_str());
}

UnlistedFile::~UnlistedFile() {
  ::close(fd_);
}

void UnlistedFile::write(std::uint64_t offset, const void* bytes, std::size_t count) {
  const auto* from = static_cast<const char*>(bytes);
  while (count > 0) {
    const ssize_t done = ::pwrite(fd_, from, count, static_cast<off_t>(offset));
    if (done < 0 && errno == EINTR) continue;
    if (done < 0) fail_unlisted(name_, "cannot keep", errno);
    from += done;
    offset += static_cast<std::uint64_t>(done);
    count -= static_cast<std::size_t>(done);
  }
}

void UnlistedFile::read(std::uint64_t offset, void* bytes, std::size_t count) const {
  auto* to = static_cast<char*>(bytes);
  while (count > 0) {
    const ssize_t done = ::pread(fd_, to, count, static_cast<off_t>(offset));
    if (done < 0 && errno == EINTR) continue;
    if (done <= 0) fail_unlisted(name_, "cannot read", done < 0 ? errno : EIO);
    to += done;
    offset += static_cast<std::uint64_t>(done);
    count -= static_cast<std::size_t>(done);
  }
}

}  // namespace hallway
