// SPDX-License-Identifier: MIT
#pragma once

#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <vector>

namespace hallway::pvs {

/// Hands out ranks 0, 1, … to threads such that who works on a rank may use the results of all ranks below
/// `usable(rank)`, and of no others: then what it uses does not depend on the number of threads or on their
/// speed.
class RankWindow {
 public:
  /// @param count   number of ranks
  /// @param window  how many ranks before its own a rank does not use; so many may be under way at once
  RankWindow(std::size_t count, std::size_t window) : count_(count), window_(window), finished_(count) {}

  /// The ranks below this one are finished when claim() hands out `rank`.
  std::size_t usable(std::size_t rank) const { return rank < window_ ? 0 : rank - window_; }
  /// The next rank, once what it may use is finished; the number of ranks if there is none left or after
  /// stop().
  std::size_t claim();
  /// Says that a rank that was handed out is finished; what its thread wrote before is seen by threads that
  /// use it.
  void finish(std::size_t rank);
  /// Makes every claim(), also those that wait, end the work.
  void stop();

 private:
  std::size_t count_;
  std::size_t window_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<bool> finished_;
  std::size_t next_ = 0;
  std::size_t all_finished_below_ = 0;
  bool stopped_ = false;
};

}  // namespace hallway::pvs
