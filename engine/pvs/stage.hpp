// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <mutex>

namespace hallway::pvs {

/// Part of the work, for the report of progress in thousandths of the whole. May be used from several
/// threads.
class Stage {
 public:
  using Report = std::function<void(std::size_t done, std::size_t total)>;
  static constexpr std::size_t kWhole = 1000;

  /// @param report  may be empty
  /// @param first   thousandths done at its begin
  /// @param last    thousandths done at its end
  /// @param items   amount of work
  Stage(const Report& report, std::size_t first, std::size_t last, std::size_t items)
      : report_(report), first_(first), last_(last), items_(items), reported_(first) {}

  /// Says that `items` more are done. Whatever the report throws passes through, and stopped() is true from
  /// then on.
  void add(std::size_t items);
  bool stopped() const { return stopped_; }

 private:
  const Report& report_;
  std::size_t first_;
  std::size_t last_;
  std::size_t items_;
  std::mutex mutex_;
  std::size_t done_ = 0;
  std::size_t reported_;
  std::atomic<bool> stopped_ = false;
};

}  // namespace hallway::pvs
