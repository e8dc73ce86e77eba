// SPDX-License-Identifier: MIT
#include "log/topology.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/text.hpp"
#include "base/xml_text.hpp"
#include "log/json_text.hpp"
#include "log/topology_json.hpp"

namespace hallway::log {
namespace {

constexpr const char* kSchema = "hallway.topology/1";

std::string data(const char* key, std::string_view value) {
  return fmt::format("      <data key=\"{}\">{}</data>\n", key, xml_text(value));
}

std::string data(const char* key, double value) {
  return data(key, std::isinf(value) ? std::string(value > 0 ? "INF" : "-INF") : format_double(value));
}

std::string graphml_node(const TopologyNode& node) {
  std::string text =
      fmt::format("    <node id=\"n{}\">\n", node.id) + data("kind", place_kind_name(node.kind));
  if (node.kind == PlaceKind::kDiscontinuity) {
    text += data("direction", std::to_string(node.direction));
    if (node.size_m) text += data("size_m", *node.size_m);
  }
  text += data("visits", std::to_string(node.visits)) + data("t_ns", std::to_string(node.t_ns));
  return text + data("x_m", node.x_m) + data("y_m", node.y_m) + "    </node>\n";
}

std::string graphml_edge(const TopologyEdge& edge, std::size_t number) {
  return fmt::format("    <edge id=\"e{}\" source=\"n{}\" target=\"n{}\">\n", number, edge.from, edge.to) +
         data("length_m", edge.length_m) + data("confidence", edge.confidence) +
         data("quarter_turns", std::to_string(edge.quarter_turns)) + "    </edge>\n";
}

/// All attributes that there are, by what has them.
constexpr const char* kKeys[][3] = {
    {"graph", "loop", "string"},    {"graph", "note", "string"},      {"node", "kind", "string"},
    {"node", "direction", "int"},   {"node", "size_m", "double"},     {"node", "visits", "long"},
    {"node", "t_ns", "long"},       {"node", "x_m", "double"},        {"node", "y_m", "double"},
    {"edge", "length_m", "double"}, {"edge", "confidence", "double"}, {"edge", "quarter_turns", "int"}};

}  // namespace

Topology parse_topology(std::string_view text, const std::string& file) {
  try {
    check_json_size(text);
    const nlohmann::json json = nlohmann::json::parse(text);
    if (!json.is_object() || json.value("schema", "") != kSchema)
      throw Error(ErrorCode::kBadInput, fmt::format("has not \"schema\": \"{}\"", kSchema));
    return topology_of(json);
  } catch (const nlohmann::json::exception& failure) {
    throw Error(ErrorCode::kBadInput, printable(failure.what()), {.file = printable(file)});
  } catch (const Error& error) {
    throw Error(error.code(), error.message(), {.file = printable(file)});
  }
}

Topology read_topology(const std::filesystem::path& path) {
  return parse_topology(read_file(path), path.string());
}

std::string print_topology(const Topology& topology) {
  nlohmann::ordered_json json{{"schema", kSchema}};
  add_members(topology, json);
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

std::string print_graphml(const Topology& topology) {
  std::string text =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<graphml xmlns=\"http://graphml.graphdrawing.org/xmlns\">\n";
  for (const auto& [owner, name, type] : kKeys)
    text += fmt::format("  <key id=\"{}\" for=\"{}\" attr.name=\"{}\" attr.type=\"{}\"/>\n", name, owner,
                        name, type);
  text += "  <graph id=\"topology\" edgedefault=\"directed\">\n";
  text += data("loop", loop_state_name(topology.loop)) + data("note", topology.note);
  for (const TopologyNode& node : topology.nodes) text += graphml_node(node);
  for (std::size_t i = 0; i < topology.edges.size(); ++i) text += graphml_edge(topology.edges[i], i);
  return text + "  </graph>\n</graphml>\n";
}

}  // namespace hallway::log
