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
#include "sim/clouds.hpp"
#include "sim/default_scenario.hpp"
#include "sim/drive_keys.hpp"
#include "sim/overrides.hpp"
#include "sim/robot_defaults.hpp"
#include "sim/schema.hpp"
#include "sim/sensors.hpp"
#include "sim/table_reader.hpp"

namespace hallway::sim {
namespace {

constexpr const char* kSchema = "hallway.scenario/1";
constexpr std::int64_t kMaxSteps = 10'000'000;
constexpr std::size_t kMaxPictures = 1000;
constexpr std::size_t kMaxEvents = 100'000;
constexpr std::int64_t kMaxPicturesOfOne = 10'000;
constexpr std::int64_t kMaxPictureSide_px = 16384;
constexpr std::int64_t kMaxPicturePixels = std::int64_t{32} << 20;
constexpr std::size_t kMaxFileNameBytes = 200;
constexpr const char* kCopyOfMap = "map.map";  // in the folder of a run

constexpr Range kWorld_m{-1e7, 1e7};
constexpr Range kSpeed_m_s{0.0, 1e3};
constexpr Range kBodySize_m{0.001, 100.0};
constexpr Range kBodyHeight_m{-100.0, 100.0};
constexpr Range kPeriod_s{1e-6, 60.0};

const std::vector<std::string> kViews{"top", "perspective", "panels",
                                      "camera"};  // in the order of PictureView
const std::
    vector<std::string>
        kLayers{"map",     "truth",  "estimate", "landmarks", "errors",   "submaps",
                "frustum", "walls",  "body",     "trail",     "contacts", "command",
                "seen",    "events", "deskewed", "topology",  "drawing"};  // in the order of PictureLayer

/// Reads one scenario, table by table.
class ScenarioReader {
 public:
  /// @param robot  what the robot file says, which is in `root` too; may be null
  ScenarioReader(const std::filesystem::path& path, const TomlTable& root, const map::RobotFile* robot)
      : path_(path), root_(root), robot_file_(robot) {
    scenario_.file = path.string();
    if (robot == nullptr) return;
    scenario_.robot_file = robot->file;
    scenario_.bump_zones = bump_zones_of(*robot);
  }

  Scenario read() {
    TableReader top = reader("", root_, 1, kTopKeys);
    if (top.has("schema")) read_schema(top);
    scenario_.map_file =
        named_or_copy(path_, host::beside(path_, top.text("map"), top.line("map")), kCopyOfMap);
    scenario_.seed =
        static_cast<std::uint64_t>(top.whole("seed", 0, std::numeric_limits<std::int64_t>::max(), 1));
    scenario_.steps = static_cast<std::uint32_t>(top.whole("steps", 1, kMaxSteps));
    scenario_.period_ns = std::llround(top.number("period_s", kPeriod_s, scenario_.period_s()) * 1e9);
    scenario_.limits = host::read_plugin_limits(top, scenario_.limits);
    read_robot(top);
    read_sensors(top);
    read_clouds(top);
    if (top.has("material"))
      scenario_.materials =
          map::MaterialTable::read(top.table("material"), scenario_.file, scenario_.settings);
    read_events(top);
    scenario_.pipeline = host::read_plugin_tables(path_, root_, scenario_.settings);
    for_each_table(top, root_, "picture", kMaxPictures,
                   [&](const TomlTable& table, int line) { read_picture(table, line); });
    return std::move(scenario_);
  }

 private:
  TableReader reader(const std::string& prefix, const TomlTable& table, int line,
                     const std::vector<std::string>& known) {
    return TableReader(scenario_.file, prefix, table, line, known, scenario_.settings);
  }

  void read_schema(TableReader& top) {
    const std::string schema = top.text("schema");
    if (schema != kSchema) {
      throw top.error("schema", "\"" + printable(schema) + "\" is not read by this version; it reads \"" +
                                    kSchema + "\"");
    }
  }

  void read_robot(const TableReader& top) {
    std::vector<std::string> keys = kRobotKeys;
    keys.insert(keys.end(), kDrivenKeys.begin(), kDrivenKeys.end());
    TableReader robot = reader("robot", top.table("robot"), top.line("robot"), keys);
    if (robot.has("file")) robot.text("file");
    if (robot.has("path")) scenario_.robot.path = robot.text("path");
    if (!robot.has("path") && !top.has("robot")) throw robot.error("path", "is missing");
    read_drive(robot);
    if (robot.has("smooth")) read_smooth(robot);
    if (!robot.has("path")) {
      if (robot.has("speed_m_s") || robot.has("loop_steps"))
        throw robot.error("path", "is missing; a robot that moves needs one");
      read_body(robot);
      return;
    }
    if (robot.has("speed_m_s") && robot.has("loop_steps")) {
      throw robot.error("loop_steps", "is given together with `speed_m_s`; give one of them");
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

  void read_smooth(TableReader& robot) {
    scenario_.robot.smooth = robot.flag("smooth", false);
    if (!scenario_.robot.smooth) return;
    if (!robot.has("path")) throw robot.error("smooth", "needs `path`");
    if (robot.has("drive")) throw robot.error("smooth", "is of a robot that its path moves, without a drive");
  }

  void read_start(TableReader& robot, bool has_path) {
    scenario_.robot.start = robot.text("start");
    if (has_path)
      throw robot.error("start", "is given together with `path`, at whose beginning the robot stands");
    if (scenario_.robot.start == "free" && !robot.has("drive"))
      throw robot.error("start", "\"free\" needs a [robot.drive]");
  }

  void read_drive(TableReader& robot) {
    const bool has_path = robot.has("path");
    if (!robot.has("drive")) {
      if (robot.has("start")) read_start(robot, has_path);
      refuse_driven_keys(robot);
      return;
    }
    if (robot.has("start")) read_start(robot, has_path);
    DriveTables tables{path_, scenario_.file, scenario_.settings};
    if (robot_file_ != nullptr && robot_file_->has_drive) tables.kind = 0;
    scenario_.robot.driven = read_driven(robot, tables, has_path);
  }

  /// A cylinder where there is a radius, a box where there is a length, else a point.
  void read_body(TableReader& robot) {
    const bool round = robot.has("radius_m");
    if (round && (robot.has("length_m") || robot.has("width_m"))) {
      throw robot.error("radius_m",
                        "is given together with `length_m` or `width_m`; a robot is a cylinder or a box");
    }
    if (!round && !robot.has("length_m") && !robot.has("width_m")) {
      for (const char* key : {"bottom_m", "top_m"}) {
        if (robot.has(key)) throw robot.error(key, "needs `radius_m`, or `length_m` and `width_m`");
      }
      if (robot_file_ != nullptr) take_hull();
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

  void take_hull() {
    if (!scenario_.robot.driven) {
      throw Error(
          ErrorCode::kBadInput,
          "this body needs a drive: without one a body is a cylinder, or a box along the axes, about the "
          "z axis",
          {printable(robot_file_->file), robot_file_->body.line, {}});
    }
    scenario_.robot.hull = robot_file_->body.vertices;
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
      read_sensor_table(name, all);
    }
    scenario_.takes_map_sensors = names.empty();
  }

  void read_sensor_table(const std::string& name, const TableReader& all) {
    const auto table = [&](std::vector<Setting>& settings) {
      return SensorTable{all.file(name), all.table(name), all.line(name), settings, scenario_.bump_zones};
    };
    const bool of_file =
        robot_file_ != nullptr &&
        std::ranges::find(robot_file_->sensors, name, &map::RobotSensor::name) != robot_file_->sensors.end();
    const auto kind = of_file ? std::optional<std::size_t>(0) : std::nullopt;
    if (is_mounted(name, table(scenario_.settings))) {
      add_sensor(scenario_, name, read_sensor(name, table(scenario_.settings), kind));
      return;
    }
    std::vector<Setting> unused;
    read_sensor(name, table(unused), kind);
  }

  void read_clouds(const TableReader& top) {
    const TomlTable& clouds = top.table("cloud");
    std::vector<std::string> names;
    for (const TomlEntry& entry : clouds) names.push_back(entry.key);
    const TableReader all = reader("cloud", clouds, top.line("cloud"), names);
    for (const std::string& name : names) {
      if (!std::holds_alternative<TomlTable>(find(clouds, name)->value))
        throw all.error(name, "must be a table: a cloud is written as [cloud.NAME]");
      TableReader cloud = reader("cloud." + name, all.table(name), all.line(name), kCloudKeys);
      const Where where{printable(scenario_.file), all.line(name), "table `cloud." + printable(name) + "`"};
      scenario_.clouds.push_back({name, read_cloud_keys(cloud), where});
    }
  }

  void read_events(const TableReader& top) {
    for_each_table(top, root_, "event", kMaxEvents, [&](const TomlTable& table, int line) {
      const std::string prefix = "event[" + std::to_string(scenario_.events.size() + 1) + "]";
      scenario_.events.push_back(read_event(scenario_.file, prefix, table, line, scenario_.settings));
      if (acts_on_drive(scenario_.events.back().kind) && !scenario_.robot.driven) {
        throw Error(ErrorCode::kBadInput,
                    "a " + std::string(event_kind_name(scenario_.events.back().kind)) +
                        " needs a [robot.drive]; a robot that its path moves meets nothing",
                    Where{printable(scenario_.file), line, "table `" + prefix + "`"});
      }
    });
    std::ranges::stable_sort(scenario_.events, {}, &EventSpec::t_ns);
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
      if (spec.view != PictureView::kPerspective) throw picture.error("eye_m", "a top view has no eye");
      spec.eye_m = picture.vector("eye_m", kWorld_m);
      spec.target_m = picture.vector("target_m", kWorld_m);
      if (*spec.eye_m == *spec.target_m) throw picture.error("target_m", "is the same point as `eye_m`");
    }
    if (picture.has("show")) {
      for (const std::size_t layer : picture.choices("show", kLayers))
        spec.show.push_back(static_cast<PictureLayer>(layer));
    } else {
      spec.show = default_picture_layers();
    }
    read_moments(picture, spec);
    for (const PictureSpec& other : scenario_.pictures) {
      if (is_one_of(spec.file, other) || is_one_of(other.file, spec))
        throw picture.error("file", "\"" + spec.file + "\" and \"" + other.file +
                                        "\" may give pictures of one name, since one has `every`");
    }
    scenario_.pictures.push_back(std::move(spec));
  }

  /// Whether a file name may be that of a picture of `every`.
  static bool is_one_of(const std::string& file, const PictureSpec& many) {
    if (many.every == 0) return false;
    const std::string stem = many.file.substr(0, many.file.rfind('.')) + "_";
    const std::string_view ending = ".png";
    if (!file.starts_with(stem) || file.size() < stem.size() + 6 + ending.size()) return false;
    const std::string_view number =
        std::string_view(file).substr(stem.size(), file.size() - stem.size() - ending.size());
    return number.find_first_not_of("0123456789") == std::string_view::npos;
  }

  void read_moments(TableReader& picture, PictureSpec& spec) const {
    const bool has_one = picture.has("iteration"), has_many = picture.has("every");
    if (has_one && has_many)
      throw picture.error("every", "is given together with `iteration`; give one of them");
    if ((has_one || has_many) && spec.view == PictureView::kPanels)
      throw picture.error(has_one ? "iteration" : "every", "`panels` shows no single iteration");
    if (has_one) {
      spec.iteration =
          static_cast<std::uint32_t>(picture.whole("iteration", 0, std::int64_t{scenario_.steps} - 1));
    }
    if (!has_many) return;
    spec.every = static_cast<std::uint32_t>(picture.whole("every", 1, kMaxSteps));
    const std::int64_t count = (std::int64_t{scenario_.steps} - 1) / spec.every + 1;
    if (count > kMaxPicturesOfOne)
      throw picture.error("every", "gives " + std::to_string(count) + " pictures; at most " +
                                       std::to_string(kMaxPicturesOfOne) + " are drawn");
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
  const map::RobotFile* robot_file_;
  Scenario scenario_;
};

}  // namespace

const std::vector<std::string>& picture_layer_names() {
  return kLayers;
}

std::vector<PictureLayer> default_picture_layers() {
  std::vector<PictureLayer> layers;
  for (std::size_t i = 0; i < kLayers.size(); ++i) {
    const auto layer = static_cast<PictureLayer>(i);
    if (layer != PictureLayer::kSubmaps && layer != PictureLayer::kDeskewed) layers.push_back(layer);
  }
  return layers;
}

PictureSpec PictureSpec::at(std::uint32_t shown_iteration) const {
  PictureSpec one = *this;
  one.iteration = shown_iteration;
  one.every = 0;
  std::string number = std::to_string(shown_iteration);
  number.insert(0, number.size() < 6 ? 6 - number.size() : 0, '0');
  one.file.insert(one.file.rfind('.'), "_" + number);
  return one;
}

bool PictureSpec::shows(PictureLayer layer) const {
  return std::find(show.begin(), show.end(), layer) != show.end();
}

Scenario load_scenario(const std::filesystem::path& file, std::span<const Override> overrides) {
  return parse_scenario(read_file(file, kMaxScenarioBytes), file, overrides);
}

Scenario parse_scenario(const std::string& text, const std::filesystem::path& file,
                        std::span<const Override> overrides) {
  TomlTable root = parse_toml(text, file.string());
  const auto robot_file = find_robot_file(root, overrides, file);
  if (!robot_file) {
    apply_overrides(root, overrides);
    return ScenarioReader(file, root, nullptr).read();
  }
  const map::RobotFile robot = map::load_robot_file(*robot_file);
  apply_overrides(root, overrides, sensor_names(robot));
  take_robot_file(root, robot);
  return ScenarioReader(file, root, &robot).read();
}

}  // namespace hallway::sim
