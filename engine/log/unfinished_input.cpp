// SPDX-License-Identifier: MIT
#include "log/unfinished_input.hpp"

#include <algorithm>

#include "base/bytes.hpp"
#include "base/error.hpp"
#include "log/mcap_records.hpp"

namespace hallway::log {

UnfinishedInput::UnfinishedInput(const std::filesystem::path& path)
    : file_(path), written_(file_.size()), size_(file_.size()) {
  const std::string head = open_tail(tail_path(path));
  if (!head.starts_with(kTailMagic)) return;
  const auto before = load<std::uint64_t>(head.data() + kTailMagic.size());
  if (before > file_.size() || is_superseded(before)) return;
  written_ = before;
  size_ = written_ + (tail_->size() - kTailHead);
}

/// @return its first bytes; empty where there is none that holds anything
std::string UnfinishedInput::open_tail(const std::filesystem::path& path) {
  std::string head;
  try {
    tail_.emplace(path);
    if (tail_->size() > kTailHead) tail_->read(0, kTailHead, head);
  } catch (const Error&) {  // most logs have none
  }
  return head;
}

/// Whether the chunk that makes the tail needless has been written, and its writer did not come to drop the tail.
bool UnfinishedInput::is_superseded(std::uint64_t before) const {
  if (file_.size() - before < kMcapRecordHead) return false;
  std::string head;
  file_.read(before, kMcapRecordHead, head);
  const auto record = parse_record<McapRecordHead>(head);
  return record.op == McapOp::kChunk && record.length <= file_.size() - before - kMcapRecordHead;
}

void UnfinishedInput::read(std::uint64_t offset, std::uint64_t count, std::string& out) const {
  const std::uint64_t from_file = offset < written_ ? std::min(count, written_ - offset) : 0;
  if (from_file == count) return file_.read(offset, count, out);
  std::string rest;
  tail_->read(offset + from_file - written_ + kTailHead, count - from_file, rest);
  out.clear();
  if (from_file > 0) file_.read(offset, from_file, out);
  out += rest;
}

}  // namespace hallway::log
