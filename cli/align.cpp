// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <utility>

#include "align_output.hpp"
#include "base/file.hpp"
#include "base/refuse.hpp"
#include "base/text.hpp"
#include "cloud_options.hpp"
#include "command.hpp"
#include "console.hpp"
#include "output_file.hpp"
#include "shared_options.hpp"

namespace hallway::cli {
namespace {

constexpr const char* kMethods[] = {"point_to_point", "point_to_plane"};
constexpr const char* kWeights[] = {"none", "huber", "cauchy", "tukey"};

struct AlignCommand {
  std::string a;
  std::string b;
  CloudInput input;
  std::string guess;
  std::string method = "point_to_plane";
  std::string weights = "tukey";
  icp::AlignOptions options;
  std::string out;
  std::string picture;
  bool json = false;
};

AlignedCloud read_cloud(const std::string& file, const CloudInput& input) {
  planes::Cloud cloud = planes::read_cloud(file, cloud_options(input));
  return {path_text(file), std::move(cloud.points), cloud.not_finite};
}

/// "x y z yaw pitch roll", in metres and degrees; commas may part them too.
Pose parse_guess(const std::string& text) {
  std::array<double, 6> values{};
  std::size_t count = 0;
  std::string spaced = text;
  for (char& c : spaced) c = c == ',' ? ' ' : c;
  for (const std::string_view word : split(spaced, ' ')) {
    if (word.empty()) continue;
    const std::optional<double> value = parse_double(word);
    if (!value || count == values.size())
      refuse("--guess takes \"x y z yaw pitch roll\" in metres and degrees, not \"{}\"", printable(text));
    values[count++] = *value;
  }
  if (count != 0 && count != values.size())
    refuse("--guess has {} numbers; it takes six: \"x y z yaw pitch roll\"", count);
  return pose_of(values);
}

template <std::size_t N>
std::size_t index_of(const char* const (&names)[N], const std::string& name) {
  return static_cast<std::size_t>(std::find(names, names + N, name) - names);
}

/// What is written replaces no cloud that is read.
void check_outputs(const AlignCommand& command) {
  if (!command.picture.empty()) check_picture_file(command.picture);
  if (command.out.empty()) return;
  check_output_file(command.out);
  check_replaces_no_input(command.out, std::array{command.a, command.b});
  if (!command.out.ends_with(".ply"))
    refuse("--out writes a file that ends in .ply, not \"{}\"", printable(command.out));
}

int align_clouds(const AlignCommand& command) {
  check_outputs(command);
  const Pose guess = parse_guess(command.guess);
  icp::AlignOptions options = command.options;
  options.metric = static_cast<icp::Metric>(index_of(kMethods, command.method));
  options.kernel = static_cast<icp::Kernel>(index_of(kWeights, command.weights));
  const AlignedCloud a = read_cloud(command.a, command.input), b = read_cloud(command.b, command.input);
  for (const AlignedCloud* cloud : {&a, &b}) {
    if (cloud->not_finite > 0)
      print_warning("{}: {} points that are not finite were left out", cloud->file, cloud->not_finite);
  }
  const icp::Alignment found = icp::align(a.points, b.points, guess, options);
  const bool good = found.registration.outcome == icp::Outcome::converged;
  if (good && !command.out.empty()) write_file_atomically(command.out, print_moved_ply(b, found));
  if (good && !command.picture.empty()) write_file_atomically(command.picture, draw_alignment(a, b, found));
  if (command.json) {
    print_json(to_json(a, b, found, command.method, command.weights));
  } else {
    print_result(alignment_text(a, b, found));
  }
  return good ? 0 : 1;
}

void add_numbers(Command& command, icp::AlignOptions& options) {
  constexpr double kLeast_m = 1e-9, kMost_m = 1e9;
  command
      .option("--max-distance", &options.max_distance_m,
              "Farthest that a matching point may lie in the end [3 spacings of the points of A]")
      .range(kLeast_m, kMost_m)
      .value("M");
  command
      .option("--reach", &options.reach_m,
              "Largest distance of a matching point at first [a fifth of the size of A]")
      .range(kLeast_m, kMost_m)
      .value("M");
  command
      .option(
          "--voxel", &options.cube_m,
          "Thin both clouds to one point in each cube of this edge; 0: not [a hundredth of the size of A]")
      .range(0.0, 1e9)
      .value("M");
  command.option("--neighbours", &options.normal_neighbours, "Points that a normal is taken from")
      .range(3, 1000)
      .value("N")
      .show_default();
  command.option("--iterations", &options.max_iterations, "Most steps")
      .range(1, 1'000'000)
      .value("N")
      .show_default();
}

}  // namespace

void add_align_command(Command& app) {
  Command& command =
      app.command("align", "Register two point clouds: find the transform that registers B to A");
  AlignCommand& options = command.runs(&align_clouds);
  command
      .argument("a", &options.a,
                "Cloud that stays: PLY, PCD, CSV with a header (x, y, z), OBJ, or a depth image in PNG")
      .required()
      .value("CLOUD");
  command.argument("b", &options.b, "Cloud that is registered to it").required().value("CLOUD");
  add_cloud_options(command, options.input);
  command
      .option("--guess", &options.guess,
              "Where B is about: \"x y z yaw pitch roll\" in metres and degrees [where it stands]")
      .value("POSE");
  command.option("--method", &options.method, "What is made small: distances of points, or from planes")
      .choices({"point_to_point", "point_to_plane"})
      .show_default();
  command.option("--weights", &options.weights, "How matches that do not fit are weighted")
      .choices({"none", "huber", "cauchy", "tukey"})
      .show_default();
  add_numbers(command, options.options);
  add_shared(command, Shared::kOutFile, &options.out).fallback("none");
  add_shared(command, Shared::kPicture, &options.picture).fallback("none");
  add_shared(command, Shared::kJson, &options.json);
  command.footer(
      "Exit status 1 when it did not converge; no file is written then.\n"
      "Example: hallway align scan1.pcd scan2.pcd --guess \"1.8 0.7 0 40 0 0\" --out scan2_moved.ply");
}

}  // namespace hallway::cli
