// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace hallway::editor {

/// An append-only file of records beside a map: `NAME.map.journal`.
///
/// The first line names the format; each further line is a checksum, a blank and one JSON object. A checksum covers the checksum
/// before it, so that a line that is missing, changed or exchanged is seen. The first record may be followed by raw bytes (its
/// key `bytes` says how many), which its checksum covers.
///
/// append() returns when the record is on the disk. One process has a journal open at a time.
class Journal {
 public:
  /// Opens or makes the journal and reads its records. A last line that was cut off while it was written is removed: nobody was told
  /// that it is there. Where folder or journal may not be written, what is there is read, and only that. Throws Error{kIo} where another process has it open (naming its process number) or the file cannot be
  /// used, and Error{kBadInput} naming the line where something else than the end is damaged.
  explicit Journal(std::filesystem::path path);
  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  const std::vector<nlohmann::ordered_json>& records() const { return records_; }
  /// The raw bytes behind the first record.
  const std::string& base() const { return base_; }
  /// How many bytes of a record that was never acknowledged were removed by the constructor.
  std::size_t bytes_dropped() const { return bytes_dropped_; }

  /// Whether start() and append() may work; else they throw Error{kIo} with the reason.
  bool writable() const { return refusal_ == 0; }

  /// Starts anew with this first record and its bytes; what was there is gone. The new file takes the old one's place at once.
  void start(nlohmann::ordered_json first, std::string base);
  /// Adds a record behind all others. Throws Error{kIo}; the record then counts as not written, and is taken back where the disk
  /// allows it.
  void append(const nlohmann::ordered_json& record);

  const std::filesystem::path& path() const { return path_; }

  /// What a journal's text holds up to its first damage.
  struct Reading {
    std::vector<nlohmann::ordered_json> records{};
    std::string base{};
    std::string checksum{};  ///< of the last record
    std::size_t bytes = 0;   ///< of the text that was read; less than its size where the rest is damaged
  };
  /// Throws Error{kBadInput} for a text that is no journal.
  static Reading read_text(const std::string& text, const std::filesystem::path& path);

 private:
  void open_and_lock();
  void check_writable() const;
  void read(const std::string& text);
  void write_all(const std::string& text);

  std::filesystem::path path_;
  int file_ = -1;
  int refusal_ = 0;       ///< errno of the attempt to open it for writing
  std::string checksum_;  ///< of the last line
  std::uint64_t size_ = 0;
  std::vector<nlohmann::ordered_json> records_;
  std::string base_;
  std::size_t bytes_dropped_ = 0;
};

}  // namespace hallway::editor
