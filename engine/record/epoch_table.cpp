// SPDX-License-Identifier: MIT
#include "record/epoch_table.hpp"

#include <algorithm>
#include <map>
#include <string>

#include "base/error.hpp"
#include "base/file.hpp"
#include "log/csv_reader.hpp"
#include "log/row_file.hpp"
#include "record/files.hpp"

namespace hallway::record {
namespace {

constexpr std::uint64_t kMostEpoch = std::uint64_t{1}
                                     << 62;  // a plugin counts to 2^53, and anew after each restart

}  // namespace

std::optional<std::uint64_t> EpochTable::add(std::uint32_t iteration, const host::Outputs& outputs) {
  if (!outputs.pose() || !outputs.pose()->valid) return std::nullopt;
  own_ = outputs.map_epoch().value_or(own_);
  const std::uint64_t epoch = first_ + own_;
  largest_ = std::max(largest_, epoch);
  rows_.push_back({iteration, epoch});
  return epoch;
}

void EpochTable::restart() {
  first_ = rows_.empty() ? 0 : largest_ + 1;
  own_ = 0;
}

void EpochTable::write(const std::filesystem::path& folder, std::span<const log::IdPair> joined) const {
  if (rows_.empty()) return;
  std::map<std::uint64_t, std::uint64_t> merged;
  for (const log::IdPair& pair : joined) merged.try_emplace(first_ + pair.first, first_ + pair.second);
  const auto number = [&](const Row& row) {
    const auto into = merged.find(row.epoch);
    return into == merged.end() ? row.epoch : into->second;
  };
  const std::uint64_t first = number(rows_[0]);
  bool several = false;
  SpillList<Row>::Reader seen(rows_);
  for (const Row* row = seen.next(); row != nullptr && !several; row = seen.next())
    several = number(*row) != first;
  if (!several) return;
  log::RowFile file(folder / files::kMapEpochs, ',', "iteration,map_epoch");
  SpillList<Row>::Reader rows(rows_);
  while (const Row* row = rows.next()) file.next_row().whole(row->iteration).whole(number(*row)).end_row();
  file.close();
}

std::size_t keep_scored_part(const std::filesystem::path& folder, std::vector<log::StampedPose>& trajectory) {
  const std::filesystem::path file = folder / files::kMapEpochs;
  std::error_code none;
  if (!std::filesystem::exists(file, none)) return 0;
  const std::string text = read_file(file);
  log::CsvReader rows(text, file.string(), {{"iteration"}, {"map_epoch"}});
  std::vector<std::uint64_t> epochs;
  std::map<std::uint64_t, std::size_t> counts;
  while (rows.next()) {
    epochs.push_back(rows.whole(1, kMostEpoch));
    ++counts[epochs.back()];
  }
  if (epochs.size() != trajectory.size())
    throw Error(ErrorCode::kBadInput, "has not as many rows as the trajectory has poses",
                {.file = file.string()});
  if (epochs.empty()) return 0;
  std::uint64_t scored = epochs.front();
  for (const std::uint64_t epoch : epochs) {
    if (counts[epoch] > counts[scored]) scored = epoch;
  }
  std::vector<log::StampedPose> kept;
  for (std::size_t i = 0; i < epochs.size(); ++i) {
    if (epochs[i] == scored) kept.push_back(trajectory[i]);
  }
  const std::size_t left_out = trajectory.size() - kept.size();
  trajectory = std::move(kept);
  return left_out;
}

}  // namespace hallway::record
