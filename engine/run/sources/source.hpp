// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "eval/floor_plan.hpp"
#include "geometry/se3.hpp"
#include "host/plugin.hpp"
#include "host/samples/frame_builder.hpp"
#include "host/samples/frame_bytes.hpp"
#include "log/drive_tables.hpp"
#include "log/landmark_id.hpp"
#include "log/landmarks.hpp"
#include "log/run_log.hpp"
#include "log/surface_label.hpp"
#include "log/true_planes.hpp"
#include "sim/driven_robot.hpp"

namespace hallway::run {

/// One frame of input: its samples, as plugins get them, and, for the evaluator alone, what is true. Memory is used again for the next one.
class SourceFrame {
 public:
  /// Begins a frame whose samples are made here, and forgets the one before with all that was true of it.
  host::FrameBuilder& begin(std::uint32_t iteration, std::int64_t t_ns);
  /// Takes a frame from its bytes, which must live as long, and forgets the one before. Throws as host::FrameReader does.
  void take(std::span<const std::byte> bytes);
  /// All samples have been added. Source::read() does this.
  void finish();

  /// The samples, nothing of what is true.
  const hw_frame_t& samples() const { return *samples_; }
  std::int64_t t_ns() const { return samples_->t_ns; }
  std::uint32_t n_samples() const { return samples_->n_samples; }
  const hw_sample_t& sample(std::uint32_t k) const { return *samples_->samples[k]; }
  /// The frame as bytes (host/samples/frame_bytes.hpp), which are written once; valid until the next frame. Throws as host::FrameWriter does.
  std::span<const std::byte> bytes() const;
  /// How many elements a sample has; 0 for kinds that are not known.
  std::uint64_t elements_of(std::uint32_t k) const;
  /// How many elements all samples have.
  std::uint64_t n_elements() const;

  /// Which true landmark or plane each element of all samples is of, in their order; kNoLandmark for none. Empty where that is not known.
  std::vector<log::LandmarkId> identities;
  /// Those of one sample.
  std::span<const log::LandmarkId> identities_of(std::uint32_t k) const;
  std::vector<log::SampleTruth>
      sample_truths;  ///< what is true of samples beside that, by sample; none where nothing is
  std::optional<Pose> T_world_body;  ///< at the time of the frame, where known
  bool orientation_known = true;     ///< false: only the position of T_world_body is meant
  std::optional<log::CommandAnswer>
      recorded_command;  ///< of a log: the drive command that was answered to it then

 private:
  void forget();

  host::FrameBuilder builder_;
  host::FrameReader reader_;
  const hw_frame_t* samples_ = nullptr;  ///< null while samples are added
  mutable host::FrameWriter writer_;
  mutable std::vector<std::byte> written_;
  mutable std::span<const std::byte> bytes_;  ///< empty: not written yet
};

/// What is known of a source beside its frames.
struct SourceFacts {
  std::vector<host::SensorInfo> sensors{};  ///< of distinct ids
  std::optional<host::DriveInfo> drive{};   ///< where the robot's is known
  std::optional<host::BodyInfo> body{};     ///< likewise
  bool has_identities = false;              ///< whether frames have identities
  bool has_tracks = false;                  ///< whether a sensor follows its points in any frame
  std::optional<std::vector<log::Landmark>> true_landmarks{};  ///< world, where that is known
  std::optional<std::vector<log::TruePlane>> true_planes{};    ///< likewise
  std::vector<log::SurfaceLabel> labels{};  ///< of what returns of lidars are of, where any has them
  std::vector<log::EventRow> events{};      ///< what is made to happen, by time; known beforehand
};

/// What a drive obeyed and what its robot touched.
struct DriveNotes {
  std::vector<log::ObeyedCommand> commands{};
  std::vector<log::ContactRow> contacts{};  ///< before the frame that was read last
};

/// Where a run's input comes from: a simulator or a log. A frame is a pure function of its number, or, in a closed loop, of that and of what was obeyed
/// before it.
class Source {
 public:
  explicit Source(SourceFacts facts = {}) : facts_(std::move(facts)) {}
  virtual ~Source() = default;

  /// How many frames there are.
  virtual std::uint32_t iterations() const = 0;
  /// Replaces `frame` by frame `iteration`, below iterations().
  void read(std::uint32_t iteration, SourceFrame& frame) {
    fill(iteration, frame);
    frame.finish();
  }

  /// Whether a frame depends on the answers to those before it: a robot that obeys. Then frames are read in their order, each after obey() for the one before,
  /// and one is under way.
  virtual bool is_closed_loop() const { return false; }
  /// Closed loop: takes the answer to the frame that was read last; once for each.
  virtual void obey(const sim::DriveAnswer&) {}
  /// Closed loop: whether the robot, whose plugins failed, has still to come to rest.
  virtual bool is_moving() const { return false; }
  /// Closed loop: what is new since the last call.
  virtual DriveNotes take_drive_notes() { return {}; }
  /// Closed loop: what the robot did until now.
  virtual std::optional<sim::DriveCounts> drive_counts() const { return std::nullopt; }

  /// The walls at the height of the sensors that follow them, where the world is known.
  virtual std::optional<eval::FloorPlan> floor_plan() const { return std::nullopt; }

  const SourceFacts& facts() const { return facts_; }
  const std::vector<host::SensorInfo>& sensors() const { return facts_.sensors; }
  /// What plugins are given once.
  host::Activation activation() const { return {facts_.sensors, facts_.drive, facts_.body}; }
  /// Whether any sensor gives samples of a kind.
  bool gives(std::uint32_t kind) const;
  bool has_identities() const { return facts_.has_identities; }
  bool has_tracks() const { return facts_.has_tracks; }
  const std::optional<std::vector<log::Landmark>>& true_landmarks() const { return facts_.true_landmarks; }
  const std::optional<std::vector<log::TruePlane>>& true_planes() const { return facts_.true_planes; }

 protected:
  /// Begins or takes the frame, adds its samples, and says what is true of it.
  virtual void fill(std::uint32_t iteration, SourceFrame& frame) = 0;

  SourceFacts facts_;
};

}  // namespace hallway::run
