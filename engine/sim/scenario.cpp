// SPDX-License-Identifier: MIT
#include "sim/scenario.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>
#include <variant>

#include "base/file.hpp"
#include "base/text.hpp"
#include "base/toml_reader.hpp"
#include "map/sensors.hpp"
#include "sim/overrides.hpp"
#include "sim/schema.hpp"
#include "sim/sensors.hpp"
#include "sim/table_reader.hpp"

namespace hallway::sim {
namespace {

constexpr const char* kSchema = "hallway.scenario/1";
constexpr std::int64_t kMaxSteps = 10'000'000;
constexpr std::size_t kMaxPlugins = 64;
constexpr std::size_t kMaxParameters = 1000;
constexpr std::size_t kMaxPictures = 1000;
constexpr std::int64_t kMaxPictureSide_px = 16384;
constexpr std::int64_t kMaxPicturePixels = std::int64_t{32} << 20;
constexpr std::size_t kMaxFileNameBytes = 200;

constexpr Range kWorld_m{-1e7, 1e7};
constexpr Range kSpeed_m_s{0.0, 1e3};
constexpr Range kBodySize_m{0.001, 100.0};
constexpr Range kBodyHeight_m{-100.0, 100.0};
constexpr Range kPeriod_s{1e-6, 60.0};
constexpr Range kCallTimeout_s{0.01, 1e6};
constexpr std::int64_t kMinMemory_mib = 16;
constexpr std::int64_t kMaxMemory_mib = std::int64_t{1} << 24;

const std::vector<std::string> kViews{"top", "perspective"};  // in the order of PictureView
const std::vector<std::string> kLayers{"map",    "truth",   "estimate", "landmarks",
                                       "errors", "submaps", "frustum"};  // in the order of PictureLayer

bool is_plugin_file(std::string_view plugin) {
  return plugin.find('/') != std::string_view::npos || plugin.ends_with(".so") ||
         plugin.find(".so:") != std::string_view::npos;
}

/// Reads one scenario, table by table.
class ScenarioReader {
 public:
  ScenarioReader(const std::filesystem::path& path, const TomlTable& root) : path_(path), root_(root) {
    scenario_.file = path.string();
  }

  Scenario read() {
    TableReader top = reader("", root_, 1, kTopKeys);
    if (top.has("schema")) read_schema(top);
    scenario_.map_file = beside(top.text("map"), top.line("map"));
    scenario_.seed =
        static_cast<std::uint64_t>(top.whole("seed", 0, std::numeric_limits<std::int64_t>::max(), 1));
    scenario_.steps = static_cast<std::uint32_t>(top.whole("steps", 1, kMaxSteps));
    scenario_.period_ns = std::llround(top.number("period_s", kPeriod_s, scenario_.period_s()) * 1e9);
    read_limits(top);
    read_robot(top);
    read_sensors(top);
    read_list(top, "plugin", kMaxPlugins,
              [&](const TomlTable& table, int line) { read_plugin(table, line); });
    read_list(top, "picture", kMaxPictures,
              [&](const TomlTable& table, int line) { read_picture(table, line); });
    return std::move(scenario_);
  }

 private:
  TableReader reader(const std::string& prefix, const TomlTable& table, int line,
                     const std::vector<std::string>& known) {
    return TableReader(scenario_.file, prefix, table, line, known, scenario_.settings);
  }

  /// A path in the file counts from the file's folder, one on the command line from the current folder.
  std::filesystem::path beside(const std::string& name, int line) const {
    return line == 0 ? std::filesystem::path(name) : path_.parent_path() / name;
  }

  void read_schema(TableReader& top) {
    const std::string schema = top.text("schema");
    if (schema != kSchema) {
      throw top.error("schema", "\"" + printable(schema) + "\" is not read by this version; it reads \"" +
                                    kSchema + "\"");
    }
  }

  void read_limits(TableReader& top) {
    PluginLimits& limits = scenario_.limits;
    limits.call_timeout_s = top.number("call_timeout_s", kCallTimeout_s, limits.call_timeout_s);
    limits.memory_mib = static_cast<std::uint64_t>(top.whole(
        "memory_limit_mib", kMinMemory_mib, kMaxMemory_mib, static_cast<std::int64_t>(limits.memory_mib)));
    limits.on_failure = static_cast<OnFailure>(top.choice("on_failure", kOnFailure, 0));
  }

  void read_robot(const TableReader& top) {
    TableReader robot = reader("robot", top.table("robot"), top.line("robot"), kRobotKeys);
    scenario_.robot.path = robot.text("path");
    if (robot.has("speed_m_s") && robot.has("loop_steps")) {
      throw robot.error("loop_steps", "stands beside `speed_m_s`; give one of them");
    }
    if (robot.has("loop_steps")) {
      scenario_.robot.loop_steps = static_cast<std::uint32_t>(robot.whole("loop_steps", 1, kMaxSteps));
    } else if (robot.has("speed_m_s")) {
      scenario_.robot.speed_m_s = robot.number("speed_m_s", kSpeed_m_s);
    } else {
      throw robot.error("speed_m_s", "is missing; give it or `loop_steps`");
    }
    read_body(robot);
  }

  /// A cylinder where there is a radius, a box where there is a length, else a point.
  void read_body(TableReader& robot) {
    const bool round = robot.has("radius_m");
    if (round && (robot.has("length_m") || robot.has("width_m"))) {
      throw robot.error("radius_m", "stands beside `length_m` or `width_m`; a robot is a cylinder or a box");
    }
    if (!round && !robot.has("length_m") && !robot.has("width_m")) {
      for (const char* key : {"bottom_m", "top_m"}) {
        if (robot.has(key)) throw robot.error(key, "needs `radius_m`, or `length_m` and `width_m`");
      }
      return;
    }
    const double low = robot.number("bottom_m", kBodyHeight_m);
    const double high = robot.number("top_m", kBodyHeight_m);
    if (high - low < bsp::kLeastBodySize) throw robot.error("top_m", "is not above `bottom_m`");
    if (round) {
      scenario_.robot.body = bsp::Cylinder{robot.number("radius_m", kBodySize_m), low, high};
    } else {
      const double length = robot.number("length_m", kBodySize_m);
      const double width = robot.number("width_m", kBodySize_m);
      scenario_.robot.body = bsp::UprightBox{0.5 * length, 0.5 * width, 0.0, low, high};
    }
  }

  void read_sensors(const TableReader& top) {
    const TomlTable& sensors = top.table("sensor");
    if (sensors.size() > map::kMaxSensors) {
      throw top.error("sensor", "has " + std::to_string(sensors.size()) + " sensors; at most " +
                                    std::to_string(map::kMaxSensors) + " are allowed");
    }
    std::vector<std::string> names;
    for (const TomlEntry& entry : sensors) names.push_back(entry.key);
    const TableReader all = reader("sensor", sensors, top.line("sensor"), names);
    for (const std::string& name : names) {
      if (!std::holds_alternative<TomlTable>(find(sensors, name)->value)) {
        throw all.error(name, "must be a table: a sensor is written as [sensor.NAME]");
      }
      if (!map::is_sensor_name(name)) {
        throw all.error(name, "a sensor's name is 1 to 64 of the characters a-z, A-Z, 0-9, _ and -");
      }
      TableReader sensor = reader("sensor." + name, all.table(name), all.line(name), kSensorKeys);
      scenario_.sensors.push_back(read_sensor(name, sensor));
    }
  }

  template <typename Read>
  void read_list(const TableReader& top, const std::string& key, std::size_t most, const Read& read_one) {
    const TomlNode* node = find(root_, key);
    if (node == nullptr) return;
    const auto* items = std::get_if<TomlArray>(&node->value);
    if (items == nullptr) throw top.error(key, "must be written as [[" + key + "]]");
    if (items->size() > most) {
      throw top.error(key, "stands " + std::to_string(items->size()) + " times; at most " +
                               std::to_string(most) + " are allowed");
    }
    for (const TomlNode& item : *items) {
      const auto* table = std::get_if<TomlTable>(&item.value);
      if (table == nullptr) throw top.error(key, "must be written as [[" + key + "]]");
      read_one(*table, item.line);
    }
  }

  void read_plugin(const TomlTable& table, int line) {
    const std::string prefix = "plugin[" + std::to_string(scenario_.pipeline.size() + 1) + "]";
    TableReader plugin = reader(prefix, table, line, kPluginKeys);
    const std::string written = plugin.text("name");
    const std::string short_name = short_plugin_name(written);
    for (const PluginSpec& other : scenario_.pipeline) {
      if (short_plugin_name(other.name) == short_name) {
        throw plugin.error("name",
                           "the plugin \"" + printable(short_name) + "\" stands twice in the pipeline");
      }
    }
    PluginSpec spec;
    spec.name = is_plugin_file(written) ? beside(written, plugin.line("name")).string() : written;
    const TomlTable& params = plugin.table("params");
    if (params.size() > kMaxParameters) {
      throw plugin.error("params", "has more than " + std::to_string(kMaxParameters) + " parameters");
    }
    spec.params = read_parameters(short_name, params);
    scenario_.pipeline.push_back(std::move(spec));
  }

  std::vector<PluginParameter> read_parameters(const std::string& plugin, const TomlTable& params) {
    const TableReader table = reader(plugin, params, 0, keys_of(params));
    std::vector<PluginParameter> read;
    for (const TomlEntry& param : params) {
      const std::optional<std::string> value = parameter_text(param.node);
      if (!value) {
        throw table.error(param.key, std::string("a parameter is a number, a text or true or false, not ") +
                                         kind_name(param.node));
      }
      scenario_.settings.push_back({table.full_key(param.key), *value, table.origin(param.key)});
      read.push_back({param.key, *value, table.error(param.key, "").where()});
    }
    return read;
  }

  static std::optional<std::string> parameter_text(const TomlNode& node) {
    if (const auto* flag = std::get_if<bool>(&node.value)) return *flag ? "true" : "false";
    if (const auto* whole = std::get_if<std::int64_t>(&node.value)) return std::to_string(*whole);
    if (const auto* number = std::get_if<double>(&node.value)) return format_double(*number);
    if (const auto* text = std::get_if<std::string>(&node.value)) return *text;
    return std::nullopt;
  }

  static std::vector<std::string> keys_of(const TomlTable& table) {
    std::vector<std::string> keys;
    for (const TomlEntry& entry : table) keys.push_back(entry.key);
    return keys;
  }

  void read_picture(const TomlTable& table, int line) {
    const std::string prefix = "picture[" + std::to_string(scenario_.pictures.size() + 1) + "]";
    TableReader picture = reader(prefix, table, line, kPictureKeys);
    PictureSpec spec;
    spec.file = read_picture_name(picture);
    spec.view = static_cast<PictureView>(picture.choice("view", kViews, 0));
    spec.width_px = static_cast<int>(picture.whole("width_px", 1, kMaxPictureSide_px, spec.width_px));
    spec.height_px = static_cast<int>(picture.whole("height_px", 1, kMaxPictureSide_px, spec.height_px));
    if (std::int64_t{spec.width_px} * spec.height_px > kMaxPicturePixels) {
      throw picture.error(
          "width_px", "the picture would have more than " + std::to_string(kMaxPicturePixels) + " pixels");
    }
    if (picture.has("cut_z_m")) spec.cut_z_m = picture.number("cut_z_m", kWorld_m);
    if (picture.has("eye_m") != picture.has("target_m")) {
      throw picture.error(picture.has("eye_m") ? "eye_m" : "target_m",
                          "give `eye_m` and `target_m` together");
    }
    if (picture.has("eye_m")) {
      if (spec.view == PictureView::kTop) throw picture.error("eye_m", "a top view has no eye");
      spec.eye_m = picture.vector("eye_m", kWorld_m);
      spec.target_m = picture.vector("target_m", kWorld_m);
      if (*spec.eye_m == *spec.target_m) throw picture.error("target_m", "is the same point as `eye_m`");
    }
    for (const std::size_t layer : picture.choices("show", kLayers)) {
      spec.show.push_back(static_cast<PictureLayer>(layer));
    }
    scenario_.pictures.push_back(std::move(spec));
  }

  std::string read_picture_name(TableReader& picture) const {
    const std::string name = picture.text("file");
    const bool plain = name.find('/') == std::string::npos && name.front() != '.' &&
                       printable(name) == name && name.size() <= kMaxFileNameBytes;
    if (!plain) {
      throw picture.error("file",
                          "\"" + printable(name) +
                              "\" must be a plain file name: no folder, no dot at the start, at most " +
                              std::to_string(kMaxFileNameBytes) + " bytes, nothing unprintable");
    }
    if (!name.ends_with(".png")) throw picture.error("file", "\"" + name + "\" must end in .png");
    for (const PictureSpec& other : scenario_.pictures) {
      if (other.file == name)
        throw picture.error("file", "\"" + name + "\" is the name of another picture too");
    }
    return name;
  }

  std::filesystem::path path_;
  const TomlTable& root_;
  Scenario scenario_;
};

}  // namespace

std::string short_plugin_name(const std::string& plugin) {
  if (!is_plugin_file(plugin)) return plugin;
  if (const std::size_t at = plugin.rfind(".so:"); at != std::string::npos) return plugin.substr(at + 4);
  const std::string name = std::filesystem::path(plugin).filename().string();
  return name.ends_with(".so") ? name.substr(0, name.size() - 3) : name;
}

const std::vector<std::string>& picture_layer_names() {
  return kLayers;
}

bool PictureSpec::shows(PictureLayer layer) const {
  return std::find(show.begin(), show.end(), layer) != show.end();
}

Scenario load_scenario(const std::filesystem::path& file, std::span<const Override> overrides) {
  TomlTable root = parse_toml(read_file(file, kMaxScenarioBytes), file.string());
  apply_overrides(root, overrides);
  return ScenarioReader(file, root).read();
}

}  // namespace hallway::sim
