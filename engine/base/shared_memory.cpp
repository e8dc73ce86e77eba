// SPDX-License-Identifier: MIT
#include "base/shared_memory.hpp"

#include <fcntl.h>
#include <linux/futex.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

#include <cerrno>
#include <climits>
#include <system_error>

#include "base/error.hpp"
#include "base/spawn.hpp"

#ifndef F_SEAL_FUTURE_WRITE
#define F_SEAL_FUTURE_WRITE 0x0010
#endif

namespace hallway {
namespace {

[[noreturn]] void fail_with(const std::string& what) {
  throw Error(ErrorCode::kIo, what + ": " + std::generic_category().message(errno));
}

}  // namespace

SharedMemory::SharedMemory(const std::string& name, std::size_t bytes, Writers writers) : size_(bytes) {
  fd_ = ::memfd_create(name.c_str(), MFD_CLOEXEC | MFD_ALLOW_SEALING);
  if (fd_ < 0 || !move_above_standard(fd_)) fail_with("cannot make shared memory");
  try {
    if (::ftruncate(fd_, static_cast<off_t>(bytes)) != 0) fail_with("cannot make shared memory");
    map(true);
    // Before 5.1 the kernel does not know how to keep the others from writing; the size is sealed in any case.
    if (writers == Writers::kCreator) ::fcntl(fd_, F_ADD_SEALS, F_SEAL_FUTURE_WRITE);
    if (::fcntl(fd_, F_ADD_SEALS, F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_SEAL) != 0) {
      fail_with("cannot seal shared memory");
    }
  } catch (...) {
    if (data_ != nullptr) ::munmap(data_, size_);
    ::close(fd_);
    throw;
  }
}

SharedMemory::SharedMemory(int fd, bool writable) : fd_(fd) {
  try {
    struct stat facts {};
    if (::fstat(fd_, &facts) != 0) fail_with("cannot see shared memory");
    size_ = static_cast<std::size_t>(facts.st_size);
    map(writable);
  } catch (...) {
    ::close(fd_);
    throw;
  }
}

void SharedMemory::map(bool writable) {
  void* at = ::mmap(nullptr, size_, writable ? PROT_READ | PROT_WRITE : PROT_READ, MAP_SHARED, fd_, 0);
  if (at == MAP_FAILED) fail_with("cannot map shared memory");
  data_ = static_cast<std::byte*>(at);
}

SharedMemory::~SharedMemory() {
  ::munmap(data_, size_);
  ::close(fd_);
}

void futex_wait(const FutexWord& word, std::uint32_t value, std::chrono::nanoseconds limit) noexcept {
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(limit);
  const timespec time{static_cast<time_t>(seconds.count()), static_cast<long>((limit - seconds).count())};
  ::syscall(SYS_futex, &word, FUTEX_WAIT, value, &time, nullptr, 0);
}

void futex_wake(const FutexWord& word) noexcept {
  ::syscall(SYS_futex, &word, FUTEX_WAKE, INT_MAX, nullptr, nullptr, 0);
}

}  // namespace hallway
