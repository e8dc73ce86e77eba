// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>

#include "log/plane_observations.hpp"
#include "log/row_file.hpp"
#include "record/files.hpp"
#include "record/plane_observations.hpp"
#include "run/feed/frame_feed.hpp"

namespace hallway::run {

/// Writes found_planes.csv: the planes that plugins of a pipeline found for those behind them. There is no file before there is a plane. All functions
/// throw Error{kIo}.
class FoundTable {
 public:
  explicit FoundTable(const std::filesystem::path& folder) : file_(folder / record::files::kFoundPlanes) {}

  /// The answer to a frame; iterations increase.
  void add(const FrameAnswer& answer) {
    for (std::uint32_t k = 0; answer.with_planes != nullptr && k < answer.with_planes->n_samples; ++k) {
      const hw_sample_t& sample = *answer.with_planes->samples[k];
      if (sample.kind != HW_SAMPLE_PLANES) continue;
      const auto& planes = *static_cast<const hw_planes_t*>(sample.payload);
      if (planes.sample == HW_NO_SAMPLE) continue;
      for (std::uint64_t i = 0; i < planes.count; ++i) add_row(answer.iteration, *hw_plane_at(&planes, i));
    }
  }
  /// No more answers come.
  void close() {
    if (rows_) rows_->close();
  }

 private:
  void add_row(std::uint32_t iteration, const hw_plane_t& plane) {
    if (!rows_) rows_.emplace(file_, ',', log::kPlaneColumns);
    log::add_row(rows_->next_row(), log::IterationPlane{iteration, record::plane_observation(plane)});
  }

  std::filesystem::path file_;
  std::optional<log::RowFile> rows_;
};

}  // namespace hallway::run
