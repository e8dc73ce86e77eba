// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>

#include "log/byte_io.hpp"

namespace hallway::log {

/// A file and, where its FileOutput did not come to close() it, what that kept for the case: read as one. Where the file stands alone, and where
/// it holds what was kept already, the file alone.
class UnfinishedInput : public ByteInput {
 public:
  /// Throws Error{kIo} if the file cannot be opened or is a folder, a pipe or a device. A tail that cannot be read is none.
  explicit UnfinishedInput(const std::filesystem::path& path);
  std::uint64_t size() const override { return size_; }
  void read(std::uint64_t offset, std::uint64_t count, std::string& out) const override;

  /// Bytes of the file itself that are read; what follows was kept.
  std::uint64_t written() const { return written_; }

 private:
  std::string open_tail(const std::filesystem::path& path);
  bool is_superseded(std::uint64_t before) const;

  FileInput file_;
  std::optional<FileInput> tail_;
  std::uint64_t written_;
  std::uint64_t size_;
};

}  // namespace hallway::log
