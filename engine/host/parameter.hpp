// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/ext/params.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hallway::host {

/// One parameter that a plugin declares (hw.params/1 and /2), checked and copied.
struct Parameter {
  std::string name;                  ///< distinct within the plugin
  std::string unit;                  ///< empty where it has none
  std::string help;                  ///< one sentence
  hw_param_value_t default_value;    ///< within the range
  hw_param_value_t minimum;          ///< of numbers
  hw_param_value_t maximum;          ///< of numbers
  std::vector<std::string> choices;  ///< of HW_PARAM_CHOICE
  std::string default_text{};        ///< of texts
  bool writable = false;             ///< of files and folders: the plugin writes there

  /// Whether its values are texts: HW_PARAM_TEXT, HW_PARAM_FILE, HW_PARAM_FOLDER.
  bool is_text() const;
  /// Whether its values are paths: HW_PARAM_FILE, HW_PARAM_FOLDER.
  bool is_path() const;
  /// "bool", "int", "double", "choice", "text", "file" or "folder".
  std::string type_name() const;
  /// The text form of the default.
  std::string default_value_text() const { return is_text() ? default_text : print(default_value); }
  /// The text form of a value that is no text: "true", "20", "0.05", a choice's name. parse() reads it back as the same
  /// value.
  std::string print(const hw_param_value_t& value) const;
  /// The value that `text` says. Throws Error{kBadInput} naming the parameter, the text and what is allowed.
  hw_param_value_t parse(std::string_view text) const;
};

/// Checks and copies what a plugin declares. Throws Error{kPluginLoad} naming what is not as params.h says.
Parameter read_parameter(const hw_param_info_t* info);

}  // namespace hallway::host
