// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace hallway::em {

/// Threads that share the items of a loop. Which thread takes which item is left to chance, so an item writes only to
/// what is its own, or its worker's as scratch; then the result is the same for any number of threads.
class Workers {
 public:
  /// `worker` counts the threads, 0 is the caller's: no two items with the same one run at a time.
  using Task = std::function<void(std::size_t item, std::size_t worker)>;

  /// Starts `threads` - 1 threads, or as many as the system gives; 0: as many threads as this process may use
  /// processors, at most kMostOfItself. They take no signals but those of faults.
  explicit Workers(int threads);
  ~Workers();
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  /// Threads that items may run on, the caller's included.
  std::size_t count() const { return threads_.size() + 1; }

  /// Calls task(item, worker) for each item < items. If items throw, the exception of the first of them, in order, is
  /// rethrown once all have ended. One call at a time, and not from within a task.
  void run(std::size_t items, const Task& task);

  /// Threads at most where the number is left to the machine: more gain little.
  static constexpr int kMostOfItself = 4;

  /// Parts of a loop over `count` points: all of kPart, but for the last one. They do not depend on the threads.
  static constexpr std::size_t kPart = 16384;
  static std::size_t parts(std::size_t count) { return (count + kPart - 1) / kPart; }

  /// Calls task(part, begin, end) for each of the parts.
  template <typename PartTask>
  void run_parts(std::size_t count, const PartTask& task) {
    run(parts(count), [&](std::size_t part, std::size_t) {
      task(part, part * kPart, std::min(count, (part + 1) * kPart));
    });
  }

 private:
  /// One call of run() under way.
  struct Job {
    std::size_t items;
    const Task* task;
    std::size_t next = 0;
    std::size_t failed = 0;  ///< item whose exception is kept
    std::exception_ptr failure;
  };

  void start(std::size_t threads);
  void stop();
  void serve(std::size_t worker);
  void take_items(std::size_t worker, std::unique_lock<std::mutex>& lock);
  bool has_items() const { return job_ != nullptr && job_->next < job_->items; }

  std::mutex mutex_;  ///< guards all below
  std::condition_variable wake_;
  std::condition_variable done_;
  Job* job_ = nullptr;
  std::atomic<std::size_t> busy_ = 0;      ///< threads, but the caller's, that take part in the job
  std::atomic<std::uint64_t> posted_ = 0;  ///< counts the jobs, and the order to stop
  bool stop_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace hallway::em
