// SPDX-License-Identifier: MIT
#include "run/serving/serve.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <nlohmann/json.hpp>
#include <span>
#include <utility>
#include <vector>

#include "eval/metrics_json.hpp"
#include "eval/time_summary.hpp"
#include "record/manifest.hpp"
#include "record/output_folder.hpp"
#include "record/sensor_json.hpp"
#include "run/feed/drive_record.hpp"
#include "run/feed/log_recorder.hpp"
#include "run/feed/truth_tables.hpp"
#include "run/pictures/record.hpp"
#include "run/serving/served_path.hpp"

namespace hallway::run {
namespace {

using Clock = link::RobotEnd::Clock;
using std::chrono::milliseconds;

/// How long one wait is: after it the caller is asked whether to stop.
constexpr milliseconds kSlice{50};
/// For the answer to the last frame in real time.
constexpr milliseconds kLastAnswer{1000};

/// The folder that is written, and the log in it.
class Folder {
 public:
  Folder(const ServePlan& plan, const Source& source)
      : plan_(plan),
        source_(source),
        output_(*plan.folder, plan.replace),
        log_file_(output_.working_path() / files::kLog),
        recorder_(log_file_, source, plan.manifest),
        drive_(output_.working_path(), source),
        truth_(output_.working_path()),
        path_(output_.working_path()) {
    write_attachments(output_.working_path(), plan.attachments);
  }

  void add_frame(std::uint32_t iteration, const SourceFrame& frame) {
    recorder_.record_input(frame);
    truth_.add(iteration, frame);
    path_.add_frame(frame);
  }

  /// What a robot that obeys has done since the last call.
  void add_drive(Source& source) { drive_.update(source, recorder_); }

  /// @param t_ns  of the frame
  void add_answer(const link::Answer& answer, std::int64_t t_ns) {
    path_.add_answer(answer);
    const log::FrameStamp stamp{static_cast<std::uint32_t>(answer.sequence), t_ns};
    if (answer.pose) {
      const hw_pose_t& pose = answer.pose->T_map_body;
      recorder_.writer().add_pose(stamp, {.valid = answer.pose->valid,
                                          .position_m = std::to_array(pose.position),
                                          .orientation = std::to_array(pose.orientation),
                                          .t_ns = answer.pose->t_ns});
    }
    if (answer.command)
      recorder_.writer().add_command(
          stamp, {answer.command->linear_m_s, answer.command->angular_rad_s, answer.command->lateral_m_s});
  }

  void finish(ServeResult& result) {
    recorder_.finish();
    drive_.close();
    const std::filesystem::path& folder = output_.working_path();
    truth_.finish(source_);
    result.drive = source_.drive_counts();
    result.metrics = path_.write(source_, result.drive);
    nlohmann::ordered_json manifest = plan_.manifest;
    manifest["sensors"] = record::print_sensors(source_.sensors());
    manifest["iterations"] = result.frames + result.frames_alone;
    manifest["stopped_early"] = result.end != ServeResult::End::kAllSent;
    manifest["lock_step"] = plan_.lock_step;
    manifest["host"]["serving"] = print_serving(result);
    record::write_json(folder / files::kRun, manifest);
    output_.commit();
  }

 private:
  const ServePlan& plan_;
  const Source& source_;
  record::OutputFolder output_;
  log::FileOutput log_file_;
  LogRecorder recorder_;
  DriveRecord drive_;
  TruthTables truth_;
  ServedPath path_;
};

/// One serving.
class Server {
 public:
  Server(Source& source, link::RobotEnd& robot, const ServePlan& plan, const RunHooks& hooks)
      : source_(source), robot_(robot), plan_(plan), hooks_(hooks) {
    if (plan.folder) folder_.emplace(plan, source);
  }

  ServeResult run() {
    wait_until([this] { return robot_.wanted(); }, Clock::time_point::max());
    for (std::uint32_t k = 0; k < source_.iterations() && !ended(); ++k) {
      send(k);
      take_answers();
      if (plan_.lock_step) obey();
      if (hooks_.progress) hooks_.progress(k + 1);
    }
    if (!plan_.lock_step && result_.frames > 0) {
      wait_until([this] { return answered_[result_.frames - 1]; }, Clock::now() + kLastAnswer);
    }
    take_answers();
    if (!plan_.lock_step && result_.frames > 0) obey();
    note_end();
    go_on_alone();
    robot_.leave();
    take_answers();
    return finish();
  }

 private:
  bool stopped() const { return hooks_.stop && hooks_.stop(); }
  bool ended() const { return robot_.over() || stopped(); }

  template <typename Condition>
  void wait_until(Condition condition, Clock::time_point deadline) {
    while (!ended() && !condition() && Clock::now() < deadline) {
      robot_.wait(std::min(deadline, Clock::now() + kSlice));
      take_answers();
    }
  }

  void send(std::uint32_t k) {
    const bool at_its_time = source_.is_closed_loop() && !plan_.lock_step;
    if (at_its_time) {  // the frame is made when the commands before it have come
      pace(period_ns() * std::int64_t{k});
      if (ended()) return;
      if (k > 0) obey();
    }
    source_.read(k, frame_);
    const std::span<const std::byte> bytes = frame_.bytes();
    if (!plan_.lock_step && !at_its_time) {
      pace(frame_.t_ns());
      if (ended()) return;
    }
    if (folder_) folder_->add_frame(k, frame_);
    times_.push_back(frame_.t_ns());
    answered_.push_back(false);
    commanded_.push_back(false);
    ++result_.frames;
    if (plan_.lock_step) {
      robot_.deliver(k, bytes, [this] { return stopped(); });
    } else {
      robot_.send(k, bytes);
    }
  }

  /// The robot program has gone: a robot that obeys keeps its last command for the watchdog's time, and stops.
  void go_on_alone() {
    if (!folder_ || !source_.is_closed_loop() || !robot_.over() || stopped()) return;
    while (made() < source_.iterations() && source_.is_moving()) {
      source_.read(made(), frame_);
      folder_->add_frame(made(), frame_);
      ++result_.frames_alone;
      obey();
    }
  }

  /// Frames.
  std::uint32_t made() const { return result_.frames + result_.frames_alone; }

  bool was_answered(std::uint32_t frame) const { return frame < answered_.size() && answered_[frame]; }

  std::int64_t period_ns() const { return plan_.manifest.value("period_ns", std::int64_t{0}); }

  /// A robot that obeys takes the newest command that has come since the last call; a command to an older frame than one before it is not taken.
  void obey() {
    if (!source_.is_closed_loop()) return;
    if (robot_.over() && !fresh_.command) fresh_.failed = !was_answered(made() - 1);
    source_.obey(std::exchange(fresh_, {}));
    if (folder_) folder_->add_drive(source_);
  }

  /// Keeps the answer's command for obey().
  void note_command(const link::Answer& answer) {
    if (!answer.command || answer.sequence < newest_) return;
    if (answer.sequence + 1 < times_.size()) ++result_.commands_late;
    newest_ = answer.sequence;
    fresh_.command = drive::Command{.forward_m_s = answer.command->linear_m_s,
                                    .lateral_m_s = answer.command->lateral_m_s,
                                    .angular_rad_s = answer.command->angular_rad_s};
  }

  /// Waits for the time of a frame on the schedule that began with the first one: a late frame makes no other one late.
  void pace(std::int64_t frame_ns) {
    const Clock::time_point now = Clock::now();
    if (times_.empty()) {
      start_ = now;
      return;
    }
    const auto after = [&](std::int64_t t_ns) {
      return start_ + std::chrono::nanoseconds(
                          static_cast<std::int64_t>(static_cast<double>(t_ns - times_.front()) / plan_.rate));
    };
    const Clock::time_point due = after(frame_ns);
    if (now - due >= due - after(times_.back())) ++result_.sent_late;
    wait_until([] { return false; }, due);
  }

  void take_answers() {
    while (const auto came = robot_.next_answer()) {
      const link::Answer& answer = came->answer;
      if (answer.status == HW_ANSWER_END || answer.sequence >= times_.size()) continue;
      const auto k = static_cast<std::uint32_t>(answer.sequence);
      if (answer.status == HW_ANSWER_LATE) ++result_.late;
      if (answer.status == HW_ANSWER_FAILED) ++result_.failed;
      if (note(answered_[k], result_.answered) && came->round_trip)
        round_trips_ms_.push_back(std::chrono::duration<double, std::milli>(*came->round_trip).count());
      if (source_.is_closed_loop()) note_command(answer);
      if (answer.command) note(commanded_[k], result_.commands);
      if (folder_) folder_->add_answer(answer, times_[k]);
    }
  }

  /// Sets a mark of a frame and counts it. @return whether it was not set before
  static bool note(std::vector<bool>::reference mark, std::uint64_t& count) {
    if (mark) return false;
    mark = true;
    ++count;
    return true;
  }

  void note_end() {
    if (result_.frames == source_.iterations() && (!plan_.lock_step || result_.answered == result_.frames)) {
      result_.end = ServeResult::End::kAllSent;
    } else if (robot_.gave_up()) {
      result_.end = ServeResult::End::kSilent;
    } else {
      result_.end = robot_.over() ? ServeResult::End::kLeft : ServeResult::End::kStopped;
    }
  }

  ServeResult finish() {
    result_.round_trip_ms = eval::summarize(std::move(round_trips_ms_));
    result_.counters = robot_.counters();
    if (folder_) folder_->finish(result_);
    return result_;
  }

  Source& source_;
  link::RobotEnd& robot_;
  const ServePlan& plan_;
  const RunHooks& hooks_;
  std::optional<Folder> folder_;
  ServeResult result_;
  SourceFrame frame_;
  sim::DriveAnswer fresh_;           ///< what has come since the robot last obeyed
  std::uint64_t newest_ = 0;         ///< the newest frame that a command came to
  Clock::time_point start_;          ///< when the first frame was sent
  std::vector<std::int64_t> times_;  ///< of the frames that were sent
  std::vector<bool> answered_;       ///< by frame
  std::vector<bool> commanded_;      ///< by frame: whether an answer to it has a command
  std::vector<double> round_trips_ms_;
};

}  // namespace

link::Description describe_robot(const Source& source, const ServePlan& plan, const std::string& name) {
  return {.lock_step = plan.lock_step,
          .period_ns = plan.manifest.value("period_ns", std::int64_t{0}),
          .name = name,
          .sensors = source.sensors(),
          .drive = source.facts().drive,
          .body = source.facts().body};
}

ServeResult serve(Source& source, link::RobotEnd& robot, const ServePlan& plan, const RunHooks& hooks) {
  return Server(source, robot, plan, hooks).run();
}

nlohmann::ordered_json print_serving(const ServeResult& result) {
  const link::RobotCounters& counters = result.counters;
  static constexpr std::array kEnds{"all_sent", "left", "silent", "stopped"};  // in the order of End
  return {{"end", kEnds.at(static_cast<std::size_t>(result.end))},
          {"frames", result.frames},
          {"frames_alone", result.frames_alone},
          {"answered", result.answered},
          {"unanswered", result.frames - result.answered},
          {"answers_late", result.late},
          {"answers_failed", result.failed},
          {"answers_repeated", counters.repeated_answers},
          {"commands", result.commands},
          {"commands_late", result.commands_late},
          {"sent_late", result.sent_late},
          {"datagrams_sent", counters.datagrams},
          {"datagrams_resent", counters.resent},
          {"datagrams_malformed", counters.malformed},
          {"datagrams_foreign", counters.foreign},
          {"round_trip_ms", eval::to_json(result.round_trip_ms)}};
}

}  // namespace hallway::run
