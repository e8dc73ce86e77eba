// SPDX-License-Identifier: MIT
#include "robot/recorder.hpp"

#include <utility>

#include "record/files.hpp"

namespace hallway::robot {
namespace {

/// At 200 Hz what a disk may stand still is more than half a second.
constexpr std::size_t kQueuedFrames = 128;

}  // namespace

Recorder::Recorder(const std::filesystem::path& folder, const std::optional<record::LogFacts>& log,
                   bool may_wait)
    : folder_(folder), may_wait_(may_wait), tables_(folder), epochs_(folder), queue_(kQueuedFrames) {
  if (log) {
    log_file_.emplace(folder / record::files::kLog);
    log_.emplace(*log_file_, *log);
  }
  thread_ = std::thread([this] { run(); });
}

Recorder::~Recorder() {
  stop();
}

void Recorder::add(FrameRecord& frame) {
  std::unique_lock lock(mutex_);
  if (may_wait_) changed_.wait(lock, [&] { return size_ < queue_.size() || failure_; });
  if (failure_) std::rethrow_exception(failure_);
  if (size_ == queue_.size()) {
    ++unrecorded_;
    return;
  }
  std::swap(queue_[(first_ + size_) % queue_.size()], frame);
  ++size_;
  lock.unlock();
  changed_.notify_all();
}

void Recorder::run() {
  FrameRecord frame;
  for (;;) {
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [&] { return size_ > 0 || over_; });
      if (size_ == 0) return;
      std::swap(frame, queue_[first_]);
      first_ = (first_ + 1) % queue_.size();
      --size_;
    }
    changed_.notify_all();
    try {
      write(frame);
    } catch (...) {
      {
        const std::lock_guard lock(mutex_);
        failure_ = std::current_exception();
      }
      changed_.notify_all();
      return;
    }
  }
}

void Recorder::write(const FrameRecord& frame) {
  if (log_)
    log_->record_frame({.iteration = frame.iteration, .t_ns = frame.t_ns}, frame.n_samples, frame.bytes);
  if (frame.restarts != restarts_) epochs_.restart();
  restarts_ = frame.restarts;
  if (!frame.answered) return;
  if (log_) log_->record_answer(frame.outputs);
  tables_.add({frame.iteration, frame.t_ns, frame.n_samples}, frame.outputs, frame.time);
  epochs_.add(frame.iteration, frame.outputs);
}

void Recorder::stop() {
  {
    const std::lock_guard lock(mutex_);
    over_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void Recorder::finish(record::FinalMap& map) {
  stop();
  if (failure_) std::rethrow_exception(failure_);
  if (log_) {
    log_->record_map(map);
    log_->finish();
  }
  if (!map.topology) map.topology = tables_.topology();
  tables_.close();
  epochs_.write(folder_, map.joined_epochs);
}

}  // namespace hallway::robot
