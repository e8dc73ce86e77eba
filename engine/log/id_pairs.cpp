// SPDX-License-Identifier: MIT
#include "log/id_pairs.hpp"

#include "base/file.hpp"
#include "log/csv_reader.hpp"
#include "log/row_writer.hpp"

namespace hallway::log {

std::vector<IdPair> parse_id_pairs(std::string_view text, const std::string& file, const IdColumns& columns) {
  CsvReader reader(text, file, {{columns.first}, {columns.second}});
  std::vector<IdPair> pairs;
  while (reader.next()) pairs.push_back({reader.whole(0, UINT64_MAX), reader.whole(1, UINT64_MAX)});
  return pairs;
}

std::vector<IdPair> read_id_pairs(const std::filesystem::path& path, const IdColumns& columns) {
  return parse_id_pairs(read_file(path), path.string(), columns);
}

std::string print_id_pairs(std::span<const IdPair> pairs, const IdColumns& columns) {
  RowWriter writer(',');
  writer.word(columns.first).word(columns.second).end_row();
  for (const IdPair& pair : pairs) writer.whole(pair.first).whole(pair.second).end_row();
  return writer.take();
}

void write_id_pairs(const std::filesystem::path& path, std::span<const IdPair> pairs,
                    const IdColumns& columns) {
  write_file_atomically(path, print_id_pairs(pairs, columns));
}

}  // namespace hallway::log
