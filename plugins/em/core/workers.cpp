// SPDX-License-Identifier: MIT
#include "em/core/workers.hpp"

#include <signal.h>

#include <chrono>
#include <system_error>

namespace hallway::em {
namespace {

/// While it lives, this thread, and those that it starts, take no signals but those of faults: all others are for the
/// threads of the program.
class WithoutSignals {
 public:
  WithoutSignals() {
    sigset_t all;
    sigfillset(&all);
    for (const int fault : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGSYS, SIGTRAP})
      sigdelset(&all, fault);
    pthread_sigmask(SIG_SETMASK, &all, &before_);
  }
  ~WithoutSignals() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  WithoutSignals(const WithoutSignals&) = delete;
  WithoutSignals& operator=(const WithoutSignals&) = delete;

 private:
  sigset_t before_;
};

/// A thread that goes to sleep is awake again after about as long: between the loops of one cloud it looks out for so long first.
constexpr std::chrono::microseconds kLookOut{50};

/// Waits, without sleeping, until `done` or for kLookOut. Other threads that want to run go first.
template <typename Done>
void look_out_for(const Done& done) {
  const auto until = std::chrono::steady_clock::now() + kLookOut;
  while (!done() && std::chrono::steady_clock::now() < until) std::this_thread::yield();
}

int threads_of_machine() {
  return std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, Workers::kMostOfItself);
}

}  // namespace

Workers::Workers(int threads) {
  if (threads == 0) threads = threads_of_machine();
  if (threads < 2) return;
  try {
    start(static_cast<std::size_t>(threads) - 1);
  } catch (const std::system_error&) {
    // Fewer threads are slower, and all that changes.
  } catch (...) {
    stop();
    throw;
  }
}

Workers::~Workers() {
  stop();
}

void Workers::start(std::size_t threads) {
  const WithoutSignals without_signals;
  threads_.reserve(threads);
  for (std::size_t worker = 1; worker <= threads; ++worker) {
    threads_.emplace_back([this, worker] { serve(worker); });
  }
}

void Workers::stop() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
    ++posted_;
  }
  wake_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void Workers::run(std::size_t items, const Task& task) {
  if (threads_.empty() || items < 2) {
    for (std::size_t item = 0; item < items; ++item) task(item, 0);
    return;
  }
  Job job{items, &task, 0, items, nullptr};
  std::unique_lock lock(mutex_);
  job_ = &job;
  ++posted_;
  wake_.notify_all();
  take_items(0, lock);
  job_ = nullptr;  // who wakes only now goes to sleep again
  const auto all_done = [this] { return busy_ == 0; };
  if (!all_done()) {
    lock.unlock();
    look_out_for(all_done);
    lock.lock();
  }
  done_.wait(lock, all_done);
  if (job.failure) std::rethrow_exception(job.failure);
}

void Workers::serve(std::size_t worker) {
  std::unique_lock lock(mutex_);
  for (;;) {
    if (!stop_ && !has_items()) {
      const std::uint64_t seen = posted_;
      lock.unlock();
      look_out_for([this, seen] { return posted_ != seen; });
      lock.lock();
    }
    wake_.wait(lock, [this] { return stop_ || has_items(); });
    if (stop_) return;
    ++busy_;
    take_items(worker, lock);
    if (--busy_ == 0) done_.notify_one();
  }
}

void Workers::take_items(std::size_t worker, std::unique_lock<std::mutex>& lock) {
  Job& job = *job_;
  while (job.next < job.items) {
    const std::size_t item = job.next++;
    lock.unlock();
    std::exception_ptr failure;
    try {
      (*job.task)(item, worker);
    } catch (...) {
      failure = std::current_exception();
    }
    lock.lock();
    if (failure && item < job.failed) {
      job.failed = item;
      job.failure = failure;
    }
  }
}

}  // namespace hallway::em
