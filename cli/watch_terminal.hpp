// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>

#include "watch/grid.hpp"

namespace hallway::cli {

/// A terminal that shows pages of characters and gives keys. It is whole again when this object is gone, and also when the program is ended by a
/// signal. At most one at a time.
class Terminal {
 public:
  /// Takes the terminal of standard input and output. Call catch_interrupts() before. Null where there is none that can be drawn on: no terminal, TERM unset or
  /// `dumb`, or of a kind that the system does not know.
  /// @param wants_utf8  shows other characters than ASCII although the locale has none
  static std::unique_ptr<Terminal> open(bool wants_utf8);
  ~Terminal();
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  /// Whether it shows other characters than ASCII; others are shown as `?`.
  bool has_utf8() const { return has_utf8_; }
  int width() const;
  int height() const;
  void show(const watch::Grid& grid);
  /// The next key that was pressed (watch/keys.hpp); nothing where there is none. After a change of size it gives kResized.
  std::optional<int> key();
  /// Waits for a key, at most so long; without a limit if negative. A signal ends it.
  void wait(int limit_ms);

  static constexpr int kResized = 2000;

 private:
  struct Curses;
  Terminal(std::unique_ptr<Curses> curses, bool has_utf8);

  std::unique_ptr<Curses> curses_;
  bool has_utf8_;
};

}  // namespace hallway::cli
