// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "geometry/se3.hpp"

namespace hallway::editor {

/// What an argument is. Lengths are metres unless they carry a unit: `m`, `cm`, `mm`, `in`, `ft`, `u` (map units). Angles are
/// degrees unless they carry `deg` or `rad`.
enum class ArgKind {
  kText,  ///< any text
  kName,  ///< the name of something: no blanks, none of `*?,=#"`, not a number
  kNumber,
  kWhole,
  kLength,    ///< "2.7", "15cm"
  kAngle,     ///< "90", "1.57rad"
  kPlace,     ///< "x,y" (z is 0) or "x,y,z", each a length, or "@name.anchor+x,y"; where something is
  kVector,    ///< the same; a way from one place to another, which no grid rounds
  kFactors,   ///< one number or "x,y,z"
  kPlaces,    ///< places, with blanks or `;` between them (as one word: with `;` or in quotes)
  kWhat,      ///< which things (docs/edit.md, "Naming things")
  kFile,      ///< a path
  kChoice,    ///< one of ArgSpec::choices
  kMaterial,  ///< a material's name
  kKeys,      ///< key=value pairs to the end of the line
};

/// One argument of a command, as data.
struct ArgSpec {
  std::string_view name{};
  ArgKind kind = ArgKind::kText;
  std::string_view help{};
  std::string_view fallback{};  ///< what counts where it is not given, as it would be typed; empty: nothing
  std::string_view choices{};   ///< of a kChoice, between blanks
  bool required = false;
  double low = -1e9;  ///< of numbers, lengths, angles
  double high = 1e9;

  /// The same argument, which must be given.
  constexpr ArgSpec needed() const {
    ArgSpec spec = *this;
    spec.required = true;
    return spec;
  }
  /// The same argument with limits, in the unit of a word without one.
  constexpr ArgSpec within(double least, double most) const {
    ArgSpec spec = *this;
    spec.low = least;
    spec.high = most;
    return spec;
  }
};

/// The kind as help texts name it: "LENGTH", "X,Y[,Z]", "a|b|c".
std::string type_name(const ArgSpec& spec);

/// One value, as its kind stores it. Lengths are metres, angles radians.
using Pairs = std::vector<std::pair<std::string, std::string>>;  ///< keys and their values
using Value = std::variant<std::string, double, std::int64_t, Vec3, std::vector<Vec3>, Pairs>;

struct State;

/// How a typed word becomes a value.
struct Units {
  double metres_per_unit = 0.01;
  const State* state =
      nullptr;  ///< where `@NAME.ANCHOR` is looked up; not owned, and read while words are read only
};

/// Reads one word. Throws Error{kUsage} naming argument, word and what is expected.
Value read_value(const ArgSpec& spec, std::string_view word, const Units& units);

/// The values of a command's arguments. Those that were not given and have a fallback are there.
class Arguments {
 public:
  void set(std::string_view name, Value value) {
    values_.insert_or_assign(std::string(name), std::move(value));
  }
  bool has(std::string_view name) const { return values_.find(name) != values_.end(); }

  // The value of an argument that is there; anything else is a bug and throws Error{kInternal}.
  const std::string& text(std::string_view name) const { return get<std::string>(name); }
  double number(std::string_view name) const {
    return get<double>(name);
  }  ///< also lengths (m), angles (rad)
  std::int64_t whole(std::string_view name) const { return get<std::int64_t>(name); }
  const Vec3& place(std::string_view name) const { return get<Vec3>(name); }
  const std::vector<Vec3>& places(std::string_view name) const { return get<std::vector<Vec3>>(name); }
  const Pairs& keys(std::string_view name) const { return get<Pairs>(name); }
  /// The text of a kName, kText or kMaterial that is there, else the empty one.
  std::string text_or_empty(std::string_view name) const { return has(name) ? text(name) : std::string(); }

 private:
  const Value& value(std::string_view name) const;
  template <typename T>
  const T& get(std::string_view name) const {
    const T* found = std::get_if<T>(&value(name));
    if (found == nullptr) wrong_kind(name);
    return *found;
  }
  [[noreturn]] static void wrong_kind(std::string_view name);

  std::map<std::string, Value, std::less<>> values_;
};

}  // namespace hallway::editor
