// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace hallway {

/// Memory that two processes have in common: a file without a name (memfd), whose size can never change. Pages that nobody has touched take
/// no memory. It is gone when the last process that maps it is.
class SharedMemory {
 public:
  /// Who else may write.
  enum class Writers { kCreator, kBoth };

  /// Makes `bytes` of zeros. With kCreator nobody that gets the descriptor can map it for writing, where the kernel knows how (5.1).
  /// Throws Error{kIo}.
  SharedMemory(const std::string& name, std::size_t bytes, Writers writers);
  /// Maps what another process has made, for reading alone or for writing too. Takes the descriptor. Throws Error{kIo}.
  SharedMemory(int fd, bool writable);
  ~SharedMemory();
  SharedMemory(const SharedMemory&) = delete;
  SharedMemory& operator=(const SharedMemory&) = delete;

  /// To be given to a program that is started.
  int descriptor() const { return fd_; }
  /// All of it. Writing where it is mapped for reading ends the process.
  std::span<std::byte> bytes() const { return {data_, size_}; }

 private:
  void map(bool writable);

  int fd_ = -1;
  std::byte* data_ = nullptr;
  std::size_t size_ = 0;
};

/// A word in shared memory that one process changes and another waits for.
using FutexWord = std::atomic<std::uint32_t>;
static_assert(sizeof(FutexWord) == 4 && FutexWord::is_always_lock_free);

/// Sleeps while `word` is `value`, at most `limit`. May return early for no reason.
void futex_wait(const FutexWord& word, std::uint32_t value, std::chrono::nanoseconds limit) noexcept;
/// Wakes everybody who sleeps at `word`, in any process. Async-signal-safe.
void futex_wake(const FutexWord& word) noexcept;

}  // namespace hallway
