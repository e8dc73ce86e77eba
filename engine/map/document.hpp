// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "geometry/se3.hpp"

namespace hallway::map {

/// One `"key" "value"` line. Both are the decoded text: `\"` stands for a quotation mark, every other backslash for itself.
struct KeyValue {
  std::string key{};
  std::string value{};
  std::vector<std::string> comments{};  ///< comment lines before it, without the slashes
  int line = 0;  ///< 1-based line of the key, 0 where the document was not read from a file

  friend bool operator==(const KeyValue&, const KeyValue&) = default;
};

/// The three numbers that some games put at the end of a face; kept, not interpreted.
struct SurfaceFlags {
  std::int64_t contents = 0;
  std::int64_t flags = 0;
  double value = 0.0;
};

/// One plane of a brush, as it stands in the file.
struct Face {
  std::vector<std::string> comments{};
  /// Three points of the plane in map units, clockwise as seen from outside the brush.
  std::array<Vec3, 3> points{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  std::string material{};
  Vec3 u_axis = Vec3::UnitX();  ///< texture axes, map frame
  Vec3 v_axis = -Vec3::UnitY();
  double u_offset = 0.0;  ///< texture pixels
  double v_offset = 0.0;
  double rotation_deg = 0.0;
  double u_scale = 1.0;  ///< map units per texture pixel
  double v_scale = 1.0;
  std::optional<SurfaceFlags> surface_flags{};
  /// The texture's place by the two rows of a brush primitive (`brushDef`); kept, not interpreted.
  std::optional<std::array<double, 6>> texture_matrix{};
  int line = 0;
};

/// A convex solid as the half-spaces behind its faces. May be nonsense: build_world() says so.
struct Brush {
  std::vector<std::string> comments{};
  std::vector<Face> faces{};
  /// A shape that is kept and not understood, such as a patch: its text as in the file, from its keyword to its closing
  /// brace. Empty in brushes of faces.
  std::string unread{};
  std::vector<std::string> closing_comments{};  ///< those before its closing brace
  int line = 0;                                 ///< of its opening brace
};

/// Key-value pairs, and brushes where the class has a shape.
struct Entity {
  std::vector<std::string> comments{};
  std::vector<KeyValue> keys{};  ///< in the order of the file
  std::vector<Brush> brushes{};
  std::vector<std::string> closing_comments{};
  int line = 0;  ///< of its opening brace

  /// The value of `key`, or null. Where a key stands twice the last one counts, as in Quake's tools.
  const std::string* find(std::string_view key) const;
  /// The value of `key`, or the empty text.
  const std::string& value(std::string_view key) const;
  /// Whether `key` is there and has that value.
  bool has(std::string_view key, std::string_view value) const;
  /// The value of `classname`, or the empty text.
  std::string_view classname() const { return value("classname"); }

  /// Adds a line after the others, whatever they say.
  void add(std::string key, std::string value) { keys.push_back({std::move(key), std::move(value)}); }
  /// Removes every line of `key`.
  void erase(std::string_view key);
};

/// A whole map file, as a value: everything that parse() read and print() writes.
struct Document {
  std::string file{};  ///< path as the user gave it; only used in messages
  std::vector<Entity> entities{};
  std::vector<std::string> closing_comments{};  ///< those after the last entity

  /// The first entity of class `worldspawn`, or null.
  const Entity* worldspawn() const;
  /// Key `_scale` of worldspawn, or 1/32 (a Quake unit) where it is absent. Throws Error{kBadInput} if the value is not a
  /// number in [1e-6, 1e3].
  double metres_per_unit() const;
};

/// Metres per map unit where a map does not say: a Quake player is 56 units tall.
inline constexpr double kQuakeMetresPerUnit = 1.0 / 32.0;

}  // namespace hallway::map
