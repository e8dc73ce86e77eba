// SPDX-License-Identifier: MIT
#pragma once

#include <condition_variable>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "host/output/outputs.hpp"
#include "host/stage.hpp"
#include "record/answer_recorder.hpp"
#include "record/answer_tables.hpp"
#include "record/epoch_table.hpp"
#include "record/final_map.hpp"

namespace hallway::robot {

/// A frame and what was answered to it.
struct FrameRecord {
  std::uint32_t iteration = 0;
  std::int64_t t_ns = 0;
  std::uint32_t n_samples = 0;
  std::string bytes;           ///< host/samples/frame_bytes.hpp
  std::uint64_t restarts = 0;  ///< of the plugins, before it
  bool answered = false;
  host::Outputs outputs;  ///< of the last frame that was answered
  host::CallTime time{};
};

/// Writes the files of a run on a thread of its own, so that no disk holds up the robot.
class Recorder {
 public:
  /// @param folder  where; the files are not there yet
  /// @param log     facts for run.mcap; unset: no log is written
  /// @param may_wait  true: add() waits while the queue is full. False: what does not fit is not written, and counted
  Recorder(const std::filesystem::path& folder, const std::optional<record::LogFacts>& log, bool may_wait);
  ~Recorder();
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  /// Takes what is in `frame` and leaves memory to be used again in it. Throws what the writing of earlier frames threw.
  void add(FrameRecord& frame);
  /// Waits until everything is written, then the map too, and the files are closed. A map without a topology gets the one that was put last. Nothing is added after it. Throws Error{kIo}.
  void finish(record::FinalMap& map);

  /// How many frames were not written.
  std::uint64_t unrecorded() const { return unrecorded_; }

 private:
  void run();
  void write(const FrameRecord& frame);
  void stop();

  std::filesystem::path folder_;
  bool may_wait_;
  record::AnswerTables tables_;
  record::EpochTable epochs_;
  std::uint64_t restarts_ = 0;  ///< before the last frame that was written
  std::optional<log::FileOutput> log_file_;
  std::optional<record::AnswerRecorder> log_;
  std::uint64_t unrecorded_ = 0;

  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<FrameRecord> queue_;  ///< a ring
  std::size_t first_ = 0;
  std::size_t size_ = 0;
  bool over_ = false;
  std::exception_ptr failure_;
  std::thread thread_;
};

}  // namespace hallway::robot
