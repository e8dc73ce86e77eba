// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/ext/params.h>

#include <cstdint>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "base/text.hpp"
#include "conformance/instance.hpp"

namespace hallway::conformance {

/// Whether these headers know the type.
inline bool is_known(std::uint32_t type) {
  return type >= HW_PARAM_BOOL && type <= HW_PARAM_CHOICE;
}

/// A value of HW_PARAM_DOUBLE.
inline hw_param_value_t real(double number) {
  hw_param_value_t value{};
  value.type = HW_PARAM_DOUBLE;
  value.as.real = number;
  return value;
}

/// A value of any other type.
inline hw_param_value_t whole(std::uint32_t type, std::int64_t number) {
  hw_param_value_t value{};
  value.type = type;
  value.as.integer = number;
  return value;
}

/// The same number, bit by bit.
inline bool same(const hw_param_value_t& a, const hw_param_value_t& b) {
  return a.type == b.type && a.as.integer == b.as.integer;
}

/// The number alone.
inline std::string text_of(const hw_param_value_t& value) {
  return value.type == HW_PARAM_DOUBLE ? format_double(value.as.real) : std::to_string(value.as.integer);
}

/// The parameters of one instance, called as the host calls them.
class Parameters {
 public:
  /// Throws Skipped if there are none.
  explicit Parameters(Instance& plugin)
      : plugin_(plugin),
        self_(plugin.raw().self),
        functions_(plugin.parameters()),
        functions_2_(plugin.parameters_2()) {
    if (functions_ == nullptr || count() == 0) throw Skipped("the plugin declares no parameters");
  }
  /// Those of a new instance without settings.
  explicit Parameters(const Subject& subject) : Parameters(std::make_unique<Instance>(subject.plain())) {}

  Instance& plugin() const { return plugin_; }

  std::uint32_t count() const {
    return marked("count", [&] { return functions_->count(self_); });
  }
  const hw_param_info_t* describe(std::uint32_t index) const {
    return marked("describe", [&] { return functions_->describe(self_, index); });
  }
  /// Throws Failed where there is none.
  const hw_param_info_t& info(std::uint32_t index) const {
    const hw_param_info_t* info = describe(index);
    demand(info != nullptr, "parameter " + std::to_string(index) + " is not described");
    demand(HW_HAS(info, hw_param_info_t, n_choices), "a description is smaller than that of version 0.1");
    demand(info->name != nullptr, "the name of parameter " + std::to_string(index) + " is null");
    return *info;
  }
  /// Indices of those whose type is known.
  std::vector<std::uint32_t> known() const { return of_types(HW_PARAM_BOOL, HW_PARAM_CHOICE); }
  /// Indices of those whose values are texts. Throws Failed where there are some, and no hw_params_2_t.
  std::vector<std::uint32_t> texts() const {
    std::vector<std::uint32_t> indices = of_types(HW_PARAM_TEXT, HW_PARAM_FOLDER);
    demand(indices.empty() || functions_2_ != nullptr, "declares a text parameter without " HW_EXT_PARAMS_2);
    return indices;
  }
  /// Throws Skipped where the plugin has no hw_params_2_t.
  void need_origins() const {
    if (functions_2_ == nullptr) throw Skipped("the plugin has no " HW_EXT_PARAMS_2);
  }
  std::uint32_t origin(std::uint32_t index) const {
    return marked("origin", [&] { return functions_2_->origin(self_, index); });
  }
  Ended try_get_text(std::uint32_t index, const char** text) const {
    return ended_by("get_text",
                    [&](hw_error_t* error) { return functions_2_->get_text(self_, index, text, error); });
  }
  /// Throws Failed where it fails.
  std::string get_text(std::uint32_t index) const {
    const char* text = nullptr;
    try_get_text(index, &text).demand_good();
    demand(text != nullptr, name(index) + ": get_text() gives null");
    return text;
  }
  Ended set_text(std::uint32_t index, const char* text) const {
    return ended_by("set_text",
                    [&](hw_error_t* error) { return functions_2_->set_text(self_, index, text, error); });
  }
  std::string name(std::uint32_t index) const { return "parameter `" + printable(info(index).name) + "`"; }

  Ended try_get(std::uint32_t index, hw_param_value_t& value) const {
    return ended_by("get", [&](hw_error_t* error) { return functions_->get(self_, index, &value, error); });
  }
  /// Throws Failed where it fails.
  hw_param_value_t get(std::uint32_t index) const {
    hw_param_value_t value{};
    try_get(index, value).demand_good();
    return value;
  }
  Ended set(std::uint32_t index, const hw_param_value_t& value) const {
    return ended_by("set", [&](hw_error_t* error) { return functions_->set(self_, index, &value, error); });
  }
  /// Throws Failed where it fails, or another value stands then.
  void set_and_check(std::uint32_t index, const hw_param_value_t& value) const {
    const Ended ended = set(index, value);
    demand(ended.good(), name(index) + ": " + text_of(value) + " is refused: " + ended.text());
    const hw_param_value_t now = get(index);
    demand(same(now, value), name(index) + " is " + text_of(now) + " after it was set to " + text_of(value));
  }
  /// Throws Failed unless `value` is refused with a reason, by one of `statuses`, and the old value stays.
  void demand_refused(std::uint32_t index, const hw_param_value_t& value,
                      const std::set<hw_status_t>& statuses) const {
    const hw_param_value_t before = get(index);
    const Ended ended = set(index, value);
    const std::string what = name(index) + ": set() of " + text_of(value);
    demand(!ended.good(), what + " is not refused");
    demand(statuses.contains(ended.status),
           what + " gave " + hw_status_name(ended.status) + ", not " + hw_status_name(*statuses.begin()));
    ended.demand_reason();
    demand(same(get(index), before), what + " was refused and has changed the value");
  }
  /// Values that must be accepted: both ends of the range, the default, and what lies between.
  std::vector<hw_param_value_t> good_values(std::uint32_t index) const {
    const hw_param_info_t& info = this->info(index);
    switch (info.type) {
      case HW_PARAM_BOOL:
        return {whole(info.type, 0), whole(info.type, 1)};
      case HW_PARAM_CHOICE:
        return {whole(info.type, 0), whole(info.type, static_cast<std::int64_t>(info.n_choices) - 1)};
      case HW_PARAM_INT:
        return {info.minimum, info.maximum, info.default_value};
      default:
        return {info.minimum, info.maximum,
                real(info.minimum.as.real + 0.37 * (info.maximum.as.real - info.minimum.as.real)),
                info.default_value};
    }
  }

 private:
  std::vector<std::uint32_t> of_types(std::uint32_t first, std::uint32_t last) const {
    std::vector<std::uint32_t> indices;
    for (std::uint32_t i = 0; i < count(); ++i) {
      if (info(i).type >= first && info(i).type <= last) indices.push_back(i);
    }
    return indices;
  }
  explicit Parameters(std::unique_ptr<Instance> plugin) : Parameters(*plugin) {
    own_plugin_ = std::move(plugin);
  }

  std::unique_ptr<Instance> own_plugin_;
  Instance& plugin_;
  void* self_;
  const hw_params_t* functions_;
  const hw_params_2_t* functions_2_;
};

}  // namespace hallway::conformance
