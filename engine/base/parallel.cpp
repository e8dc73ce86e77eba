// SPDX-License-Identifier: MIT
#include "base/parallel.hpp"

#include <algorithm>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace hallway {
namespace {

/// One parallel_for under way: chunks are handed out in order, the first exception in order is kept.
struct Job {
  std::size_t count;
  std::size_t grain;
  std::size_t chunks;
  const std::function<void(std::size_t, std::size_t)>* work;
  std::size_t next_chunk = 0;
  std::size_t open_chunks;
  unsigned helpers_wanted;
  std::size_t failed_chunk = SIZE_MAX;
  std::exception_ptr failure;
};

/// Threads that wait for jobs, made when first needed and kept: a frame's work is often shorter than starting a thread.
class Pool {
 public:
  ~Pool() {
    {
      const std::lock_guard lock(mutex_);
      stop_ = true;
    }
    wake_.notify_all();
    for (std::thread& thread : threads_) thread.join();
  }

  void run(Job& job) {
    const std::lock_guard one_job_at_a_time(run_mutex_);
    std::unique_lock lock(mutex_);
    while (threads_.size() < job.helpers_wanted) threads_.emplace_back([this] { serve(); });
    job_ = &job;
    wake_.notify_all();
    take_chunks(job, lock);
    done_.wait(lock, [&] { return job.open_chunks == 0; });
    job_ = nullptr;
  }

 private:
  void serve() {
    std::unique_lock lock(mutex_);
    for (;;) {
      wake_.wait(lock,
                 [&] { return stop_ || (job_ != nullptr && job_->helpers_wanted > 0 && has_chunks(*job_)); });
      if (stop_) return;
      --job_->helpers_wanted;
      take_chunks(*job_, lock);
    }
  }

  static bool has_chunks(const Job& job) { return job.next_chunk < job.chunks; }

  void take_chunks(Job& job, std::unique_lock<std::mutex>& lock) {
    while (has_chunks(job)) {
      const std::size_t chunk = job.next_chunk++;
      lock.unlock();
      std::exception_ptr failure;
      try {
        const std::size_t begin = chunk * job.grain;
        (*job.work)(begin, std::min(job.count, begin + job.grain));
      } catch (...) {
        failure = std::current_exception();
      }
      lock.lock();
      if (failure && chunk < job.failed_chunk) {
        job.failed_chunk = chunk;
        job.failure = failure;
      }
      if (--job.open_chunks == 0) done_.notify_all();
    }
  }

  std::mutex run_mutex_;
  std::mutex mutex_;
  std::condition_variable wake_;
  std::condition_variable done_;
  std::vector<std::thread> threads_;
  Job* job_ = nullptr;
  bool stop_ = false;
};

Pool& pool() {
  static Pool instance;
  return instance;
}

/// True on a thread that is inside a chunk: a nested call then runs its chunks itself instead of waiting for the pool.
thread_local bool inside_chunk = false;

struct InsideChunk {
  InsideChunk() : before(inside_chunk) { inside_chunk = true; }
  ~InsideChunk() { inside_chunk = before; }
  InsideChunk(const InsideChunk&) = delete;
  InsideChunk& operator=(const InsideChunk&) = delete;
  bool before;
};

}  // namespace

void parallel_for(std::size_t count, std::size_t grain, unsigned threads,
                  const std::function<void(std::size_t, std::size_t)>& work) {
  if (count == 0) return;
  grain = std::max<std::size_t>(grain, 1);
  const std::size_t chunks = (count - 1) / grain + 1;
  const std::function<void(std::size_t, std::size_t)> guarded = [&work](std::size_t begin, std::size_t end) {
    const InsideChunk inside;
    work(begin, end);
  };
  Job job{.count = count,
          .grain = grain,
          .chunks = chunks,
          .work = &guarded,
          .open_chunks = chunks,
          .helpers_wanted = static_cast<unsigned>(std::min<std::size_t>(std::max(threads, 1u), chunks)) - 1,
          .failure = nullptr};
  if (inside_chunk || job.helpers_wanted == 0) {
    // The same promise as with threads: every chunk runs, then the first failure in order is thrown.
    for (std::size_t chunk = 0; chunk < chunks; ++chunk) {
      try {
        guarded(chunk * grain, std::min(count, (chunk + 1) * grain));
      } catch (...) {
        if (!job.failure) job.failure = std::current_exception();
      }
    }
  } else {
    pool().run(job);
  }
  if (job.failure) std::rethrow_exception(job.failure);
}

unsigned hardware_threads() {
  return std::max(1u, std::thread::hardware_concurrency());
}

}  // namespace hallway
