// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "base/refuse.hpp"
#include "base/text.hpp"
#include "completion.hpp"

// In each script @PROGRAM@ is the program and @FUNCTION@ its name as a part of names.
namespace hallway::cli {
namespace {

constexpr std::string_view kBash =
    R"sh(# Completions of @PROGRAM@ for bash, made by `@PROGRAM@ completion bash`.
_@FUNCTION@() {
  local line=${COMP_LINE:0:COMP_POINT} word about name
  local -a typed=()
  read -ra typed <<< "$line"
  [[ $line == *[[:blank:]] ]] && typed+=("")
  local current=${typed[-1]}
  # Bash breaks words after `=` and `:` and before `@`: only what follows the last break is replaced.
  local behind=${current##*[=:@]}
  [[ $current == *@"$behind" ]] && behind=@$behind
  local kept=${current%"$behind"}
  local -a found=()
  while IFS=$'\t' read -r word about; do
    case $word in
      :folders)
        compopt -o filenames 2>/dev/null
        while IFS= read -r name; do found+=("$name"); done < <(compgen -d -- "${current#"$kept"}")
        ;;
      :files)
        compopt -o filenames 2>/dev/null
        while IFS= read -r name; do
          [[ -z $about || -d $name || " $about " == *" ${name##*.} "* ]] && found+=("$name")
        done < <(compgen -f -- "${current#"$kept"}")
        ;;
      *) found+=("${word#"$kept"}") ;;
    esac
  done < <("${typed[0]}" completion --words "${typed[@]:1}" 2>/dev/null)
  COMPREPLY=("${found[@]}")
  [[ ${#COMPREPLY[@]} -eq 1 && ${COMPREPLY[0]} == *[=.] ]] && compopt -o nospace
  return 0
}
complete -F _@FUNCTION@ @PROGRAM@
)sh";

constexpr std::string_view kZsh = R"sh(#compdef @PROGRAM@
# Completions of @PROGRAM@ for zsh, made by `@PROGRAM@ completion zsh`.
_@FUNCTION@() {
  local line word about
  local -a found open
  for line in "${(@f)$(${(Q)words[1]} completion --words "${(@Q)words[2,CURRENT]}" 2>/dev/null)}"; do
    word=${line%%$'\t'*}
    about=
    [[ $line == *$'\t'* ]] && about=${line#*$'\t'}
    case $word in
      '') ;;
      :folders) _files -/ ;;
      :files) if [[ -n $about ]]; then _files -g "*.(${about// /|})(-.)"; else _files; fi ;;
      *=|*@*.) open+=("$word") ;;
      *) found+=("${word//:/\\:}${about:+:$about}") ;;
    esac
  done
  (( $#found )) && _describe -t values '@PROGRAM@' found
  (( $#open )) && compadd -S '' -- $open
}
if [[ $zsh_eval_context[-1] == loadautofunc ]]; then
  _@FUNCTION@ "$@"
else
  compdef _@FUNCTION@ @PROGRAM@
fi
)sh";

constexpr std::string_view kFish =
    R"sh(# Completions of @PROGRAM@ for fish, made by `@PROGRAM@ completion fish`.
function __@FUNCTION@
  set -l typed (commandline -opc)
  set -l current (commandline -ct)
  set -l program $typed[1]
  set -e typed[1]
  for line in ($program completion --words $typed "$current" 2>/dev/null)
    set -l parts (string split -m 1 \t -- $line)
    switch $parts[1]
      case :folders
        __fish_complete_directories "$current" ''
      case :files
        if test -n "$parts[2]"
          set -l wanted '(/|\.('(string replace -a ' ' '|' -- $parts[2])'))$'
          for file in (__fish_complete_path "$current")
            set -l name (string split -m 1 \t -- $file)[1]
            string match -qr -- $wanted $name; and echo $name
          end
        else
          __fish_complete_path "$current"
        end
      case '*'
        echo $line
    end
  end
end
complete -c @PROGRAM@ -f -a '(__@FUNCTION@)'
)sh";

std::string filled_in(std::string_view script, const std::string& program) {
  std::string function = program;
  for (char& c : function) c = c == '-' ? '_' : c;
  std::string text(script);
  for (const auto& [place, value] :
       {std::pair<std::string, std::string>("@PROGRAM@", program), {"@FUNCTION@", function}}) {
    for (std::size_t at = text.find(place); at != std::string::npos; at = text.find(place, at + value.size()))
      text.replace(at, place.size(), value);
  }
  return text;
}

}  // namespace

std::string completion_script(const std::string& program, std::string_view shell) {
  if (shell == "bash") return filled_in(kBash, program);
  if (shell == "zsh") return filled_in(kZsh, program);
  if (shell == "fish") return filled_in(kFish, program);
  refuse("there is no completion for the shell \"{}\"; there are bash, zsh and fish", printable(shell));
}

}  // namespace hallway::cli
