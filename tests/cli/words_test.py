#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""words_test.py SOURCE [--program HALLWAY] [--list]: the words of docs, help and messages.

Refuses the expressions of words.txt in the prose of Markdown pages, in the string literals of sources and in the help texts of the program,
and sentences of more than 30 words in the README and the tutorials. Each finding is a line FILE:LINE: cause. Exit status: 0 none, 1 some.
"""
import argparse
import fnmatch
import re
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
LONGEST_SENTENCE = 30
SHORT_SENTENCES = ["README.md", "docs/tutorial*.md", "docs/install.md"]
SOURCE_FOLDERS = ("app", "cli", "editor", "engine", "loaders", "plugins", "robot", "sdk")
CHANGELOG = "CHANGELOG.md"


def rules(path):
    """The rules of words.txt: (expression, advice, patterns of files where it is right)."""
    found = []
    for number, line in enumerate(path.read_text().splitlines(), 1):
        if not line.strip() or line.startswith("#"):
            continue
        columns = re.split(r"\s{2,}", line.rstrip())
        if len(columns) not in (2, 3):
            sys.exit(f"{path}:{number}: two or three columns are expected")
        allowed = [one.strip() for one in columns[2].split(",")] if len(columns) == 3 else []
        found.append((re.compile(columns[0], re.IGNORECASE), columns[1], allowed))
    return found


def prose(text):
    """A Markdown page without code, links' addresses and tables' rules, line by line; lines keep their numbers."""
    lines, fenced = [], False
    for line in text.splitlines():
        if line.lstrip().startswith("```"):
            fenced = not fenced
            line = ""
        elif fenced or re.match(r" {4,}\S|\t", line):
            line = ""
        line = re.sub(r"`[^`]*`", "CODE", line)
        line = re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", line)
        lines.append(line)
    return lines


LITERAL = re.compile(r'R"(\w*)\((?P<raw>.*?)\)\1"|"(?P<plain>(?:[^"\\\n]|\\.)*)"', re.DOTALL)
COMMENT = re.compile(r"//[^\n]*|/\*.*?\*/|'(?:[^'\\\n]|\\.)'", re.DOTALL)


def literals(text):
    """(line, text) of a source's string literals; literals that follow one another are one."""
    # Comments and literals exclude each other: whichever begins first wins.
    token = re.compile(f"(?P<comment>{COMMENT.pattern})|{LITERAL.pattern}", re.DOTALL)
    found, end = [], -1
    for match in token.finditer(text):
        include = text[text.rfind("\n", 0, match.start()) + 1:match.start()].startswith("#include")
        if match.group("comment") is not None or include:
            continue
        value = match.group("raw") if match.group("raw") is not None else match.group("plain")
        if found and text[end:match.start()].strip() == "":
            found[-1][1] += value
        else:
            found.append([text.count("\n", 0, match.start()) + 1, value])
        end = match.end()
    return found


# Not `out/home/…`, which is a folder of the project's own; `/home/me` and `/home/you` are nobody's.
FOLDER_OF_A_MACHINE = re.compile(rb"(?<![\w.\-})])/(?:home/(?!me\b|you\b)|Users/|work/)[A-Za-z][\w.-]*")


def sentences(lines):
    """(line, sentence) of prose. A table's cell, a heading and an item of a list end a sentence."""
    found, words, began = [], [], 1

    def finish():
        if words:
            found.append((began, " ".join(words)))
        words.clear()

    for number, line in enumerate(lines, 1):
        stripped = line.strip()
        if not stripped or re.match(r"[#|>*-]|\d+\. ", stripped):
            finish()
        cells = stripped.strip("|").split("|") if stripped.startswith("|") else [stripped]
        for cell in cells:
            for word in cell.split():
                if not words:
                    began = number
                words.append(word)
                if re.search(r"[.!?][\")*]*$", word) and not re.search(r"(e\.g|i\.e|etc|cf|vs)\.$", word):
                    finish()
            if stripped.startswith("|"):
                finish()
    finish()
    return found


def tracked(source):
    out = subprocess.run(["git", "-C", source, "ls-files", "-co", "--exclude-standard"], capture_output=True, text=True)
    if out.returncode == 0:
        return [name for name in out.stdout.splitlines() if (source / name).is_file()]
    return [str(path.relative_to(source)) for path in source.rglob("*") if path.is_file() and "build" not in path.parts]


def pieces(name, text):
    """(line, text) of what a reader sees of a file."""
    if name.endswith(".md"):
        return list(enumerate(prose(text), 1))
    return [(line, value) for line, value in literals(text)]


def help_texts(program):
    """(command, text) of the program's help, command by command, by walking its lists of subcommands."""
    def visit(words):
        text = subprocess.run([program, *words, "--help"], capture_output=True, text=True, check=True).stdout
        yield " ".join(["hallway", *words, "--help"]), text
        listed = re.search(r"^(?:Subcommands|SUBCOMMANDS|Commands):\n((?:  .*\n|\n)*)", text, re.MULTILINE)
        for name in re.findall(r"^  ([a-z][a-z0-9-]*)", listed.group(1), re.MULTILINE) if listed else []:
            yield from visit([*words, name])
    yield from visit([])


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("source", type=Path)
    parser.add_argument("--program", type=Path)
    arguments = parser.parse_args()
    the_rules = rules(HERE.parent / "words.txt")
    findings, seen = [], 0

    def look(where, name, text):
        for expression, advice, allowed in the_rules:
            match = expression.search(text)
            if match and not any(fnmatch.fnmatch(name, pattern) for pattern in allowed):
                findings.append(f"{where}: '{match.group(0)}': {advice}")

    for name in tracked(arguments.source):
        # Recordings and pictures too: what was made on some machine must not say where.
        folder = FOLDER_OF_A_MACHINE.search((arguments.source / name).read_bytes())
        if folder:
            findings.append(f"{name}: names a folder of the machine that made it: {folder.group(0).decode()}")
        source_file = name.startswith(SOURCE_FOLDERS) and name.endswith((".cpp", ".hpp", ".h"))
        if not (source_file or name.endswith(".md")) or name == CHANGELOG or name.startswith("third_party/"):
            continue
        text = (arguments.source / name).read_text(errors="replace")
        seen += 1
        for line, piece in pieces(name, text):
            look(f"{name}:{line}", name, piece)
        if any(fnmatch.fnmatch(name, pattern) for pattern in SHORT_SENTENCES):
            for line, sentence in sentences(prose(text)):
                length = len(re.findall(r"[A-Za-z0-9]", " ".join(w[0] for w in sentence.split())))
                if length > LONGEST_SENTENCE:
                    findings.append(f"{name}:{line}: a sentence of {length} words: {sentence[:60]} …")
    if arguments.program:
        commands = 0
        for command, text in help_texts(arguments.program):
            commands += 1
            for number, line in enumerate(text.splitlines(), 1):
                look(f"{command}:{number}", command, line)
        if commands < 20:
            findings.append(f"{arguments.program}: only {commands} commands have help")
    if seen < 100:
        findings.append(f"{arguments.source}: only {seen} files were found")
    print("\n".join(findings))
    return 1 if findings else 0


if __name__ == "__main__":
    sys.exit(main())
