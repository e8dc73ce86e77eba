#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Lists public names of production code that no production code uses.

usage: unused.py [--build FOLDER] [ROOT]

A public name is a function, type, constant, enumerator or member that a header of sdk, geometry, engine, editor, cli,
robot, loaders or plugins declares. It is used where it stands in one of their files in any other way than as its own
declaration, its definition, or within the body of that definition. Comments, texts and tests are no use.

Two things of one name cannot be told apart that way. With --build, the objects in a build folder decide for functions:
a function is unused if no other production object refers to it, and no file of its folder and none that includes its
header uses its name. Inline functions and members that share their name with others in use stay unlisted.

Each line: place, name, and "(tests)" where a test or benchmark uses it. Exit status 1 where there is any.
"""
import collections
import os
import re
import subprocess
import sys

PRODUCTION = ("sdk", "geometry", "engine", "editor", "app", "cli", "robot", "loaders", "plugins")
OTHERS = ("tests", "bench")
ENDINGS = (".h", ".hpp", ".c", ".cpp", ".in")
HEADERS = (".h", ".hpp")

# Names that have no user here, and stay.
EXCEPTIONS = {
    "sdk/include/": "the ABI is for programs of others",
    "third_party/": "not ours",
}
EXCEPTED_NAMES = {
    "iterator": "range-based for", "begin": "range-based for", "end": "range-based for",
    "value_type": "algorithms of the standard", "difference_type": "algorithms of the standard",
    "reference": "algorithms of the standard", "pointer": "algorithms of the standard",
    "iterator_category": "algorithms of the standard", "rebind": "containers of the standard",
    "kContinue": "a number of a choice, which is compared with the two others",
    "read_observations": "for tests and benchmarks that look at a run's folder", "StringOutput": "a log in memory, for tests",
    "construct": "containers of the standard", "__asan_default_options": "the address sanitizer calls it",
}

TOKEN = re.compile(
    r"""(?P<skip>//[^\n]*|/\*.*?\*/|^[ \t]*\#[ \t]*(?:include|pragma|error|if|ifdef|ifndef|elif|else|endif|undef)\b(?:\\\n|[^\n])*)
      | (?P<define>^[ \t]*\#[ \t]*define\b)
      | (?P<text>(?:u8|[uUL])?R"(?P<mark>[^()\\\s]{0,16})\(.*?\)(?P=mark)"|"(?:\\.|[^"\\\n])*"|'(?:\\.|[^'\\\n])+')
      | (?P<number>\.?\d(?:'?[\w.]|(?<=[eEpP])[+-])*)
      | (?P<name>[A-Za-z_]\w*)
      | (?P<operator>::|->|\[\[|\]\]|&&|\S)""",
    re.DOTALL | re.VERBOSE | re.MULTILINE)
KEYWORDS = set("""alignas alignof auto bool break case catch char class concept const consteval constexpr constinit continue
co_await co_return co_yield decltype default delete do double else enum explicit export extern false final float for friend
if inline int long mutable namespace new noexcept nullptr operator override private protected public register requires return
short signed sizeof static static_assert static_cast const_cast dynamic_cast reinterpret_cast struct switch template this
thread_local throw true try typedef typeid typename union unsigned using virtual void volatile while""".split())

Token = collections.namedtuple("Token", "kind text line")


def tokens_of(text):
    found, line, at = [], 1, 0
    for match in TOKEN.finditer(text):
        line += text.count("\n", at, match.start())
        at = match.start()
        if match.lastgroup not in ("skip", "mark"):
            kind = "text" if match.lastgroup == "mark" else match.lastgroup
            found.append(Token(kind, match.group(), line))
    return found


def is_name(token):
    return token.kind == "name" and token.text not in KEYWORDS


class File:
    """Which names a file declares, and where it uses which."""

    def __init__(self, path, text):
        self.path = path
        self.declared = []  # (name, line, kind)
        self.uses = collections.Counter()
        self.all_uses = collections.Counter()  # also by functions of the same name
        self.includes = set(re.findall(r'^\s*#\s*include\s*"([^"]+)"', text, re.MULTILINE))
        self.tokens = tokens_of(text)
        self.own = set()  # indices of tokens that declare or define
        self.bodies = []  # (first, last, name) of function definitions
        self.read_scope(0, "namespace")
        inside = collections.defaultdict(list)
        for first, last, name in self.bodies:
            inside[name].append((first, last))
        for i, token in enumerate(self.tokens):
            if not is_name(token) or i in self.own:
                continue
            self.all_uses[token.text] += 1
            if any(first <= i < last for first, last in inside.get(token.text, ())):
                continue
            self.uses[token.text] += 1

    def declare(self, index, kind):
        self.own.add(index)
        self.declared.append((self.tokens[index].text, self.tokens[index].line, kind))

    def read_scope(self, at, scope):
        """Reads statements from `at` to the end of the scope; gives the index behind it."""
        statement = []
        while at < len(self.tokens):
            text = self.tokens[at].text
            if text == "}":
                return at + 1
            if text == "{":
                at = self.open(statement, at, scope)
                if at < len(self.tokens) and self.tokens[at].text == ";":
                    at += 1
                    statement = []
                elif self.went_on:
                    continue
                else:
                    statement = []
                continue
            if text == ";" or (text == ":" and statement and self.tokens[statement[-1]].text in
                               ("public", "private", "protected")):
                self.take(statement, scope)
                statement = []
            elif text in "([":
                end = self.skip(at)
                statement.extend(range(at, end))
                at = end
                continue
            else:
                statement.append(at)
            at += 1
        return at

    def skip(self, at):
        """Behind the bracket that closes the one at `at`."""
        depth = 0
        while at < len(self.tokens):
            text = self.tokens[at].text
            depth += text in "([{" if len(text) == 1 else 2 * (text == "[[")
            depth -= text in ")]}" if len(text) == 1 else 2 * (text == "]]")
            at += 1
            if depth == 0:
                break
        return at

    def open(self, statement, at, scope):
        self.went_on = False
        words = [self.tokens[i].text for i in statement]
        flat = self.flat(statement)
        kinds = [self.tokens[i].text for i in flat]
        if "namespace" in words or (words[:1] == ["extern"] and len(words) == 2):
            return self.read_scope(at + 1, "namespace")
        called = self.function_name(flat)
        if "enum" in kinds and called is None:
            self.take_type(flat)
            return self.read_enum(at + 1)
        if any(k in kinds for k in ("struct", "class", "union")) and called is None:
            self.take_type(flat)
            return self.read_scope(at + 1, "class")
        end = self.skip(at)
        if called is not None and "=" not in kinds[:1]:
            name, index = called
            after = self.tokens[end].text if end < len(self.tokens) else ""
            if ":" in self.tops(statement) and (after in ",{" and after):  # an initialiser of a member
                statement.extend(range(at, end))
                self.went_on = True
                return end
            self.declare(index, "function")
            self.bodies.append((statement[0], end, name))
            return end
        statement.extend(range(at, end))  # an initialiser
        self.went_on = True
        return end

    def tops(self, statement):
        return [self.tokens[i].text for i in self.flat(statement)]

    def flat(self, statement):
        """The statement without what stands in brackets and template arguments."""
        kept, depth, angle = [], 0, 0
        previous = ""
        for i in statement:
            text = self.tokens[i].text
            if text in ("(", "[", "{", "[["):
                if depth == 0 and angle == 0 and text == "(":
                    kept.append(i)
                depth += 2 if text == "[[" else 1
            elif text in (")", "]", "}", "]]"):
                depth -= 2 if text == "]]" else 1
            elif depth == 0:
                if text == "<" and previous != "operator" and (angle or re.match(r"\w", previous)):
                    angle += 1
                elif text == ">" and angle:
                    angle -= 1
                elif angle == 0:
                    kept.append(i)
            previous = text
        return kept

    def function_name(self, flat):
        for place, i in enumerate(flat):
            text = self.tokens[i].text
            if text in ("=", "operator", ":"):
                return None
            if text == "(" and place > 0:
                before = self.tokens[flat[place - 1]]
                if before.text in ("decltype", "alignas", "noexcept", "explicit", "requires", "static_assert"):
                    continue
                if not is_name(before):
                    return None
                return before.text, flat[place - 1]
        return None

    def take_type(self, flat):
        for place, i in enumerate(flat):
            if self.tokens[i].text in ("struct", "class", "union", "enum"):
                names = [j for j in flat[place + 1:] if is_name(self.tokens[j])]
                if names:
                    self.declare(names[0], "type")
                return

    def take(self, statement, scope):
        """A statement without a body."""
        flat = self.flat(statement)
        words = [self.tokens[i].text for i in flat]
        if not words or words[0] in ("static_assert", "public", "private", "protected", "friend"):
            return
        if words[0] == "using":
            if "=" in words:
                self.declare(flat[1], "type")
            return
        called = self.function_name(flat)
        if called is not None:
            if words[0] not in ("return", "throw", "if", "for") and (len(words) > 2 or scope == "class"):
                self.declare(called[1], "function")
            return
        if "operator" in words or "typedef" in words:
            return
        end = words.index("=") if "=" in words else words.index(":") if ":" in words else len(words)
        names = [i for i in flat[:end] if is_name(self.tokens[i])]
        if words[0] in ("struct", "class", "union", "enum") and len(names) == 1:
            self.own.update(names)  # declared before it is defined
        elif len(flat[:end]) >= 2 and names:
            self.declare(names[-1], "member" if scope == "class" else "constant")

    def read_enum(self, at):
        first = True
        while at < len(self.tokens):
            token = self.tokens[at]
            if token.text == "}":
                return at + 1
            if token.text in ("(", "{", "["):
                at = self.skip(at)
                continue
            if first and is_name(token):
                self.declare(at, "enumerator")
            first = token.text == ","
            at += 1
        return at


def read(root, folders):
    for folder in folders:
        for path, below, names in os.walk(os.path.join(root, folder)):
            below.sort()
            for name in sorted(names):
                if name.endswith(ENDINGS):
                    full = os.path.join(path, name)
                    with open(full, encoding="utf-8") as source:
                        yield File(os.path.relpath(full, root), source.read())


def objects_of(build):
    for folder in PRODUCTION:
        for path, _, names in os.walk(os.path.join(build, folder)):
            for name in names:
                if name.endswith(".o") and "precompiled" not in path:
                    yield os.path.join(path, name)


def plain(symbol):
    """A demangled function as its qualified name, without arguments."""
    symbol = re.sub(r"\[abi:\w+\]", "", symbol)
    depth = 0
    for i, c in enumerate(symbol):
        depth += c == "<"
        depth -= c == ">"
        if c == "(" and depth == 0 and not symbol.startswith("(anonymous", i):
            return symbol[:i]
    return symbol


def unreferenced(build):
    """Functions that an object defines and no other object refers to, as {folder: [qualified name]}."""
    defined, wanted = {}, set()
    for path in objects_of(build):
        folder = os.path.relpath(path, build).split("/CMakeFiles/")[0]
        output = subprocess.run(["nm", "-C", path], capture_output=True, text=True, check=True).stdout
        for line in output.splitlines():
            kind, symbol = line[17:18], line[19:]
            if kind == "U":
                wanted.add(symbol)
            elif kind == "T":
                defined[symbol] = folder
    found = collections.defaultdict(list)
    for symbol, folder in defined.items():
        if symbol not in wanted and symbol.startswith("hallway::"):
            found[folder].append(plain(symbol))
    return found


def main():
    arguments = sys.argv[1:]
    build = None
    if "--build" in arguments[:-1]:
        at = arguments.index("--build")
        build = arguments[at + 1]
        del arguments[at:at + 2]
    if len(arguments) > 1 or any(a.startswith("-") for a in arguments):
        sys.exit(__doc__)
    root = arguments[0] if arguments else os.path.join(os.path.dirname(os.path.abspath(__file__)), "..")
    if not os.path.isdir(os.path.join(root, "sdk")):
        sys.exit(f"{root}: no folder sdk in it: not a tree of Hallway")
    files = list(read(root, PRODUCTION))
    uses, others = collections.Counter(), collections.Counter()
    for file in files:
        uses.update(file.uses)
    for file in read(root, OTHERS):
        others.update(file.uses)
    listed = set()
    for file in files:
        if not file.path.endswith(HEADERS) or any(file.path.startswith(e) for e in EXCEPTIONS):
            continue
        for name, line, kind in file.declared:
            if uses[name] == 0 and name not in EXCEPTED_NAMES:
                listed.add((file.path, line, kind, name))
    for folder, symbols in (unreferenced(build) if build else {}).items():
        near = [f for f in files if os.path.dirname(f.path) == folder]
        for symbol in symbols:
            name = symbol.split("::")[-1]
            for header in near:
                lines = [line for other, line, kind in header.declared if other == name and kind == "function"]
                if not header.path.endswith(HEADERS) or not lines or name in EXCEPTED_NAMES or uses[name] == 0:
                    continue
                included = header.path.removeprefix("engine/")
                if not any(f.all_uses[name] for f in files
                           if f in near or included in f.includes or header.path in f.includes):
                    listed.update((header.path, line, "function", symbol.removeprefix("hallway::")) for line in lines)
    for path, line, kind, name in sorted(listed):
        tests = " (tests)" if others[name.split("::")[-1]] else ""
        print(f"{path}:{line}: {kind} {name}{tests}")
    sys.exit(1 if listed else 0)


main()
