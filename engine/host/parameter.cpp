// SPDX-License-Identifier: MIT
#include "host/parameter.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/error.hpp"
#include "base/text.hpp"
#include "host/load/info_text.hpp"

namespace hallway::host {
namespace {

constexpr std::uint32_t kMaxChoices = 1000;

[[noreturn]] void fail_load(const std::string& message) {
  throw Error(ErrorCode::kPluginLoad, "declares a parameter badly: " + message);
}

std::string read_text(const char* text, const char* member, std::size_t most = kMaxInfoTextBytes) {
  if (text == nullptr) fail_load(fmt::format("its {} is null", member));
  return printable({text, strnlen(text, most)}, most);
}

std::vector<std::string> read_choices(const hw_param_info_t& info) {
  if (info.choices == nullptr || info.n_choices == 0 || info.n_choices > kMaxChoices) {
    fail_load(fmt::format("it has not 1 to {} choices", kMaxChoices));
  }
  std::vector<std::string> choices;
  for (std::uint32_t i = 0; i < info.n_choices; ++i) choices.push_back(read_text(info.choices[i], "choice"));
  return choices;
}

bool in_range(const Parameter& parameter, const hw_param_value_t& value) {
  if (value.type == HW_PARAM_DOUBLE) {
    return value.as.real >= parameter.minimum.as.real && value.as.real <= parameter.maximum.as.real;
  }
  return value.as.integer >= parameter.minimum.as.integer && value.as.integer <= parameter.maximum.as.integer;
}

hw_param_value_t whole(std::uint32_t type, std::int64_t number) {
  hw_param_value_t value{};
  value.type = type;
  value.as.integer = number;
  return value;
}

void check_range(const Parameter& parameter) {
  const std::uint32_t type = parameter.default_value.type;
  if (parameter.minimum.type != type || parameter.maximum.type != type) {
    fail_load("its range is of another type");
  }
  if (type == HW_PARAM_DOUBLE && !std::isfinite(parameter.default_value.as.real)) {
    fail_load("its default is not finite");
  }
  if (!in_range(parameter, parameter.default_value)) fail_load("its default is outside of its range");
}

void read_text_facts(const hw_param_info_t& info, Parameter& parameter) {
  if (!HW_HAS(&info, hw_param_info_t, flags)) fail_load("it has no default text");
  parameter.default_text = read_text(info.default_text, "default text", HW_PARAM_TEXT_BYTES);
  parameter.writable = parameter.is_path() && (info.flags & HW_PARAM_WRITABLE) != 0;
}

std::string range_text(const Parameter& parameter) {
  const std::string unit = parameter.unit.empty() ? "" : " " + parameter.unit;
  return fmt::format("from {} to {}{}", parameter.print(parameter.minimum),
                     parameter.print(parameter.maximum), unit);
}

}  // namespace

bool Parameter::is_text() const {
  return default_value.type == HW_PARAM_TEXT || is_path();
}

bool Parameter::is_path() const {
  return default_value.type == HW_PARAM_FILE || default_value.type == HW_PARAM_FOLDER;
}

std::string Parameter::type_name() const {
  switch (default_value.type) {
    case HW_PARAM_BOOL:
      return "bool";
    case HW_PARAM_INT:
      return "int";
    case HW_PARAM_DOUBLE:
      return "double";
    case HW_PARAM_CHOICE:
      return "choice";
    case HW_PARAM_TEXT:
      return "text";
    case HW_PARAM_FILE:
      return "file";
    case HW_PARAM_FOLDER:
      return "folder";
    default:
      return fmt::format("type {}", default_value.type);
  }
}

std::string Parameter::print(const hw_param_value_t& value) const {
  switch (value.type) {
    case HW_PARAM_BOOL:
      return value.as.integer != 0 ? "true" : "false";
    case HW_PARAM_INT:
      return fmt::format("{}", value.as.integer);
    case HW_PARAM_DOUBLE:
      return format_double(value.as.real);
    case HW_PARAM_CHOICE: {
      const auto index = static_cast<std::size_t>(value.as.integer);
      return index < choices.size() ? choices[index] : fmt::format("{}", value.as.integer);
    }
    default:
      return "";
  }
}

hw_param_value_t Parameter::parse(std::string_view text) const {
  const auto fail = [&](const std::string& allowed) -> hw_param_value_t {
    throw Error(ErrorCode::kBadInput,
                fmt::format("parameter `{}`: `{}` is not {}", name, printable(text), allowed));
  };
  hw_param_value_t value = whole(default_value.type, 0);
  switch (value.type) {
    case HW_PARAM_BOOL:
      if (text != "true" && text != "false") return fail("true or false");
      value.as.integer = text == "true" ? 1 : 0;
      return value;
    case HW_PARAM_INT: {
      const auto number = parse_int(text);
      if (number) value.as.integer = *number;
      return number && in_range(*this, value) ? value : fail("a whole number " + range_text(*this));
    }
    case HW_PARAM_DOUBLE: {
      const auto number = parse_double(text);
      if (number) value.as.real = *number;
      return number && in_range(*this, value) ? value : fail("a number " + range_text(*this));
    }
    case HW_PARAM_CHOICE: {
      const auto found = std::ranges::find(choices, text);
      if (found == choices.end()) {
        return fail(fmt::format("one of {}{}", fmt::join(choices, ", "), suggestion(text, choices)));
      }
      value.as.integer = found - choices.begin();
      return value;
    }
    default:
      return fail("settable: the parameter is of a type that this program does not know");
  }
}

Parameter read_parameter(const hw_param_info_t* info) {
  if (info == nullptr) fail_load("the description is null");
  if (!HW_HAS(info, hw_param_info_t, n_choices)) {
    fail_load(fmt::format("its size of {} bytes is too small", info->size));
  }
  Parameter parameter;
  parameter.name = read_text(info->name, "name");
  if (parameter.name.empty()) fail_load("its name is empty");
  try {
    parameter.unit = read_text(info->unit, "unit");
    parameter.help = read_text(info->help, "help");
    parameter.default_value = info->default_value;
    if (info->default_value.type != info->type) fail_load("its default is of another type");
    parameter.minimum = info->minimum;
    parameter.maximum = info->maximum;
    if (info->type == HW_PARAM_CHOICE) parameter.choices = read_choices(*info);
    if (info->type == HW_PARAM_BOOL || info->type == HW_PARAM_CHOICE) {
      const std::size_t last = info->type == HW_PARAM_BOOL ? 1 : parameter.choices.size() - 1;
      parameter.minimum = whole(info->type, 0);
      parameter.maximum = whole(info->type, static_cast<std::int64_t>(last));
    }
    if (info->type >= HW_PARAM_BOOL && info->type <= HW_PARAM_CHOICE) check_range(parameter);
    if (parameter.is_text()) read_text_facts(*info, parameter);
  } catch (const Error& error) {
    throw Error(error.code(), error.message(), {"", 0, fmt::format("parameter `{}`", parameter.name)});
  }
  return parameter;
}

}  // namespace hallway::host
