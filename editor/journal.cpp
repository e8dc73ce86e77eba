// SPDX-License-Identifier: MIT
#include "editor/journal.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string_view>
#include <utility>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/hash.hpp"
#include "base/text.hpp"

namespace hallway::editor {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::string_view kFormat = "hallway.journal/1\n";
constexpr std::size_t kChecksum = 32;  ///< hexadecimal digits

[[noreturn]] void fail(const fs::path& path, const std::string& what, int error) {
  throw Error(ErrorCode::kIo, what + ": " + std::strerror(error), {path.string(), 0, {}});
}

std::string line_of(const Json& record, const std::string& previous, const std::string& bytes,
                    std::string& checksum) {
  const std::string text = record.dump();
  checksum = content_hash(previous + text + bytes);
  return checksum + ' ' + text + '\n' + bytes;
}

/// One line of a journal's text.
struct Line {
  Json record;
  std::string checksum;
  std::string bytes;
  std::size_t end = 0;
};

/// The line that begins at `at`; none if it is cut off or damaged.
std::optional<Line> line_at(std::string_view text, std::size_t at, const std::string& previous) {
  const std::size_t end = text.find('\n', at);
  if (end == std::string_view::npos || end - at < kChecksum + 1) return std::nullopt;
  const std::string_view json = text.substr(at + kChecksum + 1, end - at - kChecksum - 1);
  Line line{Json::parse(json, nullptr, false), std::string(text.substr(at, kChecksum)), {}, end + 1};
  if (!line.record.is_object()) return std::nullopt;
  if (line.record.contains("bytes")) {
    if (!line.record["bytes"].is_number_unsigned()) return std::nullopt;
    const auto bytes = line.record["bytes"].get<std::uint64_t>();
    if (bytes > text.size() - line.end) return std::nullopt;
    line.bytes = text.substr(line.end, bytes);
    line.end += bytes;
  }
  if (content_hash(previous + std::string(json) + line.bytes) != line.checksum) return std::nullopt;
  return line;
}

}  // namespace

Journal::Journal(fs::path path) : path_(std::move(path)) {
  open_and_lock();
  try {
    if (file_ >= 0) read(read_file(path_));
  } catch (...) {
    ::close(file_);
    throw;
  }
}

Journal::~Journal() {
  // An empty journal says nothing; it is there because it was locked.
  if (writable() && size_ == 0) ::unlink(path_.c_str());
  if (file_ >= 0) ::close(file_);
}

void Journal::open_and_lock() {
  for (;;) {
    file_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0666);
    refusal_ = file_ < 0 ? errno : 0;
    // What cannot be changed can still be looked at.
    if (refusal_ == EACCES || refusal_ == EROFS || refusal_ == EPERM)
      file_ = ::open(path_.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
    if (file_ < 0 && refusal_ != 0 && errno == ENOENT) return;
    if (file_ < 0) fail(path_, "the journal cannot be opened", errno);
    struct stat opened {};
    struct stat named {};
    if (::fstat(file_, &opened) != 0 || !S_ISREG(opened.st_mode)) {
      ::close(file_);
      throw Error(ErrorCode::kIo, "the journal is not a regular file", {path_.string(), 0, {}});
    }
    if (::flock(file_, (writable() ? LOCK_EX : LOCK_SH) | LOCK_NB) != 0) {
      ::close(file_);
      throw Error(ErrorCode::kIo, "the map is open in another editor", {path_.string(), 0, {}});
    }
    // Between opening and locking it another process may have put a new file in its place, or removed it.
    if (::stat(path_.c_str(), &named) == 0 && named.st_ino == opened.st_ino && named.st_dev == opened.st_dev)
      return;
    ::close(file_);
  }
}

Journal::Reading Journal::read_text(const std::string& text, const fs::path& path) {
  Reading reading;
  // What begins as the first line does and ends in it was cut off while the journal was made.
  if (kFormat.starts_with(text)) return reading;
  if (!std::string_view(text).starts_with(kFormat)) {
    throw Error(ErrorCode::kBadInput, "this is no journal of Hallway's", {path.string(), 1, {}});
  }
  reading.bytes = kFormat.size();
  while (reading.bytes < text.size()) {
    auto line = line_at(text, reading.bytes, reading.checksum);
    if (!line) break;
    reading.checksum = std::move(line->checksum);
    if (reading.records.empty()) reading.base = std::move(line->bytes);
    reading.records.push_back(std::move(line->record));
    reading.bytes = line->end;
  }
  return reading;
}

void Journal::read(const std::string& text) {
  Reading reading = read_text(text, path_);
  // Only the end can have been cut off; whatever follows a damaged line was acknowledged.
  const std::size_t line_end = text.find('\n', reading.bytes);
  if (line_end != std::string::npos && line_end + 1 != text.size()) {
    throw Error(ErrorCode::kBadInput,
                "the journal is damaged here; `hallway edit MAP recover to=FILE` writes what stands before",
                {path_.string(), static_cast<int>(reading.records.size()) + 2, {}});
  }
  bytes_dropped_ = text.size() - reading.bytes;
  size_ = reading.bytes;
  checksum_ = std::move(reading.checksum);
  records_ = std::move(reading.records);
  base_ = std::move(reading.base);
  if (bytes_dropped_ > 0 && writable() && ::ftruncate(file_, static_cast<off_t>(size_)) != 0) {
    fail(path_, "the journal's end cannot be repaired", errno);
  }
}

void Journal::check_writable() const {
  if (!writable()) fail(path_, "nothing can be changed here, as the journal cannot be written", refusal_);
}

void Journal::start(Json first, std::string base) {
  check_writable();
  if (!base.empty()) first["bytes"] = base.size();
  std::string checksum;
  const std::string text = std::string(kFormat) + line_of(first, {}, base, checksum);
  write_file_atomically(path_, text);
  // The new file is another one than that which is locked.
  const int old = file_;
  open_and_lock();
  ::close(old);
  size_ = text.size();
  checksum_ = std::move(checksum);
  records_.assign(1, std::move(first));
  base_ = std::move(base);
}

void Journal::append(const Json& record) {
  check_writable();
  std::string checksum;
  const std::string line = line_of(record, checksum_, {}, checksum);
  try {
    write_all(line);
    if (::fsync(file_) != 0) fail(path_, "the journal cannot be written", errno);
  } catch (const Error&) {
    // A later record must not stand behind half a one. If this fails too, the next opening mends it.
    [[maybe_unused]] const int mended = ::ftruncate(file_, static_cast<off_t>(size_));
    throw;
  }
  size_ += line.size();
  checksum_ = std::move(checksum);
  records_.push_back(record);
}

void Journal::write_all(const std::string& text) {
  std::size_t done = 0;
  while (done < text.size()) {
    const auto count =
        ::pwrite(file_, text.data() + done, text.size() - done, static_cast<off_t>(size_ + done));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) fail(path_, "the journal cannot be written", count < 0 ? errno : EIO);
    done += static_cast<std::size_t>(count);
  }
}

}  // namespace hallway::editor
