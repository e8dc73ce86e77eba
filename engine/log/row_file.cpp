// SPDX-License-Identifier: MIT
#include "log/row_file.hpp"

namespace hallway::log {
namespace {

constexpr std::size_t kBufferedBytes = 1u << 16;

}  // namespace

RowFile::RowFile(const std::filesystem::path& path, char separator, std::string_view header)
    : file_(path), rows_(separator) {
  if (!header.empty()) rows_.word(header).end_row();
}

RowWriter& RowFile::next_row() {
  if (rows_.size() >= kBufferedBytes) file_.write(rows_.take());
  return rows_;
}

void RowFile::close() {
  file_.write(rows_.take());
  file_.close();
}

}  // namespace hallway::log
