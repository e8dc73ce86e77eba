// SPDX-License-Identifier: MIT
#include "run/epoch_table.hpp"

#include <algorithm>
#include <map>

#include "base/error.hpp"
#include "base/file.hpp"
#include "log/csv_reader.hpp"
#include "record/files.hpp"

namespace hallway::run {
namespace {

constexpr std::uint64_t kMostEpoch = std::uint64_t{1} << 53;

}  // namespace

void EpochTable::add(std::uint32_t iteration, const host::Outputs& outputs) {
  if (!outputs.pose() || !outputs.pose()->valid) return;
  const std::uint64_t before = rows_.empty() ? 0 : rows_.back().epoch;
  rows_.push_back({iteration, outputs.map_epoch().value_or(before)});
}

void EpochTable::write(const std::filesystem::path& folder, std::span<const eval::JoinedEpoch> joined) const {
  const auto number = [&](const Row& row) { return eval::final_epoch(row.epoch, joined); };
  const bool several = std::any_of(rows_.begin(), rows_.end(),
                                   [&](const Row& row) { return number(row) != number(rows_.front()); });
  if (!several) return;
  std::string text = "iteration,map_epoch\n";
  for (const Row& row : rows_)
    text += std::to_string(row.iteration) + "," + std::to_string(number(row)) + "\n";
  write_file_atomically(folder / record::files::kMapEpochs, text);
}

std::size_t keep_scored_part(const std::filesystem::path& folder, std::vector<log::StampedPose>& trajectory) {
  const std::filesystem::path file = folder / record::files::kMapEpochs;
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

}  // namespace hallway::run
