// SPDX-License-Identifier: MIT
#include "study/first_robot/office_files.hpp"

#include <fmt/format.h>

#include <cmath>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/text.hpp"
#include "base/toml_text.hpp"
#include "map/writer.hpp"

namespace hallway::study {
namespace {

constexpr double kUnitsPerMetre = 100.0;
constexpr double kHeight_m = 2.4;
constexpr double kCabinetHeight_m = 1.3;
constexpr double kSolid_m = 0.3;           // around all that is cut out
constexpr double kCabinetInWall_m = 0.05;  // so that its front alone is seen

struct Materials {
  std::string walls{};
  std::string top{};
  std::string bottom{};
};

map::Face face(const std::array<Vec3, 3>& points, const std::string& material, const Vec3& u_axis,
               const Vec3& v_axis) {
  map::Face made;
  made.points = points;
  made.material = material;
  made.u_axis = u_axis;
  made.v_axis = v_axis;
  return made;
}

/// A box over a rectangle; the points of each face are clockwise as seen from outside.
map::Brush box(const Rectangle& floor, double low_m, double high_m, const Materials& materials) {
  const auto corner = [&](bool east, bool north, bool top) {
    const Vec3 metres(east ? floor.high.x() : floor.low.x(), north ? floor.high.y() : floor.low.y(),
                      top ? high_m : low_m);
    return Vec3((kUnitsPerMetre * metres).array().round());
  };
  const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
  map::Brush brush;
  brush.faces = {face({corner(true, true, true), corner(true, false, true), corner(false, false, true)},
                      materials.top, x, -y),
                 face({corner(true, false, false), corner(true, true, false), corner(false, true, false)},
                      materials.bottom, x, -y),
                 face({corner(true, false, true), corner(true, false, false), corner(false, false, false)},
                      materials.walls, x, -z),
                 face({corner(true, true, true), corner(true, true, false), corner(true, false, false)},
                      materials.walls, y, -z),
                 face({corner(false, true, true), corner(false, true, false), corner(true, true, false)},
                      materials.walls, x, -z),
                 face({corner(false, false, true), corner(false, false, false), corner(false, true, false)},
                      materials.walls, y, -z)};
  return brush;
}

/// What is cut out of the solid, and the cabinets.
struct Parts {
  std::vector<Rectangle> cuts{};
  std::vector<Rectangle> cabinets{};
};

void add_parts(const HallwaySide& side, Parts& parts) {
  for (const Section& section : side.sections) {
    if (section.set_back_m > 0.0)
      parts.cuts.push_back(side.rectangle(section.extent, 0.0, section.set_back_m));
    if (section.side_hallway) parts.cuts.push_back(*section.side_hallway);
    if (section.cabinet)
      parts.cabinets.push_back(side.rectangle(*section.cabinet, section.set_back_m - kCabinetProud_m,
                                              section.set_back_m + kCabinetInWall_m));
    if (!section.room || !section.doorway) continue;
    parts.cuts.push_back(*section.room);
    const Rectangle through = side.rectangle(*section.doorway, section.set_back_m, 0.0);
    Rectangle doorway = through;  // to where the room begins
    for (const int axis : {0, 1}) {
      if (side.behind[axis] > 0.0) doorway.high[axis] = section.room->low[axis];
      if (side.behind[axis] < 0.0) doorway.low[axis] = section.room->high[axis];
    }
    parts.cuts.push_back(doorway);
    if (section.cabinet_in_room) parts.cabinets.push_back(*section.cabinet_in_room);
  }
}

Parts parts_of(const Office& office) {
  Parts parts;
  for (const Rectangle& hallway : office.hallways()) parts.cuts.push_back(hallway);
  for (const HallwaySide& side : office.block) add_parts(side, parts);
  for (const HallwaySide& side : office.outside) add_parts(side, parts);
  return parts;
}

Rectangle around(const std::vector<Rectangle>& rectangles, double margin_m) {
  Rectangle all = rectangles.front();
  for (const Rectangle& one : rectangles) {
    all.low = all.low.cwiseMin(one.low);
    all.high = all.high.cwiseMax(one.high);
  }
  return {all.low.array() - margin_m, all.high.array() + margin_m};
}

map::Entity entity(const std::string& classname) {
  map::Entity made;
  made.add("classname", classname);
  return made;
}

std::string units(double length_m) {
  return format_double(std::round(kUnitsPerMetre * length_m));
}

}  // namespace

map::Document office_map(const Office& office) {
  const Parts parts = parts_of(office);
  const Materials walls{"wall_white", "ceiling_white", "floor_carpet"};
  const Materials black{"black_cabinet", "black_cabinet", "black_cabinet"};
  map::Entity world = entity("worldspawn");
  world.add("mapversion", "220");
  world.add("_hallway", "1");
  world.add("_scale", "0.01");
  world.brushes.push_back(box(around(parts.cuts, kSolid_m), -kSolid_m, kHeight_m + kSolid_m, walls));
  map::Entity rooms = entity("hw_subtract");
  rooms.add("order", "1");
  rooms.add("targetname", "rooms");
  for (const Rectangle& cut : parts.cuts) rooms.brushes.push_back(box(cut, 0.0, kHeight_m, walls));
  map::Document document;
  document.entities = {std::move(world), std::move(rooms)};
  if (!parts.cabinets.empty()) {
    map::Entity cabinets = entity("hw_detail");
    cabinets.add("order", "2");
    cabinets.add("targetname", "cabinets");
    for (const Rectangle& cabinet : parts.cabinets)
      cabinets.brushes.push_back(box(cabinet, 0.0, kCabinetHeight_m, black));
    document.entities.push_back(std::move(cabinets));
  }
  map::Entity start = entity("hw_robot_start");
  start.add("origin", units(office.start_m.x()) + " " + units(office.start_m.y()) + " 0");
  start.add("angle", "180");
  document.entities.push_back(std::move(start));
  return document;
}

std::string office_scenario(const std::vector<std::string>& about, const std::string& map,
                            const std::string& robot, OfficeFaults faults) {
  const bool faulty = faults == OfficeFaults::kUsual;
  const char* share = faulty ? "0.02" : "0";
  std::string text;
  for (const std::string& line : about) text += "# " + line + "\n";
  text += fmt::format(
      "schema = \"hallway.scenario/1\"\nmap = {}\nseed = 1\nsteps = 32000\nperiod_s = 0.05\n\n[robot]\nfile "
      "= {}\n\n"
      "[robot.drive]\nturn_slip = {}\nturn_slip_noise = {}\n\n[sensor.eyes]\nmounted = "
      "false\n\n[sensor.compass]\nmounted = false\n\n"
      "[sensor.sonar]\nmissed_rate = {}\nfalse_rate = {}\ncrosstalk = {}\n\n",
      toml_text(map), toml_text(robot), faulty ? "0.25" : "0", faulty ? "0.1" : "0", share, share, faulty);
  for (const char* detector : {"left", "front-left", "front", "front-right", "right"})
    text +=
        fmt::format("[sensor.ir-{}]\nrate_hz = 20\nnoise_per_m = {}\nmissed_rate = {}\nfalse_rate = {}\n\n",
                    detector, faulty ? "0.05" : "0", share, share);
  text += fmt::format("[material.\"*white*\"]\ninfrared = 0.9\nreflectance = 0.8\necho_deg = {}\n\n",
                      faulty ? "30" : "60");
  text +=
      "[material.\"*carpet*\"]\nreflectance = 0.3\n\n[material.\"*black*\"]\nreflectance = 0.05\ninfrared = "
      "0.03\n\n"
      "[[plugin]]\nname = \"wall_follower\"\n\n"
      "[[picture]]\nfile = \"top.png\"\nview = \"top\"\ncut_z_m = 1.2\nshow = [\"map\", \"truth\"]\n";
  return text;
}

namespace {

/// All of the files, or none where one cannot be written: a map beside the scenario of another office would pass for one.
void write_together(const std::vector<std::filesystem::path>& files, const std::vector<std::string>& texts) {
  std::vector<std::filesystem::path> parts;
  std::error_code none;
  try {
    for (std::size_t i = 0; i < files.size(); ++i) {
      parts.emplace_back(files[i].string() + ".part");
      write_file_atomically(parts[i], texts[i]);
    }
    for (std::size_t i = 0; i < files.size(); ++i) {
      std::error_code problem;
      std::filesystem::rename(parts[i], files[i], problem);
      if (problem)
        throw Error(ErrorCode::kIo, "cannot write: " + problem.message(), {.file = files[i].string()});
    }
  } catch (const Error&) {
    for (const std::filesystem::path& part : parts) std::filesystem::remove(part, none);
    throw;
  }
}

}  // namespace

std::vector<std::filesystem::path> office_files(const std::filesystem::path& map) {
  const auto beside = [&](const char* ending) { return map.parent_path() / (map.stem().string() + ending); };
  return {map, beside(".toml"), beside("_faults.toml"), beside("_robot.map")};
}

std::vector<std::filesystem::path> write_office(std::uint64_t seed, const std::filesystem::path& map,
                                                const std::filesystem::path& robot) {
  const Office office = plan_office(seed);
  const std::string robot_text = read_file(robot);
  std::vector<std::filesystem::path> files = office_files(map);
  const std::string map_name = files[0].filename().string(), robot_name = files[3].filename().string();
  const std::string what = fmt::format(
      "An office of hallway study first-robot, seed {}: {:.2f} m round its block.", seed, office.loop_m());
  write_together(files, {map::print(office_map(office)),
                         office_scenario({what, "No sensor reads falsely and no track slips."}, map_name,
                                         robot_name, OfficeFaults::kNone),
                         office_scenario({what, "Tracks and sensors have faults."}, map_name, robot_name,
                                         OfficeFaults::kUsual),
                         robot_text});
  return files;
}

}  // namespace hallway::study
