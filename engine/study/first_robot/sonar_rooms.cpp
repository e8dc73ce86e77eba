// SPDX-License-Identifier: MIT
#include "study/first_robot/sonar_rooms.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "study/curves.hpp"
#include "study/statistics.hpp"

namespace hallway::study {
namespace {

constexpr const char* kSonarFigures = "11, 12";
constexpr double kDegPerRad = 180.0 / std::numbers::pi;

/// Sweeps without faults, then as many with.
std::vector<LabelledSweep> both_sweeps(const SonarRoomsRequest& request, std::uint64_t first_seed) {
  std::vector<LabelledSweep> all;
  for (const bool faults : {false, true}) {
    const OpeningSonar sonar =
        sonar_of_scenario(request.maps / (faults ? "cubicles_faults.toml" : "cubicles.toml"));
    for (LabelledSweep& sweep : sweep_openings(request.each, first_seed, sonar, request.threads)) {
      sweep.faults = faults;
      all.push_back(std::move(sweep));
    }
  }
  return all;
}

std::vector<LabelledSweep> with_faults(const std::vector<LabelledSweep>& sweeps, bool faults) {
  std::vector<LabelledSweep> some;
  for (const LabelledSweep& sweep : sweeps) {
    if (sweep.faults == faults) some.push_back(sweep);
  }
  return some;
}

Table sweeps_table(const std::vector<LabelledSweep>& sweeps, const SonarRoomsRequest& request,
                   const SweepRuleParameters& best) {
  Table table{.file = "sweeps",
              .columns = {"kind", "seed", "faults", "width_m", "depth_m", "across_m", "cluttered", "wall_m",
                          "along_m", "slant_deg", "said", "said_with_present"}};
  for (const LabelledSweep& sweep : sweeps) {
    const LabelledOpening& opening = sweep.opening;
    table.add({name_of(opening.kind), static_cast<double>(sweep.seed), sweep.faults ? "yes" : "no",
               opening.width_m, opening.depth_m, opening.across_m, opening.is_cluttered ? "yes" : "no",
               opening.wall_m, opening.along_m, opening.slant_rad * kDegPerRad,
               name_of(request.rule(sweep, best)), name_of(request.rule(sweep, request.present))});
  }
  return table;
}

void add_confusion(const std::string& parameters, const std::string& openings, const std::string& faults,
                   const Confusion& confusion, Table& table) {
  for (const OpeningKind truth : kOpeningKinds) {
    std::vector<Field> row{parameters, openings, faults, name_of(truth)};
    for (const OpeningKind said : kOpeningKinds)
      row.emplace_back(static_cast<double>(confusion.of(truth, said)));
    table.add(std::move(row));
  }
}

Table rule_table(const Calibration& calibration, const SweepRuleParameters& present) {
  Table table{.file = "parameters", .columns = {"parameter", "value", "low", "high", "present", "unit"}};
  const auto add = [&](const char* name, double SweepRuleParameters::*member, const char* unit) {
    table.add({name, calibration.best.*member, calibration.low.*member, calibration.high.*member,
               present.*member, unit});
  };
  add("cover_m", &SweepRuleParameters::cover_m, "m");
  add("room_depth_m", &SweepRuleParameters::room_depth_m, "m");
  add("sweep_window_deg", &SweepRuleParameters::window_deg, "deg");
  return table;
}

void add_findings(const std::string& of, const Confusion& confusion, Findings& findings) {
  const auto add = [&](const std::string& what, std::uint64_t errors, std::uint64_t of_all) {
    if (const auto share = share_interval(errors, of_all))
      findings.add(kSonarFigures, of, what, share->value, share->low, share->high, "1");
  };
  add("share of all openings classified wrongly", confusion.errors(), confusion.total());
  add("share of rooms classified as hallways", confusion.of(OpeningKind::kRoom, OpeningKind::kHallway),
      confusion.of(OpeningKind::kRoom));
  add("share of hallways classified as rooms", confusion.of(OpeningKind::kHallway, OpeningKind::kRoom),
      confusion.of(OpeningKind::kHallway));
  add("share of covered openings classified as open", confusion.wrong(OpeningKind::kCovered),
      confusion.of(OpeningKind::kCovered));
}

/// Shares of errors over room_depth_m, all else as fitted.
Chart depth_chart(const std::vector<LabelledSweep>& sweeps, const SonarRoomsRequest& request,
                  SweepRuleParameters parameters) {
  Series rooms{.name = "rooms classified as hallways", .colour = series_colour(0)};
  Series hallways{.name = "hallways classified as rooms", .colour = series_colour(1)};
  Series all{
      .name = "all openings classified wrongly", .style = SeriesStyle::kDashed, .colour = series_colour(2)};
  for (const double depth_m : default_sweep_rule_grid().room_depth_m) {
    parameters.room_depth_m = depth_m;
    const Confusion confusion = confusion_of(sweeps, request.rule, parameters);
    const auto share = [](std::uint64_t part, std::uint64_t whole) {
      return whole > 0 ? static_cast<double>(part) / static_cast<double>(whole) : std::nan("");
    };
    rooms.points.emplace_back(depth_m, share(confusion.of(OpeningKind::kRoom, OpeningKind::kHallway),
                                             confusion.of(OpeningKind::kRoom)));
    hallways.points.emplace_back(depth_m, share(confusion.of(OpeningKind::kHallway, OpeningKind::kRoom),
                                                confusion.of(OpeningKind::kHallway)));
    all.points.emplace_back(depth_m, share(confusion.errors(), confusion.total()));
  }
  return {.file = "errors_by_room_depth",
          .title = "Rule of rooms and hallways: errors on openings that it was not fitted on",
          .figures = kSonarFigures,
          .x = {"parameter room_depth_m, m"},
          .y = {"share classified wrongly"},
          .series = {rooms, hallways, all}};
}

/// Shares of errors by the true depth, in parts of half a metre.
Chart true_depth_chart(const std::vector<LabelledSweep>& sweeps, const SonarRoomsRequest& request,
                       const SweepRuleParameters& parameters) {
  constexpr double kPart_m = 0.5;
  Chart chart{.file = "errors_by_true_depth",
              .title = "Rule of rooms and hallways: errors by true depth, calibrated",
              .figures = kSonarFigures,
              .x = {"true depth behind the wall's line, m"},
              .y = {"share classified wrongly"}};
  for (const OpeningKind kind : {OpeningKind::kRoom, OpeningKind::kHallway}) {
    Series series{.name = name_of(kind) + "s", .colour = series_colour(kind == OpeningKind::kRoom ? 0 : 1)};
    for (int part = 0; part < 24; ++part) {
      std::uint64_t wrong = 0, trials = 0;
      for (const LabelledSweep& sweep : sweeps) {
        if (sweep.opening.kind != kind || static_cast<int>(sweep.opening.depth_m / kPart_m) != part) continue;
        ++trials;
        wrong += request.rule(sweep, parameters) != kind ? 1u : 0u;
      }
      if (trials > 0)
        series.points.emplace_back(kPart_m * (part + 0.5),
                                   static_cast<double>(wrong) / static_cast<double>(trials));
    }
    chart.series.push_back(std::move(series));
  }
  return chart;
}

/// What the robot knows of an opening after it has passed it, or turned into it.
SweepRule with_length(const SweepRule& rule, double longest_doorway_m) {
  return [rule, longest_doorway_m](const LabelledSweep& sweep, const SweepRuleParameters& parameters) {
    const OpeningKind said = rule(sweep, parameters);
    const bool is_long = said == OpeningKind::kRoom && sweep.opening.width_m > longest_doorway_m;
    return is_long ? OpeningKind::kHallway : said;
  };
}

void add_sweep_charts(const std::vector<LabelledSweep>& sweeps, std::vector<Chart>& charts) {
  for (const auto& [kind, figures] :
       {std::pair(OpeningKind::kHallway, "11"), std::pair(OpeningKind::kRoom, "12")}) {
    for (const LabelledSweep& sweep : sweeps) {
      if (sweep.opening.kind != kind || sweep.faults) continue;
      charts.push_back(sweep_chart(sweep, "sweep_" + name_of(kind), figures));
      break;
    }
  }
}

}  // namespace

Study sonar_rooms_study() {
  return {.name = "sonar-rooms",
          .figures = kSonarFigures,
          .about = "Calibrate the rule by which the first robot distinguishes rooms from hallways (2.2.4)",
          .size = "2400 openings to fit on, 2400 to check"};
}

SonarRoomsResult study_sonar_rooms(const SonarRoomsRequest& request) {
  const std::vector<LabelledSweep> to_fit = both_sweeps(request, request.first_seed);
  const std::vector<LabelledSweep> to_check = both_sweeps(request, request.first_seed + request.each);
  SonarRoomsResult result{.calibration =
                              calibrate(to_fit, request.rule, default_sweep_rule_grid(), request.threads)};
  const SweepRuleParameters& best = result.calibration.best;
  result.fitted = confusion_of(to_fit, request.rule, best);
  result.checked = confusion_of(to_check, request.rule, best);
  result.present = confusion_of(to_check, request.rule, request.present);
  Table confusions{.file = "confusion",
                   .columns = {"parameters", "openings", "faults", "truth", "covered", "room", "hallway"}};
  for (const bool faults : {false, true}) {
    const auto fit = with_faults(to_fit, faults), check = with_faults(to_check, faults);
    const char* name = faults ? "yes" : "no";
    add_confusion("calibrated", "fitted on", name, confusion_of(fit, request.rule, best), confusions);
    add_confusion("calibrated", "others", name, confusion_of(check, request.rule, best), confusions);
    add_confusion("present", "others", name, confusion_of(check, request.rule, request.present), confusions);
  }
  Findings findings(false);
  add_findings("calibrated, other openings", result.checked, findings);
  add_findings("present, other openings", result.present, findings);
  add_findings("calibrated, openings fitted on", result.fitted, findings);
  const SweepRule then_length = with_length(request.rule, request.longest_doorway_m);
  add_findings("calibrated, then by length, other openings", confusion_of(to_check, then_length, best),
               findings);
  add_findings("present, then by length, other openings",
               confusion_of(to_check, then_length, request.present), findings);
  result.outcome.tables = {findings.take(), rule_table(result.calibration, request.present),
                           std::move(confusions), sweeps_table(to_check, request, best)};
  result.outcome.charts = {depth_chart(to_check, request, best), true_depth_chart(to_check, request, best)};
  add_sweep_charts(to_check, result.outcome.charts);
  return result;
}

Chart sweep_chart(const LabelledSweep& sweep, const std::string& file, const std::string& figures) {
  const LabelledOpening& opening = sweep.opening;
  Chart chart{.file = file,
              .title = fmt::format("Sweep at a {}, {:.1f} m deep", name_of(opening.kind), opening.depth_m),
              .figures = figures,
              .x = {"along the followed wall, m"},
              .y = {"from the followed wall, m"},
              .equal_scales = true};
  const double nothing = std::nan("");
  Series walls{.name = "walls", .colour = render::palette::kInk};
  Series furniture{.name = "furniture", .colour = series_colour(5)};
  // What is far along the hallway would make all else small.
  constexpr double kShown_m = 3.5;
  for (const PlanBox& box : opening.boxes) {
    const double low = std::max(box.low.x(), -kShown_m),
                 high = std::min(box.high.x(), kShown_m + opening.width_m);
    auto& points = (box.is_wall ? walls : furniture).points;
    for (const Vec2& corner : {Vec2(low, box.low.y()), Vec2(high, box.low.y()), Vec2(high, box.high.y()),
                               Vec2(low, box.high.y()), Vec2(low, box.low.y()), Vec2(nothing, nothing)})
      points.push_back(corner);
  }
  const Vec2 robot(opening.along_m, opening.wall_m);
  Series pings{.name = "pings with an echo", .colour = series_colour(0)};
  Series echoes{
      .name = "echo, drawn at the beam's middle", .style = SeriesStyle::kMarks, .colour = series_colour(1)};
  for (const HeardPing& ping : sweep.pings) {
    if (!std::isfinite(ping.range_m)) continue;
    const double angle = opening.slant_rad + ping.direction_rad;
    const Vec2 end = robot + ping.range_m * Vec2(std::cos(angle), std::sin(angle));
    for (const Vec2& point : {robot, end, Vec2(nothing, nothing)}) pings.points.push_back(point);
    echoes.points.push_back(end);
  }
  Series body{.name = "robot", .style = SeriesStyle::kMarks, .colour = series_colour(2)};
  body.points.push_back(robot);
  chart.series = {walls, pings, echoes, body};
  if (!furniture.points.empty()) chart.series.push_back(furniture);
  return chart;
}

}  // namespace hallway::study
