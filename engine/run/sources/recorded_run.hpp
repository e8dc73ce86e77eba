// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "log/mcap_reader.hpp"
#include "run/sources/source.hpp"

namespace hallway::run {

/// A frame of a log, with what the log says is true of it.
struct RecordedFrame {
  std::string bytes;  ///< host/samples/frame_bytes.hpp
  std::int64_t t_ns = 0;
  std::vector<std::uint64_t> elements{};  ///< how many each sample has
  std::vector<log::LandmarkId>
      identities{};  ///< of all elements, in their order; kNoLandmark where none is told
  std::optional<Pose> T_world_body{};
  bool orientation_known = true;
  std::vector<log::SampleTruth> sample_truths{};
  std::optional<log::CommandAnswer> command{};  ///< the drive command that a plugin answered
};

/// What replay needs of an MCAP log.
struct RecordedRun {
  std::optional<nlohmann::ordered_json> manifest;  ///< run.json as known before the first frame
  SourceFacts facts;
  std::int64_t period_ns = 0;  ///< 0 where not known
  std::vector<RecordedFrame> frames;
  std::optional<log::McapDamage> damage;  ///< where reading stopped; what stands before it is here
};

/// Reads a log that LogRecorder has written, up to its end or the first damage: of the file, or of a message that is not what
/// its channel promises. Messages of other channels are passed over. Memory grows with the observations.
/// Throws Error{kBadInput} if it is no MCAP file, and if nothing is damaged but there is no frame channel; Error{kIo}.
RecordedRun read_recorded_run(const log::ByteInput& input);

/// The frames of a recorded log, as they were, samples of any kinds and all: numbered anew from 0, at their recorded times.
class RecordedSource : public Source {
 public:
  /// @param steps  how many frames to give; 0 for all
  RecordedSource(RecordedRun run, std::uint32_t steps);

  std::uint32_t iterations() const override { return iterations_; }

 private:
  void fill(std::uint32_t iteration, SourceFrame& frame) override;

  std::vector<RecordedFrame> frames_;
  std::uint32_t iterations_;
};

}  // namespace hallway::run
