// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace hallway::log {

/// Bytes that can be read at any place.
class ByteInput {
 public:
  virtual ~ByteInput() = default;
  /// Number of bytes.
  virtual std::uint64_t size() const = 0;
  /// Replaces `out` by `count` bytes from `offset`, which lie within size(). Throws Error{kIo}, also if the bytes have
  /// gone meanwhile.
  virtual void read(std::uint64_t offset, std::uint64_t count, std::string& out) const = 0;
};

/// A text in memory, which must live as long as this.
class MemoryInput : public ByteInput {
 public:
  explicit MemoryInput(std::string_view bytes) : bytes_(bytes) {}
  std::uint64_t size() const override { return bytes_.size(); }
  void read(std::uint64_t offset, std::uint64_t count, std::string& out) const override;

 private:
  std::string_view bytes_;
};

/// A regular file; its size is that at the moment of opening.
class FileInput : public ByteInput {
 public:
  /// Throws Error{kIo} if it cannot be opened or is a folder, a pipe or a device.
  explicit FileInput(const std::filesystem::path& path);
  ~FileInput() override;
  FileInput(const FileInput&) = delete;
  FileInput& operator=(const FileInput&) = delete;
  std::uint64_t size() const override { return size_; }
  void read(std::uint64_t offset, std::uint64_t count, std::string& out) const override;

 private:
  std::string name_;
  int fd_ = -1;
  std::uint64_t size_ = 0;
};

/// Where bytes go, one after the other.
class ByteOutput {
 public:
  virtual ~ByteOutput() = default;
  /// Appends all of `bytes`. Throws Error{kIo}.
  virtual void write(std::string_view bytes) = 0;
  /// Keeps `bytes` for the case that there is no next write(): they follow what was written and what was kept since. write() drops what was
  /// kept. Throws Error{kIo}.
  virtual void keep(std::string_view bytes) = 0;
  /// No more is written; what was written stands safely. Throws Error{kIo}.
  virtual void close() = 0;
};

/// A text that grows.
class StringOutput : public ByteOutput {
 public:
  void write(std::string_view bytes) override { text_ += bytes, kept_.clear(); }
  void keep(std::string_view bytes) override { kept_ += bytes; }
  void close() override {}
  const std::string& text() const { return text_; }
  const std::string& kept() const { return kept_; }

 private:
  std::string text_;
  std::string kept_;
};

/// A new file. What write() and keep() were given survives the end of the program, however it ends; close() also makes what was written
/// survive that of the machine. What is kept stands in a file beside it, its tail, until close(); UnfinishedInput reads both.
class FileOutput : public ByteOutput {
 public:
  /// Throws Error{kIo} if it cannot be made or is there already.
  explicit FileOutput(const std::filesystem::path& path);
  ~FileOutput() override;
  FileOutput(const FileOutput&) = delete;
  FileOutput& operator=(const FileOutput&) = delete;
  void write(std::string_view bytes) override;
  void keep(std::string_view bytes) override;
  void close() override;

 private:
  void drop_kept();

  std::string name_;
  std::filesystem::path tail_path_;
  int fd_ = -1;
  int tail_fd_ = -1;  ///< made when it is first needed
  std::uint64_t written_ = 0;
  bool has_kept_ = false;
};

/// Where a FileOutput keeps what is not written yet: "run.mcap.tail". Its layout is in docs/formats.md.
std::filesystem::path tail_path(const std::filesystem::path& path);

/// What a tail file begins with, and how many bytes stand before what is kept: these, and the number of bytes of the file (u64).
inline constexpr std::string_view kTailMagic{"HWTAIL1\n", 8};
inline constexpr std::uint64_t kTailHead = 16;

}  // namespace hallway::log
