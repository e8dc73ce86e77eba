// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/setting.hpp"
#include "base/toml_node.hpp"
#include "map/document.hpp"

namespace hallway::map {

/// How surfaces of one material answer sensors.
struct MaterialProperties {
  double reflectance =
      0.5;  ///< share of a lidar's light that is scattered back from a beam along the normal, [0, 1]
  double lidar_dropout = 0.0;  ///< share of a lidar's beams that get no answer, [0, 1]
  double infrared =
      0.5;  ///< share of infrared light that is scattered back from a beam along the normal, [0, 1]
  double transparency = 0.0;  ///< share of beams of light that go through each face, [0, 1]
  double echo_deg =
      60.0;  ///< up to this angle of incidence a sonar's echo comes back; beyond, the surface is a mirror, [0, 90]

  bool operator==(const MaterialProperties&) const = default;
};

/// A property as tables have it: a number within a range. A new one is a member above and a row of material_properties().
struct MaterialProperty {
  std::string_view key{};
  double MaterialProperties::*member = nullptr;
  double low = 0.0;
  double high = 1.0;
  std::string_view about{};
};

/// In a fixed order; no two keys are the same.
inline constexpr std::array kMaterialProperties{
    MaterialProperty{"reflectance", &MaterialProperties::reflectance, 0.0, 1.0,
                     "share of a lidar's light that comes back from a beam along the normal"},
    MaterialProperty{"lidar_dropout", &MaterialProperties::lidar_dropout, 0.0, 1.0,
                     "share of a lidar's beams that get no answer"},
    MaterialProperty{"infrared", &MaterialProperties::infrared, 0.0, 1.0,
                     "share of infrared light that comes back from a beam along the normal"},
    MaterialProperty{"transparency", &MaterialProperties::transparency, 0.0, 1.0,
                     "share of beams of light that go through each face"},
    MaterialProperty{"echo_deg", &MaterialProperties::echo_deg, 0.0, 90.0,
                     "up to this angle of incidence a sonar's echo comes back"},
};

/// Tables of materials hold at most so many.
inline constexpr std::size_t kMostMaterials = 4096;

/// The properties of materials by their names.
///
/// A name is compared without its folders and without regard to case. An entry is for a name, or for all that fit a pattern, in which each `*` is any
/// text. Of a property counts the entry of the very name, if it says it; else the first pattern that fits and says it, in the order of the table;
/// else the default of MaterialProperties. An entry with `like` says what another entry of its table says, where it says nothing itself.
class MaterialTable {
 public:
  /// The tables of `materials`, each an entry.
  /// @param file      the file as the user named it
  /// @param settings  what is read is noted there, as `material.NAME.KEY`
  /// Throws Error{kBadInput} with file, line and key for a key that is unknown, a value that is no number within its range, one material twice, a name with a folder, a `like`
  /// that names no entry or leads round to itself, and for more than kMostMaterials.
  static MaterialTable read(const TomlTable& materials, const std::string& file,
                            std::vector<Setting>& settings);

  /// Lets another table say what this one does not.
  void add_below(const MaterialTable& other);

  MaterialProperties of(std::string_view material) const;
  /// Whether an entry is for the material.
  bool describes(std::string_view material) const;
  bool empty() const { return entries_.empty(); }

 private:
  struct Entry {
    std::string name;  ///< as it is compared
    std::array<std::optional<double>, kMaterialProperties.size()> values{};
  };

  std::vector<Entry> entries_;  ///< table by table; of each first the names, then the patterns
};

/// The table of a file: `schema = "hallway.materials/1"` and [material.NAME]. Throws as MaterialTable::read() does, and Error{kIo} for a file that cannot
/// be read.
MaterialTable load_materials(const std::filesystem::path& file, std::vector<Setting>& settings);

/// The table that a map names by the key `_materials` of its worldspawn, a file beside it; empty where it names none. Throws as load_materials() does, and
/// Error{kBadInput} with the map's line for a name that leads out of its folder.
MaterialTable materials_of(const Document& document, const std::filesystem::path& map_folder,
                           std::vector<Setting>& settings);

}  // namespace hallway::map
