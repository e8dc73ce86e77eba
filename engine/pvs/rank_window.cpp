// SPDX-License-Identifier: MIT
#include "pvs/rank_window.hpp"

namespace hallway::pvs {

std::size_t RankWindow::claim() {
  std::unique_lock lock(mutex_);
  if (stopped_ || next_ == count_) return count_;
  const std::size_t rank = next_++;
  // Ranks below are under way on other threads or finished, so this ends.
  changed_.wait(lock, [&] { return stopped_ || all_finished_below_ >= usable(rank); });
  return stopped_ ? count_ : rank;
}

void RankWindow::finish(std::size_t rank) {
  const std::lock_guard lock(mutex_);
  finished_[rank] = true;
  while (all_finished_below_ < count_ && finished_[all_finished_below_]) ++all_finished_below_;
  changed_.notify_all();
}

void RankWindow::stop() {
  const std::lock_guard lock(mutex_);
  stopped_ = true;
  changed_.notify_all();
}

}  // namespace hallway::pvs
