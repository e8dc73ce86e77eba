// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "host/load/driver.hpp"
#include "host/pipeline.hpp"
#include "host/plugin_limits.hpp"
#include "host/samples/frame_bytes.hpp"
#include "record/failures.hpp"
#include "robot/arrivals.hpp"
#include "robot/command_timeout.hpp"
#include "robot/gate.hpp"
#include "robot/latency.hpp"
#include "robot/recorder.hpp"
#include "robot/sample_counts.hpp"
#include "robot/schedule.hpp"

namespace hallway::robot {

/// How a loop runs.
struct LoopPlan {
  std::optional<Clock::duration> tick{};      ///< the schedule's, where the loop has one
  std::optional<Clock::duration> deadline{};  ///< for an answer, from its frame or tick; unset: there is none
  std::size_t backlog = 8;           ///< frames that may wait while the plugins are busy; not with a schedule
  std::int64_t report_every_ns = 0;  ///< of the frames' time; 0: the map is not asked for
  std::int64_t command_timeout_ns = 0;  ///< of the frames' time, that a command holds; 0: until the next
  std::optional<Clock::duration> duration{};  ///< after which it ends
  host::OnFailure on_failure = host::OnFailure::kStop;
};

/// What a loop's caller is asked and told.
struct LoopHooks {
  std::function<bool()> stop;                              ///< true ends it in good order
  std::function<void(const std::string& message)> notice;  ///< what people should know at once
};

/// Why a loop ended.
enum class LoopEnd { kDriver, kDuration, kInterrupt, kPlugin };

/// What a loop has done.
struct LoopCounts {
  std::uint32_t iterations = 0;  ///< frames given to the plugins
  std::uint64_t answered = 0;    ///< with an answer, late or not
  std::uint64_t misses = 0;      ///< answers after their deadline
  Latency latency;               ///< from the frame or tick to the answer
};

/// Reads frames from a driver, has them answered by a pipeline and gives the answers to the robot, until it ends. One thread.
class Loop {
 public:
  /// What it works with; all live longer than the loop.
  struct Parts {
    host::Driver& driver;
    const host::RobotInfo& robot;
    host::Pipeline& pipeline;
    Gate& gate;
    Recorder& recorder;
  };

  Loop(const Parts& parts, const LoopPlan& plan, LoopHooks hooks);

  /// Throws what the driver and the recorder throw. The counts, and what was recorded, stand all the same. The driver is read only in here.
  LoopEnd run();

  const LoopCounts& counts() const { return counts_; }
  IntakeCounts intake() const { return arrivals_.counts(); }
  /// How often a command did not hold any longer.
  std::uint64_t command_timeouts() const { return command_timeout_.count(); }
  const SampleCounter& samples() const { return samples_; }
  const record::Failures& failures() const { return failures_; }
  /// The map at the end: refined, as it stands where that fails, empty where the pipeline has failed before.
  record::FinalMap final_map();
  /// Ends the pipeline in good order.
  void close();

 private:
  LoopEnd run_until_end();
  bool take_frame();
  void answer_frame();
  void hand_on(const host::Outputs& outputs, Clock::time_point now);
  void count(Clock::time_point now);
  void after_failure(host::Verdict verdict, std::optional<std::uint32_t> iteration);
  void ask_for_map();
  void tell();
  void add_counters(const host::Outputs& outputs);

  Parts parts_;
  LoopPlan plan_;
  LoopHooks hooks_;
  Arrivals arrivals_;
  std::optional<Schedule> schedule_;
  host::FrameReader reader_;
  Arrival arrival_;
  FrameRecord current_;
  Clock::time_point due_from_{};  ///< what the current frame's deadline counts from
  CommandTimeout command_timeout_;
  bool alive_ = true;
  std::int64_t next_report_ns_ = 0;
  std::optional<std::vector<hw_landmark_t>> map_;  ///< asked for and not yet handed on
  std::vector<hw_counter_t> counters_;
  LoopCounts counts_;
  SampleCounter samples_;
  record::Failures failures_;
  bool told_refusal_ = false;
};

}  // namespace hallway::robot
