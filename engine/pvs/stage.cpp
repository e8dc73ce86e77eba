// SPDX-License-Identifier: MIT
#include "pvs/stage.hpp"

namespace hallway::pvs {

void Stage::add(std::size_t items) {
  if (!report_) return;
  const std::lock_guard lock(mutex_);
  if (stopped_) return;
  done_ += items;
  const double share = static_cast<double>(done_) / static_cast<double>(items_);
  const std::size_t thousandths =
      first_ + static_cast<std::size_t>(static_cast<double>(last_ - first_) * share);
  if (thousandths <= reported_) return;
  reported_ = thousandths;
  try {
    report_(thousandths, kWhole);
  } catch (...) {
    stopped_ = true;
    throw;
  }
}

}  // namespace hallway::pvs
