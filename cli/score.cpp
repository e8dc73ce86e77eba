// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "base/error.hpp"
#include "base/refuse.hpp"
#include "base/text.hpp"
#include "command.hpp"
#include "console.hpp"
#include "eval/association.hpp"
#include "eval/metrics_json.hpp"
#include "eval/path_error.hpp"
#include "eval/path_verdict.hpp"
#include "import/trajectory_file.hpp"
#include "shared_options.hpp"

namespace hallway::cli {
namespace {

using eval::Alignment;
using eval::PosePair;
using import::ForeignTrajectory;
using import::TrajectoryFormat;

struct ScoreOptions {
  std::string reference;
  std::string estimate;
  std::string format;
  std::string reference_format;
  std::string estimate_format;
  std::string times;
  double max_difference_s = 0.02;
  double time_offset_s = 0.0;
  std::string align = "se3";
  std::string delta = "1f,1m,1s";
  bool json = false;
};

constexpr std::pair<const char*, Alignment> kAlignments[] = {{"none", Alignment::kNone},
                                                             {"first", Alignment::kFirstPose},
                                                             {"se3", Alignment::kRigid},
                                                             {"sim3", Alignment::kSimilarity}};

Alignment alignment_of(const std::string& name) {
  for (const auto& [known, alignment] : kAlignments) {
    if (name == known) return alignment;
  }
  return Alignment::kRigid;
}

/// A file that is scored.
struct ScoredFile {
  std::string file;
  ForeignTrajectory trajectory;
  bool has_times = true;

  std::vector<double> times() const {
    std::vector<double> times;
    for (const log::StampedPose& pose : trajectory.poses) times.push_back(pose.t_s);
    return times;
  }
};

ScoredFile read_input(const std::string& file, const std::string& format, const ScoreOptions& options) {
  ScoredFile input{.file = file,
                   .trajectory = import::read_trajectory(
                       file, import::trajectory_format(format.empty() ? options.format : format))};
  if (input.trajectory.cut_off)
    print_warning(path_text(file) + ": the last line has no line end: the file may be cut off");
  input.has_times = input.trajectory.format != TrajectoryFormat::kKitti;
  if (input.has_times || options.times.empty()) return input;
  const std::vector<double> times = import::read_times(options.times);
  if (times.size() != input.trajectory.poses.size())
    throw Error(ErrorCode::kBadInput,
                fmt::format("{} times, and {} has {} poses", times.size(), path_text(file),
                            input.trajectory.poses.size()),
                {.file = options.times});
  for (std::size_t i = 0; i < times.size(); ++i) input.trajectory.poses[i].t_s = times[i];
  input.has_times = true;
  return input;
}

/// One delta of `--delta`: "10f", "0.5m", "1s".
eval::Delta parse_delta(std::string_view text) {
  const auto bad = [&] {
    return Error(
        ErrorCode::kUsage,
        fmt::format("--delta takes lengths such as 1f (frames), 0.5m (metres), 1s (seconds), not \"{}\"",
                    printable(text)));
  };
  if (text.empty()) throw bad();
  const auto value = parse_double(text.substr(0, text.size() - 1));
  if (!value || !(*value > 0.0)) throw bad();
  switch (text.back()) {
    case 'f':
      if (*value != std::floor(*value) || *value > 1e9) throw bad();
      return {*value, eval::DeltaUnit::kFrames};
    case 'm':
      return {*value, eval::DeltaUnit::kMetres};
    case 's':
      return {*value, eval::DeltaUnit::kSeconds};
    default:
      throw bad();
  }
}

const char* unit_of(const eval::Delta& delta) {
  switch (delta.unit) {
    case eval::DeltaUnit::kFrames:
      return "frames";
    case eval::DeltaUnit::kMetres:
      return "metres";
    case eval::DeltaUnit::kSeconds:
      return "seconds";
  }
  return "";
}

std::vector<eval::Match> match(const ScoredFile& reference, const ScoredFile& estimate,
                               const ScoreOptions& options) {
  std::vector<double> theirs = estimate.times();
  if (!reference.has_times || !estimate.has_times) {
    if (reference.has_times != estimate.has_times)
      refuse("a KITTI file has no times, and the other file has: --pose-times gives them");
    if (reference.trajectory.poses.size() != estimate.trajectory.poses.size())
      throw Error(ErrorCode::kBadInput,
                  fmt::format("{} poses, and {} has {}: KITTI files are paired line by line",
                              estimate.trajectory.poses.size(), path_text(reference.file),
                              reference.trajectory.poses.size()),
                  {.file = estimate.file});
    return eval::associate(reference.times(), theirs, 0.0);
  }
  for (double& t_s : theirs) t_s += options.time_offset_s;
  const std::vector<double> times = reference.times();
  auto matches = eval::associate(times, theirs, options.max_difference_s);
  if (matches.empty())
    throw Error(
        ErrorCode::kBadInput,
        fmt::format("no pose is within {} s of one of {}: times are {} to {} s here and {} to {} s there",
                    format_double(options.max_difference_s), path_text(reference.file),
                    format_double(theirs.front()), format_double(theirs.back()), format_double(times.front()),
                    format_double(times.back())),
        {.file = estimate.file});
  return matches;
}

Pose pose_of(const log::StampedPose& pose) {
  const auto& q = pose.orientation;
  return {Quat(q[0], q[1], q[2], q[3]).normalized(), Vec3(pose.position_m.data())};
}

std::vector<PosePair> pair_up(const ScoredFile& reference, const ScoredFile& estimate,
                              const std::vector<eval::Match>& matches) {
  const auto& truth = reference.trajectory.poses;
  std::vector<double> travelled_m{0.0};
  for (std::size_t i = 1; i < truth.size(); ++i)
    travelled_m.push_back(travelled_m.back() +
                          (Vec3(truth[i].position_m.data()) - Vec3(truth[i - 1].position_m.data())).norm());
  std::vector<PosePair> pairs;
  for (const eval::Match& match : matches)
    pairs.push_back({pose_of(truth[match.reference]), pose_of(estimate.trajectory.poses[match.estimate]),
                     truth[match.reference].t_s, travelled_m[match.reference]});
  return pairs;
}

/// Share of the reference's time that lies between successive pairs, gaps left out: what is longer than five times the median.
double covered_share(const std::vector<PosePair>& pairs, const ScoredFile& reference) {
  constexpr double kGap = 5.0;
  const auto& truth = reference.trajectory.poses;
  const double whole = truth.back().t_s - truth.front().t_s;
  if (!(whole > 0.0)) return 1.0;
  std::vector<double> steps;
  for (std::size_t i = 1; i < pairs.size(); ++i) steps.push_back(pairs[i].t_s - pairs[i - 1].t_s);
  const auto usual = eval::statistics_of(steps);
  double covered = 0.0;
  for (const double step : steps) covered += step <= kGap * usual->median ? step : 0.0;
  return std::min(covered / whole, 1.0);
}

/// All that is said of two trajectories.
struct Score {
  const ScoredFile& reference;
  const ScoredFile& estimate;
  std::vector<PosePair> pairs{};
  double coverage = 0.0;  ///< of the reference's time
  eval::PathFit fit{};
  eval::PathError absolute{};
  std::vector<std::pair<eval::Delta, eval::PathError>> relative{};
  std::optional<eval::Divergence> divergence{};
  std::optional<eval::PathVerdict> verdict{};
};

/// As of runs, but for the share of time in the place of that of frames, and without orientations.
std::optional<eval::PathVerdict> judge(const Score& score) {
  constexpr double kLostBelow = 0.5;
  if (score.divergence && score.divergence->diverged()) return eval::PathVerdict::kDiverged;
  if (score.coverage < kLostBelow) return eval::PathVerdict::kLost;
  if (!score.divergence) return std::nullopt;
  return eval::PathVerdict::kOk;
}

Score score_of(const ScoredFile& reference, const ScoredFile& estimate, const ScoreOptions& options) {
  Score score{.reference = reference, .estimate = estimate};
  const Alignment alignment = alignment_of(options.align);
  score.pairs = pair_up(reference, estimate, match(reference, estimate, options));
  score.coverage = covered_share(score.pairs, reference);
  try {
    score.fit = eval::align(score.pairs, alignment);
  } catch (const Error& error) {
    throw Error(error.code(), error.message(), {.file = estimate.file});
  }
  score.absolute = eval::absolute_error(score.pairs, score.fit);
  for (const std::string_view text : split(options.delta, ',')) {
    const eval::Delta delta = parse_delta(trim(text));
    const bool without_times = !reference.has_times && delta.unit == eval::DeltaUnit::kSeconds;
    score.relative.emplace_back(
        delta, without_times ? eval::PathError{} : eval::relative_error(score.pairs, delta, score.fit.scale));
  }
  std::vector<Vec3> true_path;
  for (const log::StampedPose& pose : reference.trajectory.poses)
    true_path.emplace_back(pose.position_m.data());
  score.divergence = eval::divergence_of(score.pairs, eval::extent_of(true_path), eval::Judged::kPositions,
                                         alignment == Alignment::kSimilarity ? alignment : Alignment::kRigid);
  score.verdict = judge(score);
  return score;
}

Json describe(const ScoredFile& input) {
  return {{"file", path_text(input.file)},
          {"format", import::name_of(input.trajectory.format)},
          {"poses", input.trajectory.poses.size()}};
}

Json document_of(const Score& score, const ScoreOptions& options) {
  Json document{{"schema", "hallway.score/1"},
                {"reference", describe(score.reference)},
                {"estimate", describe(score.estimate)}};
  document["verdict"] = score.verdict ? Json(eval::name_of(*score.verdict)) : Json(nullptr);
  document["pairs"] = score.pairs.size();
  document["coverage"] = score.coverage;
  const Vec3 t = score.fit.translation();
  const Quat& q = score.fit.q;
  document["alignment"] = {{"kind", options.align},
                           {"scale", score.fit.scale},
                           {"rotation", {q.w(), q.x(), q.y(), q.z()}},
                           {"translation_m", {t.x(), t.y(), t.z()}}};
  document["ate"] = eval::to_json(score.absolute);
  document["rpe"] = Json::array();
  for (const auto& [delta, error] : score.relative) {
    Json entry{{"delta", delta.value}, {"unit", unit_of(delta)}};
    entry.update(eval::to_json(error));
    document["rpe"].push_back(entry);
  }
  document["divergence"] = nullptr;
  if (score.divergence) {
    document["divergence"] = {{"position_limit_m", score.divergence->limit_m},
                              {"position_worst_m", score.divergence->worst_m}};
    Json& first = document["divergence"]["first_s"];
    if (score.divergence->first) first = score.pairs[*score.divergence->first].t_s;
  }
  return document;
}

std::string errors_text(const std::optional<eval::ErrorStatistics>& errors, const char* unit) {
  if (!errors) return "unknown";
  return fmt::format("{:.6f} RMSE, {:.6f} mean, {:.6f} median, {:.6f} max {}", errors->rmse, errors->mean,
                     errors->median, errors->max, unit);
}

std::string input_text(const ScoredFile& input) {
  return fmt::format("{}, {} poses ({})", path_text(input.file), input.trajectory.poses.size(),
                     import::name_of(input.trajectory.format));
}

std::string verdict_text(const Score& score, const char* alignment) {
  if (!score.verdict) return "unknown: too few pairs";
  std::string text = eval::name_of(*score.verdict);
  if (score.divergence)
    text += fmt::format("; worst position error after {} alignment {:.4f} m, limit {:.4f} m", alignment,
                        score.divergence->worst_m, score.divergence->limit_m);
  return text;
}

std::string table_of(const Score& score, const ScoreOptions& options) {
  std::string text = "score\n";
  const Rows row{text, 28};
  row("reference", input_text(score.reference));
  row("estimate", input_text(score.estimate));
  row("verdict", verdict_text(score, options.align == "sim3" ? "sim3" : "se3"));
  row("coverage",
      fmt::format("{} pairs, {:.1f} % of the reference's time", score.pairs.size(), 100.0 * score.coverage));
  row("alignment",
      options.align == "sim3" ? fmt::format("sim3, scale {:.9g}", score.fit.scale) : options.align);
  row("ATE, translation", errors_text(score.absolute.translation_m, "m"));
  row("ATE, rotation", errors_text(score.absolute.rotation_deg, "deg"));
  for (const auto& [delta, error] : score.relative) {
    const std::string unit = unit_of(delta);  // of several
    const std::string name = fmt::format("RPE, {} {}", format_double(delta.value),
                                         delta.value == 1.0 ? unit.substr(0, unit.size() - 1) : unit);
    row(name + ", translation", errors_text(error.translation_m, "m"));
    row(name + ", rotation", errors_text(error.rotation_deg, "deg"));
  }
  return text;
}

int score(const ScoreOptions& options) {
  for (const std::string_view text : split(options.delta, ',')) parse_delta(trim(text));
  const ScoredFile reference = read_input(options.reference, options.reference_format, options);
  const ScoredFile estimate = read_input(options.estimate, options.estimate_format, options);
  const bool any_kitti = reference.trajectory.format == TrajectoryFormat::kKitti ||
                         estimate.trajectory.format == TrajectoryFormat::kKitti;
  if (!options.times.empty() && !any_kitti)
    refuse("--pose-times gives a KITTI file its times, and both files have their own");
  if (!std::isfinite(options.time_offset_s)) refuse("--time-offset takes a number of seconds");
  const Score result = score_of(reference, estimate, options);
  if (options.json) {
    print_json(document_of(result, options));
  } else {
    print_result(table_of(result, options));
  }
  return 0;
}

}  // namespace

void add_score_command(Command& app) {
  Command& command = app.command(
      "score", "Compare an estimated trajectory with a reference: absolute (ATE) and relative errors (RPE)");
  ScoreOptions& options = command.runs(&score);
  const std::vector<std::string> formats{"tum", "kitti", "euroc"};
  command.argument("reference", &options.reference, "Trajectory that counts as the truth")
      .required()
      .value("REFERENCE");
  command.argument("estimate", &options.estimate, "Trajectory that is scored").required().value("ESTIMATE");
  command.option("--format", &options.format, "Format of both files [by their content]").choices(formats);
  command.option("--reference-format", &options.reference_format, "Format of the reference").choices(formats);
  command.option("--estimate-format", &options.estimate_format, "Format of the estimate").choices(formats);
  command.option("--pose-times", &options.times, "Times of KITTI poses: a line of seconds for each [none]")
      .value("FILE");
  command
      .option("--max-difference", &options.max_difference_s,
              "Largest difference between the times of two poses that are a pair")
      .value("S")
      .range(0.0, 1e9)
      .show_default();
  command.option("--time-offset", &options.time_offset_s, "Seconds to add to the times of the estimate [0]")
      .value("S");
  command
      .option("--align", &options.align,
              "Motion that is no error: none; first: the first poses coincide; se3: best rigid fit; sim3: "
              "best fit with scale")
      .choices({"none", "first", "se3", "sim3"})
      .show_default();
  command
      .option("--delta", &options.delta,
              "Lengths of the relative errors: frames (f), metres (m), seconds (s)")
      .value("LENGTH,...")
      .show_default();
  add_shared(command, Shared::kJson, &options.json);
  command.footer(
      "Reads TUM (t x y z qx qy qz qw), KITTI (12 numbers a line) and EuRoC ground truth (CSV with a "
      "header).\n"
      "Exit status: 0 scored, whatever the verdict; 3 a file cannot be read or no poses can be paired.\n"
      "Example: hallway score groundtruth.txt estimate.txt --align sim3 --delta 1m,10m");
}

}  // namespace hallway::cli
