// SPDX-License-Identifier: MIT
#include "record/epoch_table.hpp"

#include <algorithm>
#include <map>
#include <string>

#include "base/error.hpp"
#include "base/file.hpp"
#include "log/csv_reader.hpp"
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
  const auto number = [&](const Row& row) {
    const auto into = std::ranges::find_if(
        joined, [&](const log::IdPair& pair) { return first_ + pair.first == row.epoch; });
    return into == joined.end() ? row.epoch : first_ + into->second;
  };
  const bool several = std::any_of(rows_.begin(), rows_.end(),
                                   [&](const Row& row) { return number(row) != number(rows_.front()); });
  if (!several) return;
  std::string text = "iteration,map_epoch\n";
  for (const Row& row : rows_)
    text += std::to_string(row.iteration) + "," + std::to_string(number(row)) + "\n";
  write_file_atomically(folder / files::kMapEpochs, text);
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
