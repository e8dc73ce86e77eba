// SPDX-License-Identifier: MIT
#include "program.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <map>
#include <type_traits>

#include "base/error.hpp"
#include "base/refuse.hpp"
#include "base/text.hpp"
#include "completion.hpp"
#include "console.hpp"
#include "plugin_path.hpp"

// The one source that knows CLI11: its templates are made here, once for each type of value.
namespace hallway::cli {
namespace {

/// The first words are the command; the parser would only say that one is required.
void check_command(const Command& program, int argc, char** argv) {
  const Command* group = &program;
  for (int i = 1; i < argc && argv[i][0] != '-' && !group->commands().empty(); ++i) {
    group = &command_below(*group, argv[i]);
  }
}

/// Answers what a shell asks while a command line is typed. @return false if that is not what the arguments are
bool answer_shell(const Command& program, int argc, char** argv) {
  if (argc < 3 || std::strcmp(argv[1], kCompletionCommand) != 0 ||
      std::strcmp(argv[2], kCompletionWords) != 0)
    return false;
  const std::vector<std::string> words(argv + 3, argv + argc);
  print_result(print_completion(complete(program, words, plugin_folders({}))));
  return true;
}

template <typename T>
struct Scalar {
  using Type = T;
};
template <typename T>
struct Scalar<std::optional<T>> {
  using Type = T;
};
template <typename T>
struct Scalar<std::vector<T>> {
  using Type = T;
};

/// A check of the type that the value has, so that help names it.
template <typename T>
CLI::Validator range_of(std::pair<double, double> limits) {
  if constexpr (std::is_arithmetic_v<T>) {
    const CLI::Range usual(static_cast<T>(limits.first), static_cast<T>(limits.second));
    if constexpr (std::is_floating_point_v<T>) {
      // CLI11 refuses what lies outside, which nan does not.
      const std::string described = usual.get_description();
      return CLI::Validator(
          [usual, described](std::string& text) {
            T value{};
            if (CLI::detail::lexical_cast(text, value) && std::isnan(value))
              return "Value " + text + " not in range " + described.substr(described.find('['));
            return usual(text);
          },
          described);
    } else {
      return usual;
    }
  } else {
    throw Error(ErrorCode::kInternal, "a range belongs to a number");
  }
}

/// CLI11 reads -1 as 2^64 - 1, and all that is larger than that likewise.
CLI::Validator is_natural() {
  return CLI::Validator(
      [](const std::string& text) {
        errno = 0;
        std::strtoull(text.c_str(), nullptr, 0);
        return text.starts_with('-') || errno == ERANGE ? "Value " + text + " not in range 0 to 2^64 - 1"
                                                        : "";
      },
      "");
}

/// `--out ''` is a mistake, such as a shell variable without a value, and not the same as no --out.
CLI::Validator not_empty() {
  return CLI::Validator([](const std::string& text) { return text.empty() ? "the value is empty" : ""; }, "");
}

bool takes_text(const Option& option) {
  return std::visit(
      [](auto* target) {
        using T = std::remove_pointer_t<decltype(target)>;
        return std::is_same_v<typename Scalar<T>::Type, std::string>;
      },
      option.target());
}

/// The parser of one command line: CLI11's commands, made from ours.
class Parser {
 public:
  explicit Parser(const Command& program) : app_(program.about(), program.name()) { fill(app_, program); }

  void parse(int argc, char** argv) {
    app_.parse(argc, argv);
    for (const auto& [app, words] : rest_) take_rest(*app, *words);
  }
  /// What the arguments ask for, once they are parsed; null before.
  const Command* chosen() const { return chosen_; }
  /// Prints what a parse ended with that is no failure: help, the version.
  void print(const CLI::ParseError& stop) const { app_.exit(stop); }
  /// The words that no command and no option takes, in their order.
  std::vector<std::string> unexpected() const { return app_.remaining(true); }
  /// The command in whose arguments the parse stopped.
  const Command& last() const {
    const CLI::App* app = &app_;
    while (!app->get_subcommands().empty()) app = app->get_subcommands().front();
    return *commands_.at(app);
  }

 private:
  void fill(CLI::App& app, const Command& command) {
    commands_[&app] = &command;
    for (const auto& option : command.options()) add(app, *option);
    if (!command.footer().empty()) app.footer(command.footer());
    if (!command.version().empty()) app.set_version_flag("--version", command.version());
    if (command.rest() != nullptr) {
      app.prefix_command();
      rest_[&app] = command.rest();
    }
    if (!command.commands().empty()) app.require_subcommand(1);
    for (const auto& below : command.commands())
      fill(*app.add_subcommand(below->name(), below->about()), *below);
    if (command.action()) app.callback([this, &command] { chosen_ = &command; });
  }

  void add(CLI::App& app, const Option& option) {
    CLI::Option* added =
        std::visit([&](auto* target) { return add_to(app, option, target); }, option.target());
    if (!option.value_name().empty()) added->type_name(option.value_name());
    if (takes_text(option)) added->check(not_empty());
    if (!option.words().empty()) added->check(CLI::IsMember(option.words()));
    if (option.shows_default()) added->capture_default_str();
    if (option.is_required()) added->required();
    if (option.is_repeatable()) added->take_all()->expected(1);
    if (option.number_count() > 0) added->delimiter(',')->expected(option.number_count());
    if (option.excluded() != nullptr) added->excludes(options_.at(option.excluded()));
    options_[&option] = added;
  }

  template <typename T>
  static CLI::Option* add_to(CLI::App& app, const Option& option, T* target) {
    if constexpr (std::is_same_v<T, bool>) {
      return app.add_flag(option.names(), *target, option.help());
    } else {
      CLI::Option* added = app.add_option(option.names(), *target, option.help());
      if (option.limits()) added->check(range_of<typename Scalar<T>::Type>(*option.limits()));
      if constexpr (std::is_same_v<typename Scalar<T>::Type, std::uint64_t>) added->check(is_natural());
      return added;
    }
  }

  static void take_rest(const CLI::App& app, std::vector<std::string>& words) {
    for (const std::string& word : app.remaining()) {
      if (word != "--" || !words.empty()) words.push_back(word);
    }
  }

  CLI::App app_;
  const Command* chosen_ = nullptr;
  std::map<const CLI::App*, const Command*> commands_;
  std::map<const CLI::App*, std::vector<std::string>*> rest_;
  std::map<const Option*, CLI::Option*> options_;
};

/// ` (did you mean "--plugin"?)` for the first option that the command does not have.
std::string correction(const Command& command, int argc, char** argv) {
  std::vector<std::string> names{"--help"};
  for (const auto& option : command.options()) {
    for (std::string& name : option->name_list()) names.push_back(std::move(name));
  }
  for (int i = 1; i < argc; ++i) {
    const std::string word(argv[i], std::strcspn(argv[i], "="));
    if (word.starts_with("--") && std::ranges::find(names, word) == names.end())
      return suggestion(word, names);
  }
  return "";
}

/// An argument that is wrong, and where to read what is right.
int report_parse(const Parser& parser, const CLI::ParseError& stop, int argc, char** argv) {
  const Command& command = parser.last();
  std::string message = stop.what();
  if (dynamic_cast<const CLI::ExtrasError*>(&stop) != nullptr)
    message = fmt::format("not expected: {}{}",
                          printable(fmt::format("{}", fmt::join(parser.unexpected(), " ")), 500),
                          correction(command, argc, argv));
  const int status = report_failure(Error(ErrorCode::kUsage, message), asks_for_json(argc, argv));
  fmt::print(stderr, "Try `{} --help`.\n", command.path());
  return status;
}

}  // namespace

bool asks_for_json(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--json") == 0) return true;
  }
  return false;
}

const Command& command_below(const Command& group, const std::string& name) {
  if (const Command* command = group.find(name)) return *command;
  std::vector<std::string> names;
  for (const auto& known : group.commands()) names.push_back(known->name());
  const std::string path = group.path();
  const std::size_t space = path.find(' ');
  if (names.empty())
    refuse("`{}` has no command \"{}\"; `{} --help` says what it takes", path, printable(name), path);
  refuse("there is no command \"{}{}\"{}; there are: {}",
         space == std::string::npos ? "" : path.substr(space + 1) + " ", printable(name),
         suggestion(name, names), fmt::join(names, ", "));
}

int run_program(const Command& program, int argc, char** argv) {
  if (answer_shell(program, argc, argv)) return 0;
  check_command(program, argc, argv);
  Parser parser(program);
  try {
    parser.parse(argc, argv);
  } catch (const CLI::ParseError& stop) {
    if (stop.get_exit_code() != 0) return report_parse(parser, stop, argc, argv);
    parser.print(stop);
    return 0;
  }
  return parser.chosen()->action()();
}

int run_program(const Command& program, std::vector<std::string> arguments) {
  std::vector<char*> argv;
  for (std::string& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  return run_program(program, static_cast<int>(arguments.size()), argv.data());
}

}  // namespace hallway::cli
