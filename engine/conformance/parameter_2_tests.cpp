// SPDX-License-Identifier: MIT
// The extension hw.params/2: texts, and where values come from.
#include <algorithm>
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

/// The parameters of a new plugin. Throws Skipped without hw.params/2.
struct Fixture : Parameters {
  explicit Fixture(const Subject& subject) : Parameters(subject), text_indices(texts()) { need_origins(); }
  std::vector<std::uint32_t> text_indices;
};

/// The same with at least one text parameter.
struct TextFixture : Fixture {
  explicit TextFixture(const Subject& subject) : Fixture(subject) {
    if (text_indices.empty()) throw Skipped("no parameter of the plugin is a text");
  }
};

const char* root_of(std::uint32_t type) {
  return type == HW_PARAM_TEXT ? "" : "/";
}

void texts_are_described(const Subject& subject) {
  const TextFixture parameters(subject);
  for (const std::uint32_t i : parameters.text_indices) {
    const hw_param_info_t& info = parameters.info(i);
    const std::string name = parameters.name(i);
    demand(HW_HAS(&info, hw_param_info_t, reserved_2),
           name + ": its description is smaller than that of 1.4");
    demand_text(info.default_text, name + ": its default text");
    demand((info.flags & ~std::uint32_t{HW_PARAM_WRITABLE}) == 0, name + ": has unknown flags");
    demand(info.type != HW_PARAM_TEXT || info.flags == 0, name + ": a text that is no path is writable");
    demand(parameters.get_text(i) == info.default_text, name + " of a new plugin is not its default");
  }
}

void texts_are_kept(const Subject& subject) {
  const TextFixture parameters(subject);
  for (const std::uint32_t i : parameters.text_indices) {
    const std::string path = root_of(parameters.info(i).type);
    for (const std::string& text :
         {path + "a", path + "größer, 100 %", std::string(), path + std::string(4000, 'x')}) {
      std::string given = text;
      parameters.set_text(i, given.c_str()).demand_good();
      std::fill(given.begin(), given.end(), '?');  // the plugin has a copy
      demand(parameters.get_text(i) == text, parameters.name(i) + " is not what it was set to");
    }
  }
}

void texts_stand_while_active(const Subject& subject) {
  const TextFixture parameters(subject);
  parameters.plugin().activate();
  parameters.plugin().step(0).demand_good();
  for (const std::uint32_t i : parameters.text_indices) {
    const std::string before = parameters.get_text(i);
    const Ended ended = parameters.set_text(i, "/other");
    demand(ended.status == HW_ERROR_STATE,
           parameters.name(i) + ": set_text() while active gave " + hw_status_name(ended.status));
    ended.demand_reason();
    demand(parameters.get_text(i) == before, parameters.name(i) + " was refused and has changed");
  }
}

void texts_are_no_numbers(const Subject& subject) {
  const TextFixture parameters(subject);
  for (const std::uint32_t i : parameters.text_indices) {
    const Ended ended = parameters.set(i, whole(parameters.info(i).type, 0));
    demand(ended.status == HW_ERROR_ARGUMENT,
           parameters.name(i) + ": set() of a text parameter gave " + hw_status_name(ended.status));
    ended.demand_reason();
  }
  for (const std::uint32_t i : parameters.known()) {
    const Ended ended = parameters.set_text(i, "1");
    demand(ended.status == HW_ERROR_ARGUMENT,
           parameters.name(i) + ": set_text() of a number gave " + hw_status_name(ended.status));
    ended.demand_reason();
  }
}

void origins_are_told(const Subject& subject) {
  const Fixture parameters(subject);
  for (std::uint32_t i = 0; i < parameters.count(); ++i)
    demand(parameters.origin(i) == HW_PARAM_FROM_DEFAULT,
           parameters.name(i) + " of a new plugin is not FROM_DEFAULT");
  demand(parameters.origin(parameters.count()) == HW_PARAM_FROM_DEFAULT &&
             parameters.origin(UINT32_MAX) == HW_PARAM_FROM_DEFAULT,
         "origin() of an index that does not exist is not FROM_DEFAULT");
  for (const std::uint32_t i : parameters.known()) {
    parameters.set_and_check(i, parameters.get(i));
    demand(parameters.origin(i) == HW_PARAM_FROM_HOST, parameters.name(i) + " was set and is not FROM_HOST");
  }
  for (const std::uint32_t i : parameters.text_indices) {
    parameters.set_text(i, "").demand_good();
    demand(parameters.origin(i) == HW_PARAM_FROM_HOST, parameters.name(i) + " was set and is not FROM_HOST");
  }
}

/// Activates the plugin with sensors of a noise that no default is, and feeds one frame.
void use(const Parameters& parameters) {
  std::vector<hw_sensor_info_t> sensors = parameters.plugin().ordinary().sensors();
  for (hw_sensor_info_t& sensor : sensors) {
    sensor.noise_m[0] = 0.0123;
    sensor.noise_m[1] = 0.0456;
    sensor.noise_m[2] = std::numeric_limits<double>::quiet_NaN();
  }
  if (!parameters.plugin().activate(sensors).good()) parameters.plugin().activate();
  parameters.plugin().step(0).demand_good();
}

std::vector<hw_param_value_t> values_of(const Parameters& parameters) {
  std::vector<hw_param_value_t> values;
  for (const std::uint32_t i : parameters.known()) values.push_back(parameters.get(i));
  return values;
}

void set_values_stand(const Subject& subject) {
  const Fixture parameters(subject);
  for (const std::uint32_t i : parameters.known()) parameters.set_and_check(i, parameters.get(i));
  const std::vector<hw_param_value_t> before = values_of(parameters);
  use(parameters);
  for (std::size_t k = 0; k < before.size(); ++k) {
    const std::uint32_t i = parameters.known()[k];
    demand(same(parameters.get(i), before[k]) && parameters.origin(i) == HW_PARAM_FROM_HOST,
           parameters.name(i) + " was set, and activate() has changed it");
  }
}

bool is_within_range(const hw_param_info_t& info, const hw_param_value_t& value) {
  if (info.type == HW_PARAM_DOUBLE)
    return value.as.real >= info.minimum.as.real && value.as.real <= info.maximum.as.real;
  if (info.type != HW_PARAM_INT) return true;
  return value.as.integer >= info.minimum.as.integer && value.as.integer <= info.maximum.as.integer;
}

void sensor_values_are_given_back(const Subject& subject) {
  const Fixture parameters(subject);
  const std::vector<std::uint32_t> known = parameters.known();
  const std::vector<hw_param_value_t> before = values_of(parameters);
  use(parameters);
  for (std::size_t k = 0; k < known.size(); ++k) {
    const hw_param_value_t now = parameters.get(known[k]);
    const bool from_sensor = parameters.origin(known[k]) == HW_PARAM_FROM_SENSOR;
    demand(from_sensor || same(now, before[k]),
           parameters.name(known[k]) + " has changed in activate() and is not FROM_SENSOR");
    demand(!from_sensor || is_within_range(parameters.info(known[k]), now),
           parameters.name(known[k]) + " is outside of its range after activate()");
  }
  parameters.plugin().deactivate();
  for (std::size_t k = 0; k < known.size(); ++k) {
    demand(same(parameters.get(known[k]), before[k]) && parameters.origin(known[k]) == HW_PARAM_FROM_DEFAULT,
           parameters.name(known[k]) + " is not as before after deactivate()");
  }
}

constexpr Test kTests[] = {
    {"params-text-described",
     "Text parameters have a default text, no flags but HW_PARAM_WRITABLE, and begin with it.",
     texts_are_described},
    {"params-text-round-trip", "get_text() gives the very text that was set, of which the plugin has a copy.",
     texts_are_kept},
    {"params-text-active",
     "set_text() while active gives HW_ERROR_STATE and a reason, and the old text stays.",
     texts_stand_while_active},
    {"params-text-type", "set() of a text and set_text() of a number give HW_ERROR_ARGUMENT and a reason.",
     texts_are_no_numbers},
    {"params-origin", "origin() is FROM_DEFAULT in a new plugin, and FROM_HOST once a parameter was set.",
     origins_are_told},
    {"params-set-stands", "A parameter that was set is not taken from a sensor.", set_values_stand},
    {"params-sensor",
     "A parameter that activate() takes from a sensor is within its range, FROM_SENSOR, and its default "
     "after "
     "deactivate().",
     sensor_values_are_given_back},
};

}  // namespace

std::span<const Test> parameter_2_tests() {
  return kTests;
}

}  // namespace hallway::conformance
