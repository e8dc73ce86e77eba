// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "watch/display.hpp"
#include "watch/line_mode.hpp"
#include "watch_terminal.hpp"

namespace hallway::cli {

/// How to watch.
struct WatchStyle {
  double speed =
      0.0;  ///< seconds of the robot's time in a second; 0: 1 in a terminal, as fast as possible in lines
  bool lines = false;      ///< lines although there is a terminal
  std::string dots{};      ///< `braille`, `blocks`, `ascii`; empty: what the terminal shows
  bool to_stderr = false;  ///< lines go to standard error, since standard output has a document
  bool quiet = false;      ///< no lines
};

/// Shows moments to a person: in a terminal, or where there is none in lines.
class Screen {
 public:
  /// What is to be done next.
  enum class Next {
    kNewer,  ///< add() the moment after the last one, or end()
    kOlder,  ///< restart(), and all moments again
    kLeave,  ///< the view is closed: by the person, by Ctrl-C, or because everything was shown
  };

  /// Opens the terminal. Call catch_interrupts() before.
  /// @param can_restart  whether older moments come again
  Screen(watch::Scene scene, const WatchStyle& style, bool can_restart);

  void add(const watch::Moment& moment);
  void end();
  /// Shows what is left, when it is time, and then that the rest is being written. Keys are taken again by next().
  Next show_last();
  void restart();
  void set_mapped(const watch::Scene& scene);
  /// Shows, takes keys and waits, until something is to be done.
  Next next();
  /// Gives the terminal back.
  void close() { terminal_.reset(); }
  /// Whether moments are drawn in a terminal.
  bool is_open() const { return terminal_ != nullptr; }

 private:
  void pace(std::int64_t t_ns);
  void draw(std::int64_t now_ns);

  WatchStyle style_;
  std::unique_ptr<Terminal> terminal_;  ///< null: lines
  watch::Scene scene_;
  std::unique_ptr<watch::Display> display_;
  watch::LineMode lines_;
  bool ended_ = false;
  bool is_last_ = false;  ///< next() ends when the last moment is shown
  bool is_dirty_ = true;
  std::int64_t drawn_ns_ = 0;
  std::int64_t start_ns_ = 0;  ///< of the lines' pace
  std::int64_t first_ns_ = 0;
};

}  // namespace hallway::cli
