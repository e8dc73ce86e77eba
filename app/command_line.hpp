// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace hallway::cli {

/// What the command line asks for; called once it is parsed. @return the exit status
using Action = std::function<int()>;

/// Where the parser writes what an option was given. It has to outlive the parse and the command's action.
using Target =
    std::variant<bool*, std::string*, std::optional<std::string>*, std::vector<std::string>*, double*,
                 std::optional<double>*, std::vector<double>*, int*, std::int64_t*, std::uint32_t*,
                 std::optional<std::uint32_t>*, std::uint64_t*, std::optional<std::uint64_t>*>;

/// An option, a flag or an argument of a command: what it is called, what it takes and where that goes. Data only: the parser, the help, the man
/// pages and the completions of shells are made from it.
class Option {
 public:
  Option(std::string names, Target target, std::string help)
      : names_(std::move(names)), target_(target), help_(std::move(help)) {}

  /// What stands for its value in help texts: "DIR", "SCENARIO|LOG". docs/commands.md lists the words; completions follow from them.
  Option& value(std::string name);
  /// It has to be given.
  Option& required();
  /// It may be given several times; each time it takes one value.
  Option& repeatable();
  /// It takes this many numbers between commas.
  Option& numbers(int count);
  /// The smallest and the largest number allowed.
  Option& range(double least, double most);
  /// The words allowed.
  Option& choices(std::vector<std::string> words);
  /// What counts where it is not given: help shows that in brackets.
  Option& fallback(std::string text);
  /// Help shows the value that the target has now as the default.
  Option& show_default();
  /// It is one that several commands have: a row of the table in shared_options.cpp.
  Option& shared();
  /// It may not be given together with an earlier option of the same command.
  Option& excludes(const Option& other);

  const std::string& names() const {
    return names_;
  }  ///< as help has them: "-f,--file", or "map" for an argument
  bool is_argument() const { return names_.front() != '-'; }
  std::vector<std::string> name_list() const;  ///< {"-f", "--file"}
  bool is_flag() const { return std::holds_alternative<bool*>(target_); }
  const Target& target() const { return target_; }
  const std::string& about() const { return help_; }
  std::string help() const;  ///< what it is, whether it may be repeated, and what counts without it
  const std::string& value_name() const { return value_; }
  bool is_required() const { return required_; }
  bool is_repeatable() const { return repeatable_; }
  int number_count() const { return numbers_; }  ///< 0: no list of numbers
  const std::optional<std::pair<double, double>>& limits() const { return range_; }
  const std::vector<std::string>& words() const { return words_; }
  const std::string& fallback_text() const { return fallback_; }
  bool shows_default() const { return shows_default_; }
  bool is_shared() const { return shared_; }
  const Option* excluded() const { return excluded_; }

 private:
  std::string names_;
  Target target_;
  std::string help_;
  std::string value_;
  std::string fallback_;
  bool required_ = false;
  bool repeatable_ = false;
  int numbers_ = 0;
  std::optional<std::pair<double, double>> range_;
  std::vector<std::string> words_;
  bool shows_default_ = false;
  bool shared_ = false;
  const Option* excluded_ = nullptr;
};

/// A program, a command of it, or a group of commands. A tree of data: parse_command_line() is what reads arguments by it.
class Command {
 public:
  Command(std::string name, std::string about) : name_(std::move(name)), about_(std::move(about)) {}

  /// Adds a command below this one, which thereby is a group: one of its commands has to be given. References to commands and options stay valid.
  Command& command(std::string name, std::string about);
  /// Adds an option that takes a value: `names` are "--out" or "-f,--file".
  Option& option(std::string names, Target target, std::string help);
  /// Adds an option without a value.
  Option& flag(std::string names, bool* target, std::string help);
  /// Adds an argument, which is told by its place.
  Option& argument(std::string name, Target target, std::string help);
  /// From the first word that no argument takes, all words go to `words`, options among them; a leading "--" is dropped.
  void rest(std::vector<std::string>* words) { rest_ = words; }
  /// What the last of `words` may become, where those are all arguments and what goes to rest(): for the completions of shells.
  using Completer = std::function<std::vector<std::string>(const std::vector<std::string>& words)>;
  void complete_rest(Completer completer) { completer_ = std::move(completer); }
  /// What help says at its end: exit statuses, examples.
  void footer(std::string text) { footer_ = std::move(text); }
  /// What a manual page's first line says, where help begins with more than one line.
  void summary(std::string text) { summary_ = std::move(text); }
  /// What `--version` prints.
  void version(std::string text) { version_ = std::move(text); }
  /// What the command does.
  void action(Action action) { action_ = std::move(action); }
  /// What it does, with the options that it fills: they live as long as the command.
  template <typename Options>
  Options& runs(int (*run)(const Options& options)) {
    const auto options = std::make_shared<Options>();
    action([options, run] { return run(*options); });
    return *options;
  }

  const std::string& name() const { return name_; }
  const std::string& about() const { return about_; }  ///< what help says first
  const std::string& summary() const { return summary_.empty() ? about_ : summary_; }  ///< one line
  const Command* parent() const { return parent_; }
  const std::string& footer() const { return footer_; }
  const std::string& version() const { return version_; }
  const Action& action() const { return action_; }
  std::vector<std::string>* rest() const { return rest_; }
  const Completer& rest_completer() const { return completer_; }
  std::vector<const Option*> arguments() const;  ///< those of options() that are told by their place
  const std::vector<std::unique_ptr<Option>>& options() const { return options_; }  ///< in the order of help
  const std::vector<std::unique_ptr<Command>>& commands() const { return commands_; }
  /// The command of that name directly below, or null.
  const Command* find(const std::string& name) const;
  /// The words that lead here, the program's first: "hallway map ray".
  std::string path() const;

 private:
  std::string name_;
  std::string about_;
  std::string summary_;
  std::string footer_;
  std::string version_;
  Action action_;
  std::vector<std::string>* rest_ = nullptr;
  Completer completer_;
  std::vector<std::unique_ptr<Option>> options_;
  std::vector<std::unique_ptr<Command>> commands_;
  const Command* parent_ = nullptr;
};

}  // namespace hallway::cli
