// SPDX-License-Identifier: MIT
#include "watch/display.hpp"

#include <algorithm>
#include <utility>

#include "watch/keys.hpp"
#include "watch/page.hpp"

namespace hallway::watch {
namespace {

constexpr double kZoom = 1.25;
constexpr double kPan = 0.2;
constexpr double kSkip_s = 10.0;
/// What is shown when the robot is first followed, and everything was shown before [m].
constexpr double kFollowed_m = 8.0;

}  // namespace

Display::Display(Scene scene, const DisplayOptions& options)
    : scene_(std::move(scene)),
      player_(options.speed, options.can_restart),
      layers_(scene_),
      dots_(options.dots) {}

void Display::add(const Moment& moment) {
  past_.add(moment);
  player_.add(moment);
}

bool Display::press(int key) {
  if (layers_.toggle(key)) return true;
  const auto action = action_of(key);
  if (!action) return true;
  const auto move = [&](double right, double up) {
    fits_ = follows_ = false;
    view_.pan(kPan * Vec2(right, up));
  };
  const auto zoom = [&](double factor) {
    fits_ = false;
    view_.zoom(factor);
  };
  switch (*action) {
    case Action::kLeave:
      return false;
    case Action::kPause:
      player_.toggle_pause();
      break;
    case Action::kStep:
      player_.step(1);
      break;
    case Action::kStepBack:
      player_.step(-1);
      break;
    case Action::kFaster:
      player_.change_speed(2.0);
      break;
    case Action::kSlower:
      player_.change_speed(0.5);
      break;
    case Action::kAhead:
      player_.skip(kSkip_s);
      break;
    case Action::kBack:
      player_.skip(-kSkip_s);
      break;
    case Action::kFirst:
      player_.go_to_first();
      break;
    case Action::kLast:
      player_.go_to_last();
      break;
    case Action::kFollow:
      follows_ = !follows_;
      if (follows_ && fits_) view_.zoom(std::max(view_.extent_m().x() / kFollowed_m, 1.0));
      fits_ = fits_ && !follows_;
      break;
    case Action::kFit:
      fits_ = true;
      follows_ = false;
      break;
    case Action::kZoomIn:
      zoom(kZoom);
      break;
    case Action::kZoomOut:
      zoom(1.0 / kZoom);
      break;
    case Action::kLeft:
      move(-1.0, 0.0);
      break;
    case Action::kRight:
      move(1.0, 0.0);
      break;
    case Action::kUp:
      move(0.0, 1.0);
      break;
    case Action::kDown:
      move(0.0, -1.0);
      break;
    case Action::kDots:
      dots_ = dots_ == Dots::kBraille  ? Dots::kBlocks
              : dots_ == Dots::kBlocks ? Dots::kAscii
                                       : Dots::kBraille;
      break;
    case Action::kHelp:
      shows_help_ = !shows_help_;
      break;
  }
  return true;
}

/// Without a map, what is known of the world is where the robot was.
void Display::keep_in_view() {
  const Moment& moment = *player_.shown();
  const auto pose = pose_shown(moment, past_.place(moment.iteration));
  if (follows_ && pose) view_.look_at(pose->t.head<2>());
}

Grid Display::draw(int width, int height) {
  if (player_.shown() == nullptr) return text_page(width, height, scene_.name + ": no frame yet");
  const Area canvas = layout_of(std::max(width, kLeastWidth), std::max(height, kLeastHeight)).canvas;
  if (fits_) {
    Eigen::AlignedBox2d box = scene_.bounds();
    if (box.isEmpty()) {
      for (const PastPlace& place : past_.places(player_.shown()->iteration)) {
        if (place.truth) box.extend(*place.truth);
        if (place.estimate) box.extend(Vec2(place.estimate->t.head<2>()));
      }
      if (!box.isEmpty()) box = Eigen::AlignedBox2d(box.min() - Vec2(2.0, 2.0), box.max() + Vec2(2.0, 2.0));
    }
    view_.fit(box, canvas.width, canvas.height);
  } else {
    view_.resize(canvas.width, canvas.height);
  }
  keep_in_view();
  return draw_page(width, height, {scene_, past_, *player_.shown()},
                   {player_, view_, layers_, dots_, follows_, shows_help_, note_});
}

}  // namespace hallway::watch
