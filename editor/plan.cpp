// SPDX-License-Identifier: MIT
#include "editor/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <set>

#include "base/error.hpp"
#include "base/refuse.hpp"
#include "base/text.hpp"
#include "editor/command.hpp"
#include "editor/selection.hpp"
#include "map/entities.hpp"
#include "map/occupants.hpp"
#include "map/path.hpp"
#include "map/start_check.hpp"
#include "map/world.hpp"

namespace hallway::editor {
namespace {

/// What is nearer to a thing than this does not hide it: the floor that it stands on, the lamp that it hangs from.
constexpr double kTouching = 0.1;
constexpr std::size_t kLongestName = 60;

/// Whether nothing is between a place and the cut.
bool is_seen(const PlanColumns& columns, const Vec3& place, double height) {
  const double low = std::min(place.z(), height), high = std::max(place.z(), height);
  return place.z() < height ? !columns.blocked(place.head<2>(), low + kTouching, high)
                            : !columns.blocked(place.head<2>(), low, high - kTouching);
}

/// Whether a place is in a section, by the even-odd rule.
bool is_inside(const Section& section, const Vec2& at) {
  bool inside = false;
  for (const auto& loop : section.loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Vec2& a = loop[i];
      const Vec2& b = loop[(i + 1) % loop.size()];
      if ((a.y() > at.y()) != (b.y() > at.y()) &&
          at.x() < a.x() + (at.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()))
        inside = !inside;
    }
  }
  return inside;
}

/// The widest stretch across a section that has solid at both its ends, these within a box. @param axis  along which: 0 or 1
std::optional<PlanLine> widest_gap(const Section& section, const PlanBox& box, Eigen::Index axis) {
  const Eigen::Index other = 1 - axis;
  std::optional<PlanLine> widest;
  double most = 0.0;
  for (const double share : {0.25, 0.75, 0.35, 0.65, 0.15, 0.85, 0.5}) {
    const double across = box.min()[other] + share * box.sizes()[other];
    std::vector<double> ends;
    for (const auto& loop : section.loops) {
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const Vec2& a = loop[i];
        const Vec2& b = loop[(i + 1) % loop.size()];
        if ((a[other] > across) != (b[other] > across))
          ends.push_back(a[axis] + (across - a[other]) / (b[other] - a[other]) * (b[axis] - a[axis]));
      }
    }
    std::ranges::sort(ends);
    for (std::size_t i = 1; i + 1 < ends.size(); i += 2) {
      const bool within = ends[i] > box.min()[axis] && ends[i + 1] < box.max()[axis];
      if (!within || ends[i + 1] - ends[i] <= most + 1e-6) continue;
      most = ends[i + 1] - ends[i];
      widest.emplace();
      widest->from[axis] = ends[i];
      widest->to[axis] = ends[i + 1];
      widest->from[other] = widest->to[other] = across;
    }
  }
  if (widest && most < 0.5 * box.sizes()[axis]) return std::nullopt;
  return widest;
}

/// Collects what a plan shows of a map.
class PlanMaker {
 public:
  PlanMaker(const State& state, const std::string& file, double height)
      : state_(state), document_(document_of(state, file)), scale_(units_of(state).metres_per_unit) {
    plan_.height_m = height;
    plan_.title = printable(std::filesystem::path(file).filename().string(), kLongestName);
    world_ = map::build_world(document_);
    surface_ = csg::build_surface(world_);
  }

  FloorPlan make() {
    const double height = plan_.height_m;
    plan_.section = section_at(surface_, height);
    if (plan_.section.loops.empty()) refuse_height();
    const PlanColumns columns(surface_);
    columns_ = &columns;
    plan_.below = edges_below(surface_, columns, height);
    add_starts();
    add_lights();
    add_paths();
    for (std::size_t e = 0; e < state_.entities.size(); ++e) add_name(e);
    for (const map::Problem& problem : world_.problems) {
      if (!problem.left_out) continue;
      plan_.notes.push_back(map::brush_name(problem.entity, problem.brush) + ": " +
                            map::problem_text(problem));
    }
    return std::move(plan_);
  }

 private:
  [[noreturn]] void refuse_height() const {
    if (surface_.vertices.empty())
      refuse("height: there is nothing solid in the map, so there is no plan of it");
    double low = surface_.vertices.front().z(), high = low;
    for (const Vec3& vertex : surface_.vertices) {
      low = std::min(low, vertex.z());
      high = std::max(high, vertex.z());
    }
    refuse(
        "height: nothing is solid at {} m; what is solid reaches from "
        "{} to {} m",
        sheet_number(plan_.height_m), sheet_number(low), sheet_number(high));
  }

  template <typename F>
  void or_note(const std::string& what, const F& add) {
    try {
      add();
    } catch (const Error& error) {
      plan_.notes.push_back(fmt::format("{} is not drawn: {}", what, error.what()));
    }
  }

  void add_starts() {
    or_note("a robot start", [&] {
      const auto starts = map::robot_starts(document_);
      if (const auto off = map::start_off_all_paths(document_))
        plan_.notes.push_back("warning: " + map::start_off_path_text(*off));
      for (const map::RobotStart& start : starts) {
        if (!is_seen(*columns_, start.T_world_body.t, plan_.height_m)) continue;
        const Vec3 ahead = start.T_world_body.q * Vec3::UnitX();
        plan_.starts.push_back({start.T_world_body.t.head<2>(), ahead.head<2>().normalized()});
      }
    });
  }

  void add_lights() {
    for (const auto& entity : state_.entities) {
      if (!entity->classname().starts_with("light")) continue;
      const auto origin = origin_of(*entity);
      if (origin && is_seen(*columns_, *origin * scale_, plan_.height_m))
        plan_.lights.emplace_back((*origin * scale_).head<2>());
    }
  }

  void add_paths() {
    for (const auto& entity : state_.entities) {
      if (entity->classname() != "hw_path") continue;
      const std::string& name = entity->value("name");
      or_note(fmt::format("path \"{}\"", printable(name)),
              [&] { add_path(map::find_path(document_, name)); });
    }
  }

  /// The stretches of a path that are seen, in steps of a decimetre or, of one without end, in ten thousand.
  void add_path(const map::Path& path) {
    constexpr double kStep = 0.1, kMostSteps = 10000.0;
    const auto steps = static_cast<int>(std::clamp(std::ceil(path.length_m() / kStep), 1.0, kMostSteps));
    std::vector<Vec2> line;
    const auto end = [&] {
      if (line.size() > 1) plan_.paths.push_back(std::move(line));
      line.clear();
    };
    for (int i = 0; i <= steps; ++i) {
      const Vec3 at = path.at(path.length_m() * i / steps).t;
      if (!is_seen(*columns_, at, plan_.height_m)) {
        end();
        continue;
      }
      const Vec2 place = at.head<2>();
      // On the straight only the ends count.
      if (line.size() > 1) {
        const Vec2 before = line.back() - line[line.size() - 2], now = place - line.back();
        if (before.dot(now) > 0.0 &&
            std::abs(before.x() * now.y() - before.y() * now.x()) < 1e-6 * before.norm() * now.norm())
          line.pop_back();
      }
      line.push_back(place);
    }
    end();
  }

  /// What the members of a group add, metres; empty where they add nothing.
  Box solid_bounds(const std::vector<Thing>& members) const {
    Box box;
    for (const Thing& member : members) {
      const EntityItem& entity = *state_.entities[member.entity];
      if (entity.brushes.empty() || entity.classname() == "hw_subtract") continue;
      box.extend(bounds_of(state_, member));
    }
    if (!box.isEmpty()) box = Box(box.min() * scale_, box.max() * scale_);
    return box;
  }

  void add_name(std::size_t index) {
    const EntityItem& entity = *state_.entities[index];
    const std::string name = name_of(entity);
    if (name.empty() || !group_number(entity)) return;
    const auto members = with_members(state_, {Thing{index, {}}});
    const Box box = solid_bounds(members);
    if (box.isEmpty() || box.min().z() > plan_.height_m) return;
    const PlanBox flat(box.min().head<2>(), box.max().head<2>());
    const bool is_cut = box.max().z() > plan_.height_m;
    PlanName label{.text = printable(name, kLongestName), .at = flat.center()};
    const bool is_room = is_cut && add_widths(members, flat);
    const auto places = places_in(flat);
    const auto open =
        std::ranges::find_if(places, [&](const Vec2& at) { return !is_inside(plan_.section, at); });
    if (is_room && open != places.end()) {
      label.at = *open;
    } else if (!is_cut && std::ranges::all_of(places, [&](const Vec2& at) {
                 return columns_->blocked(at, box.max().z() + 1e-6, plan_.height_m);
               })) {
      return;
    } else if (is_inside(plan_.section, label.at)) {
      label.beside = true;
      label.upwards = flat.sizes().y() > flat.sizes().x();
      label.at = label.upwards ? Vec2(flat.min().x(), label.at.y()) : Vec2(label.at.x(), flat.max().y());
    }
    plan_.names.push_back(std::move(label));
  }

  /// The middle of a box, then places around it.
  static std::vector<Vec2> places_in(const PlanBox& box) {
    std::vector<Vec2> places{box.center()};
    for (const double away : {0.08, 0.15, 0.25, 0.35}) {
      for (const Vec2& way : {Vec2(0, 1), Vec2(0, -1), Vec2(-1, 0), Vec2(1, 0)})
        places.emplace_back(box.center() + away * way.cwiseProduct(box.sizes()));
    }
    return places;
  }

  /// Adds how wide a room is: a group that is no group of groups, and has walls on all sides. Whether it is one.
  bool add_widths(const std::vector<Thing>& members, const PlanBox& box) {
    const auto groups = std::ranges::count_if(members, [&](const Thing& member) {
      return !member.brush && group_number(*state_.entities[member.entity]);
    });
    const auto across = widest_gap(plan_.section, box, 0), along = widest_gap(plan_.section, box, 1);
    if (groups != 1 || !across || !along) return false;
    plan_.widths.push_back(*across);
    plan_.widths.push_back(*along);
    return true;
  }

  const State& state_;
  map::Document document_;
  double scale_;
  map::World world_;
  csg::Surface surface_;
  const PlanColumns* columns_ = nullptr;
  FloorPlan plan_;
};

}  // namespace

PlanBox FloorPlan::bounds() const {
  PlanBox box = section.bounds();
  for (const PlanLine& line : below) box.extend(line.from).extend(line.to);
  for (const auto& path : paths) {
    for (const Vec2& point : path) box.extend(point);
  }
  for (const Vec2& light : lights) box.extend(light);
  for (const PlanStart& start : starts) box.extend(start.at);
  return box;
}

FloorPlan make_plan(const State& state, const std::string& file, double height_m) {
  return PlanMaker(state, file, height_m).make();
}

}  // namespace hallway::editor
