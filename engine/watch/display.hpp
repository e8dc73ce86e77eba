// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "watch/grid.hpp"
#include "watch/layers.hpp"
#include "watch/past.hpp"
#include "watch/player.hpp"
#include "watch/scene.hpp"
#include "watch/view.hpp"

namespace hallway::watch {

/// How a display begins.
struct DisplayOptions {
  Dots dots = Dots::kBraille;
  double speed = 1.0;        ///< seconds of the robot's time in a second
  bool can_restart = false;  ///< whether older moments come again, as they do from a log
};

/// A run as it is watched: takes moments and keys, and draws pages. It knows no terminal and no clock.
class Display {
 public:
  Display(Scene scene, const DisplayOptions& options);

  /// Takes the moment after the last one. The first one, and each that the player shows, is drawn by draw().
  void add(const Moment& moment);
  /// More is known of the scene.
  void set_scene(Scene scene) { scene_ = std::move(scene); }
  Player& player() { return player_; }
  const View& view() const { return view_; }
  /// What keeps the view from going on, for the title; empty: nothing.
  void set_note(std::string note) { note_ = std::move(note); }

  /// Does what a key means. @return false if the view is to be closed
  bool press(int key);
  Grid draw(int width, int height);

 private:
  void keep_in_view();

  Scene scene_;
  Past past_;
  Player player_;
  View view_;
  ShownLayers layers_;
  Dots dots_;
  bool fits_ = true;  ///< everything is shown, whatever the size of the page
  bool follows_ = false;
  bool shows_help_ = false;
  std::string note_{};
};

}  // namespace hallway::watch
