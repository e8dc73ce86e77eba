// SPDX-License-Identifier: MIT
#include "run/pictures/scan_layers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/text.hpp"
#include "render/colour.hpp"

namespace hallway::run {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr double kHit_px = 2.6;
constexpr std::size_t kColours = 16;

/// From low to high: even steps of lightness that are darker than the ground.
constexpr std::array<render::Rgb, 5> kRamp{
    {{24, 16, 120}, {30, 96, 190}, {0, 146, 110}, {214, 120, 0}, {176, 16, 50}}};

render::Rgb ramp_colour(std::size_t step) {
  const double at = static_cast<double>(step) / (kColours - 1) * (kRamp.size() - 1);
  const std::size_t low = std::min(kRamp.size() - 2, static_cast<std::size_t>(at));
  return render::mix(kRamp.at(low), kRamp.at(low + 1), at - static_cast<double>(low));
}

bool is_flat(const RecordedScan& scan) {
  constexpr double kLevel = 1e-3;
  const auto [low, high] = std::ranges::minmax_element(
      scan.rays, {}, [](const ScanRay& ray) { return std::asin(std::clamp(ray.direction.z(), -1.0, 1.0)); });
  return scan.rays.empty() || high->direction.z() - low->direction.z() < kLevel;
}

/// What the colours say.
enum class Meaning { kNothing, kHeight, kIntensity };

Meaning meaning_of(const std::vector<RecordedScan>& scans) {
  if (!std::ranges::all_of(scans, is_flat)) return Meaning::kHeight;
  const bool has_intensity = std::ranges::any_of(scans, [](const RecordedScan& scan) {
    return std::ranges::any_of(scan.rays, [](const ScanRay& ray) { return !std::isnan(ray.intensity); });
  });
  return has_intensity ? Meaning::kIntensity : Meaning::kNothing;
}

/// A hit with the number that its colour shows.
struct Hit {
  Vec3 place;
  double value = 0.0;
};

/// To a centimetre, without a minus before 0.00.
double rounded(double value_m) {
  return std::round(100.0 * value_m) / 100.0 + 0.0;
}

/// Dots in a colour for each step of the range of values.
void add_hits(render::Picture& picture, const std::vector<Hit>& hits, Meaning meaning,
              const std::string& label) {
  if (hits.empty()) return;
  const auto [least, greatest] = std::ranges::minmax_element(hits, {}, &Hit::value);
  const double low = least->value, width = greatest->value - low;
  std::array<render::Markers, kColours> steps{};
  for (std::size_t i = 0; i < kColours; ++i)
    steps.at(i) = {.colour = ramp_colour(i), .size_px = kHit_px, .label = label};
  for (const Hit& hit : hits) {
    const double share = width > 0.0 ? (hit.value - low) / width : 0.5;
    steps.at(std::min(kColours - 1, static_cast<std::size_t>(share * kColours)))
        .positions.push_back(hit.place);
  }
  for (render::Markers& step : steps) {
    if (!step.positions.empty()) picture.markers.push_back(std::move(step));
  }
  if (meaning == Meaning::kNothing || !(width > 0.0)) return;
  for (std::size_t i = 0; i < kColours; ++i) picture.scale.colours.push_back(ramp_colour(i));
  picture.scale.label = meaning == Meaning::kHeight
                            ? fmt::format("height {:.2f} to {:.2f} m", rounded(low), rounded(greatest->value))
                            : fmt::format("intensity {:.3g} to {:.3g}", low, greatest->value);
}

std::string hits_text(ScanPlacement wanted, bool all_placed, std::size_t sensors) {
  const std::string scan = sensors == 1 ? "scan" : "scans";
  if (wanted == ScanPlacement::kAsMeasured) return scan + " as measured";
  return all_placed ? scan + " deskewed" : scan + " as measured: no true motion to deskew by";
}

Vec3 shortened(const Vec3& from, const Vec3& to, double reach_m) {
  const Vec3 way = to - from;
  return way.norm() > reach_m ? Vec3(from + reach_m * way.normalized()) : to;
}

/// Whether each beam is drawn as what it covers: wide ones, as a sonar's, and the few of infrared detectors.
bool shows_each_beam(const RecordedScan& scan) {
  constexpr double kWide = 0.05;
  constexpr std::size_t kFew = 8;
  return scan.beam_rad >= kWide || scan.rays.size() <= kFew;
}

/// The edges of a beam from its head, and the arc at its range: what is there is somewhere on it. A narrow beam is a line.
/// @param up  the axis that the beam is spread about, unit
void add_sector(std::vector<std::array<Vec3, 2>>& lines, const Vec3& head, const Vec3& middle, const Vec3& up,
                double width_rad) {
  constexpr double kStep = std::numbers::pi / 60.0;
  if (!(width_rad > 0.0)) {
    lines.push_back({head, middle});
    return;
  }
  const int steps = std::max(1, static_cast<int>(std::ceil(width_rad / kStep)));
  const auto at = [&](int i) {
    const double turn = width_rad * (static_cast<double>(i) / steps - 0.5);
    return Vec3(head + Eigen::AngleAxisd(turn, up) * Vec3(middle - head));
  };
  lines.push_back({head, at(0)});
  for (int i = 0; i < steps; ++i) lines.push_back({at(i), at(i + 1)});
  lines.push_back({at(steps), head});
}

/// Where a beam ends that nothing was in the way of: not finite where its range is not known.
Vec3 free_end(const Vec3& from, const Vec3& end, const Pose& T_world_sensor, const ScanRay& ray,
              double reach_m) {
  if (end.allFinite()) return shortened(from, end, reach_m);
  return from + T_world_sensor.q * Vec3(reach_m * ray.direction);
}

}  // namespace

void add_scans(render::Picture& picture, const Scans& scans, ScanPlacement placement, double reach_m) {
  if (scans.scans.empty()) return;
  const Meaning meaning = meaning_of(scans.scans);
  std::vector<Hit> hits;
  render::Segments beams{.colour = render::palette::kSensor, .width_px = 0.8, .opacity = 0.22};
  render::Segments free{.colour = render::palette::kMutedInk,
                        .width_px = 0.8,
                        .opacity = 0.3,
                        .label = "beams without a return"};
  render::Segments sectors{.colour = render::palette::kSensor,
                           .width_px = 1.4,
                           .opacity = 0.8,
                           .label = "beams, up to what they met"};
  render::Segments free_sectors = free;
  free_sectors.width_px = 1.4;
  free_sectors.opacity = 0.7;
  bool all_placed = true;
  for (const RecordedScan& scan : scans.scans) {
    const PlacedScan placed = place_scan(scan, scans.motion, placement);
    all_placed = all_placed && placed.placement == placement;
    const bool flat = is_flat(scan);
    const Pose T_world_sensor = scan.T_world_body * scan.T_body_sensor;
    for (std::size_t i = 0; i < scan.rays.size(); ++i) {
      const ScanRay& ray = scan.rays[i];
      const bool is_hit = std::isfinite(ray.range_m);
      if (is_hit) {
        const double intensity = std::isnan(ray.intensity) ? 0.0 : static_cast<double>(ray.intensity);
        hits.push_back({placed.ends[i], meaning == Meaning::kHeight      ? placed.ends[i].z()
                                        : meaning == Meaning::kIntensity ? intensity
                                                                         : 0.0});
      }
      if (shows_each_beam(scan)) {
        const Vec3 end = is_hit ? placed.ends[i]
                                : free_end(placed.origins[i], placed.ends[i], T_world_sensor, ray, reach_m);
        add_sector((is_hit ? sectors : free_sectors).pairs, placed.origins[i], end,
                   T_world_sensor.q * Vec3::UnitZ(), scan.beam_rad);
        continue;
      }
      if (!flat) continue;
      const Vec3 end =
          is_hit ? placed.ends[i] : free_end(placed.origins[i], placed.ends[i], T_world_sensor, ray, reach_m);
      (is_hit ? beams : free).pairs.push_back({placed.origins[i], end});
    }
  }
  for (render::Segments* lines : {&free, &beams, &free_sectors, &sectors}) {
    if (!lines->pairs.empty()) picture.segments.push_back(std::move(*lines));
  }
  add_hits(picture, hits, meaning, hits_text(placement, all_placed, scans.scans.size()));
}

std::optional<Sector> sector_of(const RecordedScan& scan) {
  if (scan.rays.empty()) return std::nullopt;
  std::vector<double> azimuths;
  for (const ScanRay& ray : scan.rays) azimuths.push_back(std::atan2(ray.direction.y(), ray.direction.x()));
  std::ranges::sort(azimuths);
  double widest = azimuths.front() + kTurn - azimuths.back(), next = 0.0, from = azimuths.front();
  for (std::size_t i = 1; i < azimuths.size(); ++i) {
    const double gap = azimuths[i] - azimuths[i - 1];
    next = std::max(next, std::min(gap, widest));
    if (gap <= widest) continue;
    widest = gap;
    from = azimuths[i];
  }
  // A few beams without an answer leave gaps as well.
  constexpr double kLeastGap = 0.1;
  if (widest < kLeastGap || widest <= 2.0 * next) return Sector{-std::numbers::pi, kTurn};
  return Sector{from, kTurn - widest};
}

void add_sectors(render::Picture& picture, const Scans& scans, double reach_m) {
  constexpr double kStep = std::numbers::pi / 90.0;
  for (const RecordedScan& scan : scans.scans) {
    const auto sector = sector_of(scan);
    if (!sector) continue;
    const bool whole = sector->width_rad >= kTurn, ends = scan.max_range_m <= reach_m;
    if (whole && !ends) continue;
    const double range_m = std::min(scan.max_range_m, reach_m);
    const Pose T_world_sensor = scan.T_world_body * scan.T_body_sensor;
    const auto at = [&](double azimuth) {
      return Vec3(T_world_sensor * Vec3(range_m * Vec3(std::cos(azimuth), std::sin(azimuth), 0.0)));
    };
    render::Segments lines{.colour = render::palette::kSensor,
                           .width_px = 1.6,
                           .label = "field of view of " + printable(scan.sensor, 40)};
    const double to = sector->from_rad + sector->width_rad;
    if (!whole) lines.pairs = {{T_world_sensor.t, at(sector->from_rad)}, {T_world_sensor.t, at(to)}};
    const int steps = std::max(1, static_cast<int>(std::ceil(sector->width_rad / kStep)));
    for (int i = 0; ends && i < steps; ++i)
      lines.pairs.push_back({at(sector->from_rad + sector->width_rad * i / steps),
                             at(sector->from_rad + sector->width_rad * (i + 1) / steps)});
    picture.segments.push_back(std::move(lines));
  }
}

}  // namespace hallway::run
