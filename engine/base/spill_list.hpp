// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

namespace hallway {

/// A file in a folder that is in no listing of it, and gone with this. All functions throw Error{kIo}, naming the folder.
class UnlistedFile {
 public:
  explicit UnlistedFile(const std::filesystem::path& folder);
  ~UnlistedFile();
  UnlistedFile(const UnlistedFile&) = delete;
  UnlistedFile& operator=(const UnlistedFile&) = delete;

  void write(std::uint64_t offset, const void* bytes, std::size_t count);
  /// Bytes that were written.
  void read(std::uint64_t offset, void* bytes, std::size_t count) const;

 private:
  std::string name_;
  int fd_ = -1;
};

/// A list that spills to disk: all but the newest records are in an unlisted file of a folder, so that memory does not grow with it. Without a folder
/// it stays in memory. Records are written as they are in memory. Functions that add or read throw Error{kIo}, of a full disk too.
template <typename T>
class SpillList {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  SpillList() = default;
  /// @param folder  exists while records are added; empty: the list stays in memory
  explicit SpillList(std::filesystem::path folder) : folder_(std::move(folder)) {}

  std::uint64_t size() const { return spilled_ + newest_.size(); }
  bool empty() const { return size() == 0; }
  /// Amortised O(1).
  void push_back(const T& record) {
    if (!folder_.empty() && newest_.size() >= kWindow) spill();
    newest_.push_back(record);
  }
  /// @param i  below size()
  T operator[](std::uint64_t i) const {
    if (i >= spilled_) return newest_[i - spilled_];
    T record;
    file_->read(i * sizeof(T), &record, sizeof record);
    return record;
  }
  /// Replaces a record. @param i  below size()
  void set(std::uint64_t i, const T& record) {
    if (i >= spilled_)
      newest_[i - spilled_] = record;
    else
      file_->write(i * sizeof(T), &record, sizeof record);
  }
  /// Takes all records out.
  void clear() {
    file_.reset();
    spilled_ = 0;
    newest_ = {};
  }

  /// Reads a list from its begin, in memory that does not grow with it. The list outlives it, and does not change meanwhile.
  class Reader {
   public:
    explicit Reader(const SpillList& list) : list_(&list) {}

    /// The next record, there until the next call; null after the last one.
    const T* next() {
      if (at_ >= list_->size()) return nullptr;
      const std::uint64_t i = at_++;
      if (i >= list_->spilled_) return &list_->newest_[i - list_->spilled_];
      const std::size_t place = static_cast<std::size_t>(i % kWindow);
      if (place == 0) {  // what is spilled is whole windows
        window_.resize(kWindow);
        list_->file_->read(i * sizeof(T), window_.data(), kWindow * sizeof(T));
      }
      return &window_[place];
    }

   private:
    const SpillList* list_;
    std::uint64_t at_ = 0;
    std::vector<T> window_;
  };

 private:
  static constexpr std::size_t kWindow = sizeof(T) < (1u << 15) ? (1u << 16) / sizeof(T) : 2;

  void spill() {
    if (!file_) file_ = std::make_unique<UnlistedFile>(folder_);
    file_->write(spilled_ * sizeof(T), newest_.data(), newest_.size() * sizeof(T));
    spilled_ += newest_.size();
    newest_.clear();
  }

  std::filesystem::path folder_;
  std::unique_ptr<UnlistedFile> file_;
  std::uint64_t spilled_ = 0;  ///< records in the file: a multiple of kWindow
  std::vector<T> newest_;
};

}  // namespace hallway
