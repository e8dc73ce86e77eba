// SPDX-License-Identifier: MIT
// What a library says of itself, and how it makes plugins.
#include <algorithm>
#include <cstring>
#include <iterator>
#include <set>
#include <string>
#include <vector>

#include "base/text.hpp"
#include "conformance/call_mark.hpp"
#include "conformance/instance.hpp"
#include "conformance/texts.hpp"
#include "host/load/error_text.hpp"
#include "host/machine/library_facts.hpp"

namespace hallway::conformance {
namespace {

constexpr const char* kUnknownIds[] = {"", "hw.plugin-factory/4711", "hw.nothing/1", "HW.PLUGIN-FACTORY/1"};
constexpr std::size_t kMaxIdBytes = 64;

void shows_entry_alone(const Subject& subject) {
  const host::LibraryFacts facts = host::read_library_facts(subject.file);
  if (!facts.symbols_known) throw Skipped("the file has no section headers to read its symbols by");
  for (const std::string& name : facts.exports) {
    demand(name == HW_ENTRY_SYMBOL, "the file also exports " + printable(name));
  }
}

void knows_no_other_factory(const Subject& subject) {
  const LoadedLibrary library(subject.file);
  for (const char* id : kUnknownIds) {
    const void* factory = marked("get_factory", [&] { return library.entry().get_factory(id); });
    demand(factory == nullptr, std::string("get_factory(\"") + id + "\") gave one");
  }
}

std::uint32_t count_of(const LoadedLibrary& library) {
  return marked("count", [&] { return library.factory().count(); });
}

const hw_plugin_info_t* describe(const LoadedLibrary& library, std::uint32_t index) {
  return marked("describe", [&] { return library.factory().describe(index); });
}

/// The descriptions of all plugins. Throws Failed if one is not there.
std::vector<const hw_plugin_info_t*> descriptions(const LoadedLibrary& library) {
  std::vector<const hw_plugin_info_t*> all;
  const std::uint32_t count = count_of(library);
  for (std::uint32_t i = 0; i < count; ++i) {
    all.push_back(describe(library, i));
    demand(all.back() != nullptr,
           "describe(" + std::to_string(i) + ") of " + std::to_string(count) + " is null");
    demand(HW_HAS(all.back(), hw_plugin_info_t, n_outputs),
           "a description is smaller than that of version 0.1");
  }
  return all;
}

void counts_the_same(const Subject& subject) {
  const LoadedLibrary library(subject.file);
  const std::uint32_t first = count_of(library);
  Instance(library, subject).parameters();
  for (int i = 0; i < 3; ++i) demand(count_of(library) == first, "count() has changed");
}

void describes_no_more(const Subject& subject) {
  const LoadedLibrary library(subject.file);
  const std::uint32_t count = count_of(library);
  for (const std::uint32_t index : {count, count + 1, UINT32_MAX}) {
    demand(describe(library, index) == nullptr,
           "describe(" + std::to_string(index) + ") of " + std::to_string(count) + " plugins is not null");
  }
}

/// All that a description says, as text.
std::string text_of_info(const hw_plugin_info_t& info) {
  std::string text;
  for (const char* part : {info.id, info.name, info.version, info.vendor, info.description}) {
    text += std::string(part ? part : "(null)") + "\n";
  }
  for (const std::uint32_t kind : inputs_of(info)) text += std::to_string(kind) + " ";
  for (const std::uint32_t kind : outputs_of(info)) text += std::to_string(kind) + " ";
  return text;
}

void describes_the_same(const Subject& subject) {
  const LoadedLibrary library(subject.file);
  const hw_plugin_info_t& info = library.info(subject.plugin);
  const std::string before = text_of_info(info);
  Instance(library, subject).parameters();
  demand(text_of_info(info) == before, "a description has changed after a plugin was made");
  demand(text_of_info(library.info(subject.plugin)) == before,
         "a plugin was described otherwise the next time");
}

void has_good_ids(const Subject& subject) {
  const LoadedLibrary library(subject.file);
  std::set<std::string> ids;
  for (const hw_plugin_info_t* info : descriptions(library)) {
    demand(info->id != nullptr, "an id is null");
    const std::string id = info->id;
    const bool plain = std::ranges::all_of(id, [](char c) {
      return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
             c == '-' || c == '.';
    });
    demand(plain && !id.empty() && id.size() <= kMaxIdBytes,
           "the id `" + printable(id) + "` is not 1 to 64 letters, digits and _ - .");
    demand(ids.insert(id).second, "two plugins have the id `" + id + "`");
  }
}

void has_good_texts(const Subject& subject) {
  const LoadedLibrary library(subject.file);
  for (const hw_plugin_info_t* info : descriptions(library)) {
    demand_text(info->name, "the name");
    demand_text(info->version, "the version");
    demand_text(info->vendor, "the vendor");
    demand_text(info->description, "the description");
  }
}

void demand_kinds(const std::uint32_t* kinds, std::uint32_t count, const std::string& what) {
  demand(count == 0 || kinds != nullptr, "the list of " + what + " is null");
  std::set<std::uint32_t> seen;
  for (std::uint32_t i = 0; i < count; ++i) {
    demand(kinds[i] != 0, "a kind of " + what + " is 0, which is none");
    demand(seen.insert(kinds[i]).second,
           "kind " + std::to_string(kinds[i]) + " stands twice among the " + what);
  }
}

/// What is needed is not optional.
void has_good_optional_inputs(const hw_plugin_info_t& info) {
  demand_kinds(info.optional_inputs, info.n_optional_inputs, "optional inputs");
  for (std::uint32_t i = 0; i < info.n_optional_inputs; ++i) {
    const std::uint32_t kind = info.optional_inputs[i];
    demand(std::find(info.inputs, info.inputs + info.n_inputs, kind) == info.inputs + info.n_inputs,
           "kind " + std::to_string(kind) + " stands among the inputs and among the optional ones");
  }
}

void has_good_kinds(const Subject& subject) {
  const LoadedLibrary library(subject.file);
  for (const hw_plugin_info_t* info : descriptions(library)) {
    demand_kinds(info->inputs, info->n_inputs, "inputs");
    demand_kinds(info->outputs, info->n_outputs, "outputs");
    demand(info->reserved == 0, "hw_plugin_info_t.reserved is not 0");
    if (HW_HAS(info, hw_plugin_info_t, n_optional_inputs)) has_good_optional_inputs(*info);
  }
}

void creates_no_other(const Subject& subject) {
  const LoadedLibrary library(subject.file);
  TestHost host({});
  for (const char* id : {"", "no_plugin_has_this_id", "\xff"}) {
    hw_plugin_t plugin{};
    const Ended ended = ended_by("create", [&](hw_error_t* error) {
      return library.factory().create(&host.host(), id, &plugin, error);
    });
    demand(ended.status == HW_ERROR_NOT_FOUND,
           "create() of an unknown id gave " + std::string(hw_status_name(ended.status)));
    ended.demand_reason();
  }
}

void has_all_functions(const Subject& subject) {
  Instance plugin(subject);
  const hw_plugin_vtable_t& v = *plugin.raw().vtable;
  demand(v.activate && v.deactivate && v.reset && v.process && v.report && v.get_extension && v.destroy,
         "a function of the vtable is null");
  plugin.parameters();
  plugin.parameters_2();
}

void knows_no_other_extension(const Subject& subject) {
  const Instance plugin(subject);
  const hw_plugin_t& raw = plugin.raw();
  for (const char* id : {"", "hw.nothing/1", "hw.params/4711", "HW.PARAMS/1", "hw.params"}) {
    const void* extension = marked("get_extension", [&] { return raw.vtable->get_extension(raw.self, id); });
    demand(extension == nullptr, std::string("get_extension(\"") + id + "\") gave one");
  }
}

constexpr Test kEntryTests[] = {
    {"entry-alone", "The library exports hw_entry and no other symbol.", shows_entry_alone},
    {"factory-unknown", "get_factory() gives null for an id that it does not know.", knows_no_other_factory},
    {"factory-count", "count() gives the same number as long as the library is loaded.", counts_the_same},
    {"factory-end", "describe() gives null for every index from count() on.", describes_no_more},
    {"factory-constant", "What a plugin says of itself stays the same as long as the library is loaded.",
     describes_the_same},
    {"plugin-ids", "Ids are distinct and made of letters, digits and _ - . only.", has_good_ids},
    {"plugin-texts", "Name, version, vendor and description are UTF-8 and not null.", has_good_texts},
    {"plugin-kinds", "Inputs and outputs name each kind once, and reserved members are 0.", has_good_kinds},
    {"create-unknown", "create() of an unknown id gives HW_ERROR_NOT_FOUND and a reason.", creates_no_other},
    {"create-functions", "No function of a plugin and of its parameters is null.", has_all_functions},
    {"extension-unknown", "get_extension() gives null for an id that it does not know.",
     knows_no_other_extension},
};

}  // namespace

std::span<const Test> entry_tests() {
  return kEntryTests;
}

}  // namespace hallway::conformance
