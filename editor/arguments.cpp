// SPDX-License-Identifier: MIT
#include "editor/arguments.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>
#include <utility>

#include "base/refuse.hpp"
#include "base/text.hpp"
#include "editor/anchor.hpp"

namespace hallway::editor {
namespace {

[[noreturn]] void refuse_word(const ArgSpec& spec, std::string_view word, const std::string& expected) {
  refuse("{}: \"{}\" is {}", spec.name, printable(word), expected);
}

struct Unit {
  std::string_view name;
  double factor;
};

/// The number before a unit's name. None if `word` is no number with one of the units, or none, behind it.
std::optional<double> with_unit(std::string_view word, std::span<const Unit> units) {
  if (const auto plain = parse_double(word)) return *plain;
  for (const Unit& unit : units) {
    if (!word.ends_with(unit.name)) continue;
    if (const auto number = parse_double(word.substr(0, word.size() - unit.name.size())))
      return *number * unit.factor;
  }
  return std::nullopt;
}

std::optional<double> length_of(std::string_view word, const Units& units) {
  const std::array<Unit, 6> known{{{"mm", 0.001},
                                   {"cm", 0.01},
                                   {"m", 1.0},
                                   {"in", 0.0254},
                                   {"ft", 0.3048},
                                   {"u", units.metres_per_unit}}};
  return with_unit(word, known);
}

double in_range(const ArgSpec& spec, std::string_view word, double value) {
  if (value >= spec.low && value <= spec.high) return value;
  refuse_word(spec, word,
              fmt::format("not from {} to {}", format_double(spec.low), format_double(spec.high)));
}

double read_number(const ArgSpec& spec, std::string_view word) {
  const auto number = parse_double(word);
  if (!number) refuse_word(spec, word, "no number");
  return in_range(spec, word, *number);
}

double read_length(const ArgSpec& spec, std::string_view word, const Units& units) {
  const auto length = length_of(word, units);
  if (!length)
    refuse_word(spec, word,
                "no length: a number in metres, or one with a unit (m, cm, mm, in, ft, u for map units)");
  return in_range(spec, word, *length);
}

double read_angle(const ArgSpec& spec, std::string_view word) {
  const std::array<Unit, 2> known{{{"deg", 1.0}, {"rad", 180.0 / std::numbers::pi}}};
  const auto angle = with_unit(word, known);
  if (!angle) refuse_word(spec, word, "no angle: a number in degrees, or one with `deg` or `rad`");
  return in_range(spec, word, *angle) * std::numbers::pi / 180.0;
}

/// "DX,DY" or "DX,DY,DZ".
std::optional<Vec3> lengths_of(std::string_view word, const Units& units) {
  const auto parts = split(word, ',');
  if (parts.size() != 2 && parts.size() != 3) return std::nullopt;
  Vec3 lengths = Vec3::Zero();
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const auto length = length_of(trim(parts[i]), units);
    if (!length) return std::nullopt;
    lengths[static_cast<Eigen::Index>(i)] = *length;
  }
  return lengths;
}

/// "@NAME.ANCHOR", with "+DX,DY[,DZ]" behind it or "-DX,…" for an offset whose first number is negative.
Vec3 read_anchor(const ArgSpec& spec, std::string_view word, const Units& units) {
  if (units.state == nullptr)
    refuse_word(spec, word, "no place: there is no map in which it could be looked up");
  const std::string_view text = word.substr(1);
  // Names may have signs in them: the offset begins at the last one behind which there are two or three lengths.
  for (std::size_t sign = text.find_first_of("+-"); sign != std::string_view::npos;
       sign = text.find_first_of("+-", sign + 1)) {
    const auto offset = lengths_of(text.substr(text[sign] == '+' ? sign + 1 : sign), units);
    if (!offset) continue;
    const Vec3 place = anchor_place(*units.state, text.substr(0, sign)) + *offset;
    for (const double x : place) in_range(spec, word, x);
    return place;
  }
  if (text.find(',') != std::string_view::npos)
    refuse_word(spec, word, "no place: behind an anchor there is +DX,DY[,DZ] or nothing");
  return anchor_place(*units.state, text);
}

Vec3 read_place(const ArgSpec& spec, std::string_view word, const Units& units) {
  const auto place = lengths_of(word, units);
  if (!place) refuse_word(spec, word, "no place: X,Y or X,Y,Z in metres, or @NAME.ANCHOR");
  for (const double x : *place) in_range(spec, word, x);
  return *place;
}

Vec3 read_factors(const ArgSpec& spec, std::string_view word) {
  const auto parts = split(word, ',');
  if (parts.size() != 1 && parts.size() != 3)
    refuse_word(spec, word, "neither one number nor three as X,Y,Z");
  Vec3 factors;
  for (Eigen::Index i = 0; i < 3; ++i) {
    const auto number = parse_double(trim(parts[parts.size() == 1 ? 0 : static_cast<std::size_t>(i)]));
    if (!number) refuse_word(spec, word, "neither one number nor three as X,Y,Z");
    factors[i] = in_range(spec, word, *number);
  }
  return factors;
}

std::vector<Vec3> read_places(const ArgSpec& spec, std::string_view word, const Units& units) {
  std::vector<Vec3> places;
  std::size_t at = 0;
  while (at < word.size()) {
    const std::size_t end = std::min(word.find_first_of("; ", at), word.size());
    const std::string_view part = trim(word.substr(at, end - at));
    if (!part.empty())
      places.push_back(part.starts_with('@') ? read_anchor(spec, part, units)
                                             : read_place(spec, part, units));
    at = end + 1;
  }
  if (places.empty()) refuse_word(spec, word, "no list of places: X,Y;X,Y;...");
  return places;
}

std::string read_name(const ArgSpec& spec, std::string_view word) {
  if (word.empty() || word.find_first_of(" \t*?,=#\"\\;") != std::string_view::npos || parse_double(word) ||
      printable(word) != word) {
    refuse_word(spec, word, "no name: one without blanks and none of *?,=#\";\\, and no number");
  }
  return std::string(word);
}

std::string read_text(const ArgSpec& spec, std::string_view word) {
  if (word.find_first_of(std::string_view("\n\0", 2)) != std::string_view::npos)
    refuse_word(spec, word, "no text for a map: it has a line break or a NUL byte");
  return std::string(word);
}

std::string read_choice(const ArgSpec& spec, std::string_view word) {
  std::vector<std::string> choices;
  for (const std::string_view choice : split(spec.choices, ' ')) {
    if (choice == word) return std::string(word);
    choices.emplace_back(choice);
  }
  refuse_word(spec, word,
              fmt::format("not one of {}{}", fmt::join(choices, ", "), suggestion(word, choices)));
}

Pairs read_keys(const ArgSpec& spec, std::string_view word) {
  const std::size_t equals = word.find('=');
  if (equals == std::string_view::npos || equals == 0) refuse_word(spec, word, "no key=value");
  return {{read_text(spec, word.substr(0, equals)), read_text(spec, word.substr(equals + 1))}};
}

}  // namespace

std::string type_name(const ArgSpec& spec) {
  switch (spec.kind) {
    case ArgKind::kText:
      return "TEXT";
    case ArgKind::kName:
      return "NAME";
    case ArgKind::kNumber:
      return "NUMBER";
    case ArgKind::kWhole:
      return "N";
    case ArgKind::kLength:
      return "LENGTH";
    case ArgKind::kAngle:
      return "ANGLE";
    case ArgKind::kPlace:
      return "X,Y[,Z]";
    case ArgKind::kVector:
      return "DX,DY[,DZ]";
    case ArgKind::kFactors:
      return "F|FX,FY,FZ";
    case ArgKind::kPlaces:
      return "X,Y;X,Y;...";
    case ArgKind::kWhat:
      return "WHAT";
    case ArgKind::kFile:
      return "FILE";
    case ArgKind::kMaterial:
      return "MATERIAL";
    case ArgKind::kKeys:
      return "KEY=VALUE...";
    case ArgKind::kChoice:
      break;
  }
  std::string choices(spec.choices);
  for (char& c : choices) {
    if (c == ' ') c = '|';
  }
  return choices;
}

Value read_value(const ArgSpec& spec, std::string_view word, const Units& units) {
  switch (spec.kind) {
    case ArgKind::kName:
      return read_name(spec, word);
    case ArgKind::kNumber:
      return read_number(spec, word);
    case ArgKind::kWhole: {
      const auto whole = parse_int(word);
      if (!whole) refuse_word(spec, word, "no whole number");
      in_range(spec, word, static_cast<double>(*whole));
      return *whole;
    }
    case ArgKind::kLength:
      return read_length(spec, word, units);
    case ArgKind::kAngle:
      return read_angle(spec, word);
    case ArgKind::kPlace:
      if (word.starts_with('@')) return read_anchor(spec, word, units);
      return read_place(spec, word, units);
    case ArgKind::kVector:
      return read_place(spec, word, units);
    case ArgKind::kFactors:
      return read_factors(spec, word);
    case ArgKind::kPlaces:
      return read_places(spec, word, units);
    case ArgKind::kChoice:
      return read_choice(spec, word);
    case ArgKind::kKeys:
      return read_keys(spec, word);
    case ArgKind::kText:
    case ArgKind::kWhat:
    case ArgKind::kFile:
    case ArgKind::kMaterial:
      break;
  }
  if (spec.kind != ArgKind::kText && word.empty()) refuse_word(spec, word, "empty");
  return read_text(spec, word);
}

const Value& Arguments::value(std::string_view name) const {
  const auto found = values_.find(name);
  if (found == values_.end())
    throw Error(ErrorCode::kInternal,
                "a command asks for its argument " + std::string(name) + ", which is not there");
  return found->second;
}

void Arguments::wrong_kind(std::string_view name) {
  throw Error(ErrorCode::kInternal,
              "a command asks for its argument " + std::string(name) + " as another kind");
}

}  // namespace hallway::editor
