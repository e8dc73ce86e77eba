// SPDX-License-Identifier: MIT
// The extension hw.params/1.
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include "base/text.hpp"
#include "conformance/instance.hpp"
#include "conformance/parameters.hpp"
#include "conformance/texts.hpp"
#include "conformance/walk.hpp"

namespace hallway::conformance {
namespace {

constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

bool is_snake_case(const std::string& name) {
  return !name.empty() && std::ranges::all_of(name, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
  });
}

void demand_choices(const hw_param_info_t& info, const std::string& name) {
  demand(info.choices != nullptr && info.n_choices > 0, name + " has no choices");
  for (std::uint32_t i = 0; i < info.n_choices; ++i) demand_text(info.choices[i], name + ": a choice");
  demand(info.default_value.as.integer >= 0 && info.default_value.as.integer < info.n_choices,
         name + ": the default is none of the choices");
}

template <typename T>
void demand_range(T minimum, T value, T maximum, const std::string& name) {
  demand(minimum <= maximum, name + ": its minimum is above its maximum");
  demand(minimum <= value && value <= maximum, name + ": its default is outside of its range");
}

void demand_description(const hw_param_info_t& info) {
  demand_text(info.name, "a parameter's name");
  const std::string name = "parameter `" + printable(info.name) + "`";
  demand(is_snake_case(info.name), name + ": its name is not snake_case");
  demand_text(info.unit, name + ": its unit");
  demand_text(info.help, name + ": its help");
  if (!is_known(info.type)) return;
  demand(info.default_value.type == info.type, name + ": its default is of another type");
  if (info.type == HW_PARAM_CHOICE) demand_choices(info, name);
  if (info.type == HW_PARAM_BOOL) demand_range<std::int64_t>(0, info.default_value.as.integer, 1, name);
  if (info.type != HW_PARAM_INT && info.type != HW_PARAM_DOUBLE) return;
  demand(info.minimum.type == info.type && info.maximum.type == info.type,
         name + ": its range is of another type");
  if (info.type == HW_PARAM_INT) {
    demand_range(info.minimum.as.integer, info.default_value.as.integer, info.maximum.as.integer, name);
  } else {
    demand(std::isfinite(info.default_value.as.real), name + ": its default is not finite");
    demand_range(info.minimum.as.real, info.default_value.as.real, info.maximum.as.real, name);
  }
}

void are_described(const Subject& subject) {
  const Parameters parameters(subject);
  const std::uint32_t count = parameters.count();
  std::set<std::string> names;
  for (std::uint32_t i = 0; i < count; ++i) {
    const hw_param_info_t& info = parameters.info(i);
    demand_description(info);
    demand(names.insert(info.name).second, "two parameters are called `" + printable(info.name) + "`");
  }
  demand(parameters.count() == count, "the number of parameters has changed");
}

std::vector<std::uint32_t> indices_behind(std::uint32_t count) {
  return {count, count + 1, UINT32_MAX};
}

void are_not_described_behind_the_end(const Subject& subject) {
  const Parameters parameters(subject);
  for (const std::uint32_t index : indices_behind(parameters.count())) {
    demand(parameters.describe(index) == nullptr,
           "describe(" + std::to_string(index) + ") is not null, and there is no such parameter");
  }
}

void do_not_exist_behind_the_end(const Subject& subject) {
  const Parameters parameters(subject);
  for (const std::uint32_t index : indices_behind(parameters.count())) {
    hw_param_value_t value = whole(HW_PARAM_BOOL, 0);
    const Ended got = parameters.try_get(index, value);
    demand(!got.good(), "get() of an index that does not exist succeeds");
    got.demand_reason();
    const Ended set = parameters.set(index, whole(HW_PARAM_BOOL, 0));
    demand(!set.good(), "set() of an index that does not exist succeeds");
    set.demand_reason();
  }
}

void begin_with_their_defaults(const Subject& subject) {
  const Parameters parameters(subject);
  for (const std::uint32_t i : parameters.known()) {
    const hw_param_value_t value = parameters.get(i);
    demand(same(value, parameters.info(i).default_value),
           parameters.name(i) + " of a new plugin is " + text_of(value) + " and not its default");
  }
}

void keep_what_is_set(const Subject& subject) {
  const Parameters parameters(subject);
  for (const std::uint32_t i : parameters.known()) {
    for (const hw_param_value_t& value : parameters.good_values(i)) {
      parameters.set_and_check(i, value);
    }
  }
}

const std::set<hw_status_t> kRange{HW_ERROR_RANGE};

void have_a_minimum(const Subject& subject) {
  const Parameters parameters(subject);
  for (const std::uint32_t i : parameters.known()) {
    const hw_param_info_t& info = parameters.info(i);
    const bool is_real = info.type == HW_PARAM_DOUBLE;
    const std::int64_t least = info.type == HW_PARAM_INT ? info.minimum.as.integer : 0;
    if (is_real && info.minimum.as.real > std::numeric_limits<double>::lowest()) {
      parameters.demand_refused(i, real(std::nextafter(info.minimum.as.real, -kInfinity)), kRange);
      parameters.demand_refused(i, real(std::numeric_limits<double>::lowest()), kRange);
    } else if (!is_real && least > std::numeric_limits<std::int64_t>::min()) {
      parameters.demand_refused(i, whole(info.type, least - 1), kRange);
      parameters.demand_refused(i, whole(info.type, std::numeric_limits<std::int64_t>::min()), kRange);
    }
  }
}

std::int64_t largest(const hw_param_info_t& info) {
  if (info.type == HW_PARAM_BOOL) return 1;
  return info.type == HW_PARAM_CHOICE ? static_cast<std::int64_t>(info.n_choices) - 1
                                      : info.maximum.as.integer;
}

void have_a_maximum(const Subject& subject) {
  const Parameters parameters(subject);
  for (const std::uint32_t i : parameters.known()) {
    const hw_param_info_t& info = parameters.info(i);
    const bool is_real = info.type == HW_PARAM_DOUBLE;
    if (is_real && info.maximum.as.real < std::numeric_limits<double>::max()) {
      parameters.demand_refused(i, real(std::nextafter(info.maximum.as.real, kInfinity)), kRange);
      parameters.demand_refused(i, real(std::numeric_limits<double>::max()), kRange);
    } else if (!is_real && largest(info) < std::numeric_limits<std::int64_t>::max()) {
      parameters.demand_refused(i, whole(info.type, largest(info) + 1), kRange);
      parameters.demand_refused(i, whole(info.type, std::numeric_limits<std::int64_t>::max()), kRange);
    }
  }
}

void are_finite(const Subject& subject) {
  const Parameters parameters(subject);
  bool any = false;
  for (const std::uint32_t i : parameters.known()) {
    if (parameters.info(i).type != HW_PARAM_DOUBLE) continue;
    any = true;
    for (const double number : {kNotANumber, kInfinity, -kInfinity}) {
      parameters.demand_refused(i, real(number), {HW_ERROR_RANGE, HW_ERROR_ARGUMENT, HW_ERROR_DATA});
    }
  }
  if (!any) throw Skipped("no parameter of the plugin is a real number");
}

void have_one_type(const Subject& subject) {
  const Parameters parameters(subject);
  for (const std::uint32_t i : parameters.known()) {
    for (const std::uint32_t type : {HW_PARAM_BOOL, HW_PARAM_INT, HW_PARAM_DOUBLE, HW_PARAM_CHOICE}) {
      if (type == parameters.info(i).type) continue;
      parameters.demand_refused(i, type == HW_PARAM_DOUBLE ? real(0.0) : whole(type, 0), {HW_ERROR_ARGUMENT});
    }
    parameters.demand_refused(i, whole(4711, 0), {HW_ERROR_ARGUMENT});
  }
}

void stand_while_active(const Subject& subject) {
  const Parameters parameters(subject);
  parameters.plugin().activate();
  parameters.plugin().step(0).demand_good();
  for (const std::uint32_t i : parameters.known()) {
    for (const hw_param_value_t& value : parameters.good_values(i)) {
      parameters.demand_refused(i, value, {HW_ERROR_STATE});
    }
  }
}

void can_be_set_between_activations(const Subject& subject) {
  const Parameters parameters(subject);
  parameters.plugin().activate();
  parameters.plugin().step(0).demand_good();
  parameters.plugin().deactivate();
  for (const std::uint32_t i : parameters.known()) {
    const hw_param_value_t original = parameters.get(i);
    parameters.set_and_check(i, parameters.good_values(i)[0]);
    parameters.set_and_check(i, original);
  }
}

void belong_to_one_instance(const Subject& subject) {
  const LoadedLibrary library(subject.file);
  Instance one(library, subject.plain());
  Instance other(library, subject.plain());
  const Parameters changed(one);
  const Parameters others(other);
  for (const std::uint32_t i : changed.known()) {
    const hw_param_value_t before = others.get(i);
    for (const hw_param_value_t& value : changed.good_values(i)) {
      changed.set_and_check(i, value);
      demand(same(others.get(i), before),
             others.name(i) + " of one plugin has changed with that of another one");
    }
  }
}

/// A new plugin with one parameter at an end of its range: it may refuse to be activated, but whatever it does has a reason.
void survives_extremes(const Subject& subject) {
  const LoadedLibrary library(subject.file);
  Instance first(library, subject.plain());
  for (const std::uint32_t i : Parameters(first).known()) {
    for (std::size_t end = 0; end < 2; ++end) {
      Instance plugin(library, subject.plain());
      const Parameters parameters(plugin);
      const hw_param_value_t value = parameters.good_values(i)[end];
      parameters.set(i, value).demand_good();
      const Ended ended = plugin.activate(plugin.ordinary().sensors());
      ended.demand_reason();
      if (!ended.good()) continue;
      for (std::uint64_t step = 0; step < 4; ++step) {
        const Answer answer = plugin.step(step);
        demand(answer.good() && answer.put.problem.empty(),
               parameters.name(i) + " = " + text_of(value) + " was accepted, but then " +
                   (answer.good() ? "process() put a wrong output: " + answer.put.problem : answer.text()));
      }
      plugin.report(HW_REPORT_REFINE).demand_valid();
    }
  }
}

constexpr Test kParameterTests[] = {
    {"params-described",
     "Every parameter has a distinct snake_case name, texts, a range, and a default within it.",
     are_described},
    {"params-end", "describe() of parameters gives null for every index from count() on.",
     are_not_described_behind_the_end},
    {"params-index", "get() and set() of an index that does not exist fail with a reason.",
     do_not_exist_behind_the_end},
    {"params-defaults", "The parameters of a new plugin have their defaults.", begin_with_their_defaults},
    {"params-round-trip", "get() gives the very value that was set, at both ends of the range and within it.",
     keep_what_is_set},
    {"params-below", "A value below the range gives HW_ERROR_RANGE and a reason, and the old value stays.",
     have_a_minimum},
    {"params-above", "A value above the range gives HW_ERROR_RANGE and a reason, and the old value stays.",
     have_a_maximum},
    {"params-not-finite", "NaN and infinities are refused with a reason, and the old value stays.",
     are_finite},
    {"params-type", "A value of another type gives HW_ERROR_ARGUMENT and a reason, and the old value stays.",
     have_one_type},
    {"params-active",
     "set() while the plugin is active gives HW_ERROR_STATE and a reason, and the old value stays.",
     stand_while_active},
    {"params-inactive", "Parameters can be set again once the plugin is deactivated.",
     can_be_set_between_activations},
    {"params-instances", "The parameters of one instance are not those of another.", belong_to_one_instance},
    {"params-extremes",
     "With a parameter at an end of its range the plugin works, or refuses to be activated with a reason.",
     survives_extremes},
};

}  // namespace

std::span<const Test> parameter_tests() {
  return kParameterTests;
}

}  // namespace hallway::conformance
