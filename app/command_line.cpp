// SPDX-License-Identifier: MIT
#include "command_line.hpp"

#include <algorithm>

#include "base/text.hpp"

namespace hallway::cli {

Option& Option::value(std::string name) {
  value_ = std::move(name);
  return *this;
}

Option& Option::required() {
  required_ = true;
  return *this;
}

Option& Option::repeatable() {
  repeatable_ = true;
  return *this;
}

Option& Option::numbers(int count) {
  numbers_ = count;
  return *this;
}

Option& Option::range(double least, double most) {
  range_.emplace(least, most);
  return *this;
}

Option& Option::choices(std::vector<std::string> words) {
  words_ = std::move(words);
  return *this;
}

Option& Option::fallback(std::string text) {
  fallback_ = std::move(text);
  return *this;
}

std::vector<std::string> Option::name_list() const {
  std::vector<std::string> list;
  for (const std::string_view name : split(names_, ',')) list.emplace_back(name);
  return list;
}

std::string Option::help() const {
  return help_ + (repeatable_ ? "; may be given several times" : "") +
         (fallback_.empty() ? "" : " [" + fallback_ + "]");
}

Option& Option::show_default() {
  shows_default_ = true;
  return *this;
}

Option& Option::shared() {
  shared_ = true;
  return *this;
}

Option& Option::excludes(const Option& other) {
  excluded_ = &other;
  return *this;
}

Command& Command::command(std::string name, std::string about) {
  commands_.push_back(std::make_unique<Command>(std::move(name), std::move(about)));
  commands_.back()->parent_ = this;
  return *commands_.back();
}

Option& Command::option(std::string names, Target target, std::string help) {
  options_.push_back(std::make_unique<Option>(std::move(names), target, std::move(help)));
  return *options_.back();
}

Option& Command::flag(std::string names, bool* target, std::string help) {
  return option(std::move(names), target, std::move(help));
}

Option& Command::argument(std::string name, Target target, std::string help) {
  return option(std::move(name), target, std::move(help));
}

const Command* Command::find(const std::string& name) const {
  const auto at =
      std::ranges::find_if(commands_, [&](const auto& command) { return command->name_ == name; });
  return at != commands_.end() ? at->get() : nullptr;
}

std::vector<const Option*> Command::arguments() const {
  std::vector<const Option*> found;
  for (const auto& option : options_) {
    if (option->is_argument()) found.push_back(option.get());
  }
  return found;
}

std::string Command::path() const {
  return parent_ != nullptr ? parent_->path() + " " + name_ : name_;
}

}  // namespace hallway::cli
