// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/sample.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "host/samples/frame_bytes.hpp"
#include "host/stage.hpp"
#include "log/mcap_reader.hpp"

namespace hallway::robot {

/// The frames of an .mcap log, one after the other, in memory that does not grow with the log.
class RecordedFrames {
 public:
  /// Reads the facts that stand before the first frame. Throws Error{kIo}; Error{kBadInput} if it is no log of Hallway's.
  explicit RecordedFrames(const std::filesystem::path& file);

  /// What its plugins were given once.
  const host::Activation& activation() const { return activation_; }
  std::int64_t period_ns() const { return period_ns_; }

  /// The next frame, null at the end. With `again` it goes on with the first one after the last: numbers and times are moved so that they
  /// increase. Valid until the next call. Throws Error{kBadInput} at damage, Error{kIo}.
  const hw_frame_t* next(bool again);

 private:
  void begin();
  const hw_frame_t* read();
  void read_activation(const std::string& text);
  const hw_frame_t& moved(const hw_frame_t& frame);

  std::string name_;
  log::FileInput input_;
  std::unique_ptr<log::McapReader> reader_;
  host::FrameReader frame_reader_;
  host::Activation activation_;
  bool described_ = false;
  std::int64_t period_ns_ = 0;
  const hw_frame_t* first_ = nullptr;  ///< read together with the facts and not yet given

  std::uint64_t round_frames_ = 0;  ///< given of this round
  std::uint64_t sequence_shift_ = 0;
  std::int64_t t_shift_ns_ = 0;
  hw_frame_t last_{};  ///< given last, without its samples
  std::int64_t last_step_ns_ = 0;
  hw_frame_t frame_{};
  std::vector<hw_sample_t> samples_;
  std::vector<const hw_sample_t*> pointers_;
};

}  // namespace hallway::robot
