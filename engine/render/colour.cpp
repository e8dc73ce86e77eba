// SPDX-License-Identifier: MIT
#include "render/colour.hpp"

#include <array>
#include <cmath>
#include <string>

namespace hallway::render {
namespace {

struct NamedColour {
  std::string_view word;
  Rgb colour;
};

// The first word that occurs in the name decides, so the specific ones stand before the general ones.
constexpr std::array<NamedColour, 22> kMaterials{
    {{"ceil", {226, 224, 218}},   {"carpet", {176, 186, 196}}, {"tile", {208, 212, 210}},
     {"floor", {222, 212, 194}},  {"ground", {206, 204, 180}}, {"grass", {186, 204, 168}},
     {"door", {190, 158, 120}},   {"wood", {198, 166, 126}},   {"desk", {204, 172, 132}},
     {"table", {204, 172, 132}},  {"shelf", {188, 156, 122}},  {"cabinet", {170, 178, 172}},
     {"brick", {204, 150, 128}},  {"stone", {184, 182, 176}},  {"concrete", {196, 195, 190}},
     {"glass", {178, 208, 216}},  {"metal", {166, 176, 186}},  {"plaster", {232, 226, 214}},
     {"pillar", {200, 190, 178}}, {"column", {200, 190, 178}}, {"water", {166, 196, 214}},
     {"wall", {230, 224, 212}}}};

constexpr std::array<Rgb, 8> kOtherMaterials{{{220, 208, 188},
                                              {196, 206, 192},
                                              {194, 206, 216},
                                              {216, 198, 196},
                                              {204, 200, 214},
                                              {212, 214, 196},
                                              {190, 204, 202},
                                              {224, 214, 204}}};

std::string lower_case(std::string_view text) {
  std::string out(text);
  for (char& c : out) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return out;
}

std::uint32_t name_hash(std::string_view name) {
  std::uint32_t hash = 2166136261u;
  for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 16777619u;
  return hash;
}

std::uint8_t channel(double value) {
  return static_cast<std::uint8_t>(std::lround(value));
}

}  // namespace

Rgb mix(Rgb a, Rgb b, double weight) {
  const auto one = [weight](std::uint8_t x, std::uint8_t y) { return channel(x + weight * (y - x)); };
  return {one(a.r, b.r), one(a.g, b.g), one(a.b, b.b)};
}

Rgb material_colour(std::string_view material) {
  const std::string name = lower_case(material);
  for (const NamedColour& known : kMaterials) {
    if (name.find(known.word) != std::string::npos) return known.colour;
  }
  return kOtherMaterials[name_hash(name) % kOtherMaterials.size()];
}

Rgb submap_colour(std::size_t index) {
  // The golden ratio spreads any number of consecutive hues evenly around the circle.
  const double turns = static_cast<double>(index % 65536) * 0.61803398874989485 + 0.52;
  const double hue = 6.0 * (turns - std::floor(turns));
  constexpr double kHigh = 196.0;
  constexpr double kLow = 62.0;
  const double part = hue - std::floor(hue);
  const double rise = kLow + (kHigh - kLow) * part;
  const double fall = kHigh - (kHigh - kLow) * part;
  const auto rgb = [](double r, double g, double b) { return Rgb{channel(r), channel(g), channel(b)}; };
  switch (static_cast<int>(hue)) {
    case 0:
      return rgb(kHigh, rise, kLow);
    case 1:
      return rgb(fall, kHigh * 0.86, kLow);
    case 2:
      return rgb(kLow, kHigh * 0.8, rise);
    case 3:
      return rgb(kLow, fall, kHigh);
    case 4:
      return rgb(rise, kLow, kHigh);
    default:
      return rgb(kHigh, kLow, fall);
  }
}

}  // namespace hallway::render
