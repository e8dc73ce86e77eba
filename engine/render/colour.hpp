// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace hallway::render {

/// An opaque colour, 8 bits per channel, sRGB.
struct Rgb {
  std::uint8_t r = 0, g = 0, b = 0;
  friend bool operator==(const Rgb&, const Rgb&) = default;
};

/// The colours that mean something in every picture of Hallway. The pair truth/estimate and the pair truth/error stay
/// apart for all common kinds of colour blindness (after Okabe and Ito, "Color Universal Design").
namespace palette {
inline constexpr Rgb kPaper{250, 248, 243};     ///< background
inline constexpr Rgb kInk{38, 43, 51};          ///< text
inline constexpr Rgb kMutedInk{112, 118, 128};  ///< secondary text, frame
inline constexpr Rgb kCut{74, 80, 92};          ///< solids cut open by View::cut_z_m
inline constexpr Rgb kTruth{0, 104, 168};       ///< true path and landmarks
inline constexpr Rgb kEstimate{213, 94, 0};     ///< estimated path and landmarks
inline constexpr Rgb kError{170, 34, 90};       ///< lines from truth to estimate
inline constexpr Rgb kSensor{0, 136, 105};      ///< fields of view
}  // namespace palette

/// The colour on the way from `a` (weight 0) to `b` (weight 1).
Rgb mix(Rgb a, Rgb b, double weight);

/// A muted colour for a map material: well-known words in the name (floor, wall, ceiling, door, wood, brick, glass, ...)
/// choose the hue, everything else falls on one of a few quiet colours by the name's hash. Depends on the name alone.
Rgb material_colour(std::string_view material);

/// A hue for the submap of this number; neighbouring numbers are far apart.
Rgb submap_colour(std::size_t index);

}  // namespace hallway::render
