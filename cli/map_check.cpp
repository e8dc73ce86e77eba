// SPDX-License-Identifier: MIT
#include "map/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "base/text.hpp"
#include "command.hpp"
#include "compiled_map.hpp"
#include "console.hpp"
#include "run/pictures/map_findings.hpp"
#include "shared_options.hpp"

namespace hallway::cli {
namespace {

using map::Finding;
using map::Severity;

struct MapCheckOptions {
  std::string map;
  bool strict = false;
  bool json = false;
};

const char* severity_name(Severity severity) {
  return severity == Severity::kError ? "error" : "warning";
}

/// "file:12: error: entity 3: cause [id]".
std::string line_of(const std::string& map, const Finding& finding) {
  std::string text = path_text(map);
  if (finding.where.line > 0) text += fmt::format(":{}", finding.where.line);
  text += fmt::format(": {}: ", severity_name(finding.severity));
  if (!finding.where.element.empty()) text += finding.where.element + ": ";
  return text + fmt::format("{} [{}]\n", finding.message, finding.id);
}

Json json_of(const Finding& finding) {
  return {{"severity", severity_name(finding.severity)},
          {"id", finding.id},
          {"line", finding.where.line > 0 ? Json(finding.where.line) : Json(nullptr)},
          {"element", finding.where.element},
          {"message", finding.message}};
}

int check_map(const MapCheckOptions& options) {
  const map::Document document = load_map(options.map);
  const std::vector<Finding> findings = run::find_faults(document);
  const auto errors = std::ranges::count_if(
      findings, [](const Finding& finding) { return finding.severity == Severity::kError; });
  const auto warnings = static_cast<std::ptrdiff_t>(findings.size()) - errors;
  const int status = errors > 0 || (options.strict && warnings > 0) ? 1 : 0;
  if (options.json) {
    Json list = Json::array();
    for (const Finding& finding : findings) list.push_back(json_of(finding));
    print_json({{"schema", "hallway.check/1"},
                {"status", status},
                {"map", path_text(options.map)},
                {"errors", errors},
                {"warnings", warnings},
                {"findings", list}});
    return status;
  }
  std::string text;
  for (const Finding& finding : findings) text += line_of(options.map, finding);
  print_result(text + fmt::format("{} error{}, {} warning{}\n", errors, errors == 1 ? "" : "s", warnings,
                                  warnings == 1 ? "" : "s"));
  return status;
}

}  // namespace

void add_map_check_command(Command& group) {
  Command& command = group.command("check", "List the problems of a map");
  MapCheckOptions& options = command.runs(&check_map);
  command.argument("map", &options.map, "A .map file").required().value("MAP");
  add_shared(command, Shared::kStrict, &options.strict);
  add_shared(command, Shared::kJson, &options.json);
  command.footer(
      "Status 1 if there is an error, 0 if there are warnings at most.\n"
      "Example: hallway map check maps/office.map --strict");
}

}  // namespace hallway::cli
