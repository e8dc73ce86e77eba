#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""readme_test.py SOURCE BUILD [--long] [--only TEXT]: runs the commands of the documentation and checks what they promise.

Every command line of `hallway` and `hallway-robot` in the Markdown pages has an entry in readme_commands.toml: how it is run here (placeholders
filled, sizes reduced; whole with --long) and what must come out. A command without an entry fails, and so does an entry without a command.
Other commands (make, scripts, benchmarks) are checked to exist. Exit status: 0 all promises hold, 1 some do not.
"""
import argparse
import fnmatch
import json
import os
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import tomllib
import zlib
from pathlib import Path

HERE = Path(__file__).resolve().parent
PROGRAMS = ("hallway ", "hallway-robot ")
SECONDS = 1800  # after which a command counts as hung


def tracked_pages(source):
    listed = subprocess.run(["git", "-C", source, "ls-files", "*.md"], capture_output=True, text=True)
    names = listed.stdout.split() if listed.returncode == 0 else [
        str(path.relative_to(source)) for path in source.rglob("*.md") if "build" not in path.relative_to(source).parts]
    return sorted(name for name in names if name != "CHANGELOG.md" and (source / name).is_file())


def command_lines(text, tables):
    """(line number, command) of a page: lines of code blocks, continued ones joined, and with `tables` the commands in cells of tables."""
    fenced, pending, began = False, "", 0
    for number, line in enumerate(text.splitlines(), 1):
        if line.startswith("```"):
            fenced = not fenced
            continue
        if fenced or re.match(r" {4,}\S", line):
            began = began if pending else number
            pending += line.strip()
            if pending.endswith("\\"):
                pending = pending[:-1].rstrip() + " "
                continue
            command = re.split(r"\s{2,}#|\s#\s", pending)[0].strip().rstrip("&").strip()
            pending = ""
            yield began, command
        elif tables and line.startswith("|"):
            for cell in re.findall(r"`([^`]+)`", line):
                if cell.startswith(PROGRAMS) and len(cell.split()) > 2 and "…" not in cell:
                    yield number, cell


def picture_colours(path):
    """The number of different colours of an 8-bit RGB or RGBA picture."""
    data = path.read_bytes()
    if data[:8] != b"\x89PNG\r\n\x1a\n":
        raise ValueError("not a PNG file")
    width, height, depth, kind = struct.unpack(">IIBB", data[16:26])
    if depth != 8 or kind not in (2, 6):
        raise ValueError(f"depth {depth}, kind {kind}")
    at, packed = 8, b""
    while at < len(data):
        length, name = struct.unpack(">I4s", data[at:at + 8])
        packed += data[at + 8:at + 8 + length] if name == b"IDAT" else b""
        at += 12 + length
    raw, size = zlib.decompress(packed), {2: 3, 6: 4}[kind]
    stride, above, colours = width * size, bytearray(width * size), set()
    for row in range(height):
        start = row * (stride + 1)
        method, line = raw[start], bytearray(raw[start + 1:start + 1 + stride])
        for i in range(stride):
            left = line[i - size] if i >= size else 0
            corner = above[i - size] if i >= size else 0
            if method == 1:
                line[i] = (line[i] + left) & 255
            elif method == 2:
                line[i] = (line[i] + above[i]) & 255
            elif method == 3:
                line[i] = (line[i] + (left + above[i]) // 2) & 255
            elif method == 4:
                guess = left + above[i] - corner
                distances = (abs(guess - left), abs(guess - above[i]), abs(guess - corner))
                line[i] = (line[i] + (left, above[i], corner)[distances.index(min(distances))]) & 255
        if row % 4 == 0:
            colours.update(bytes(line[i:i + 3]) for i in range(0, stride, 4 * size))
        above = line
    return len(colours)


class Promises:
    """Runs entries in one scratch folder, each fixture once."""

    def __init__(self, source, build, table, whole):
        self.table, self.whole, self.done = table, whole, set()
        self.folder = Path(tempfile.mkdtemp(prefix="readme-test-"))
        (self.folder / "build").mkdir()
        (self.folder / "build" / "release").symlink_to(build)
        for name in ("maps", "robot", "sdk"):
            shutil.copytree(source / name, self.folder / name, ignore=shutil.ignore_patterns(".hallway", "*.journal"))
        self.environment = dict(os.environ, PATH=f"{build / 'bin'}:{os.environ['PATH']}", SOURCE=str(source))
        self.environment.pop("HALLWAY_PLUGIN_PATH", None)
        self.data = Path(os.environ.get("HALLWAY_DATA", source.parent / "shared" / "data")).resolve()
        self.environment["HALLWAY_DATA"] = str(self.data)

    def shell(self, command):
        return subprocess.run(["bash", "-c", command], cwd=self.folder, env=self.environment, capture_output=True, text=True,
                              stdin=subprocess.DEVNULL, timeout=SECONDS)

    def prepare(self, names):
        for name in names:
            if name in self.done:
                continue
            fixture = self.table["fixture"][name]
            self.prepare(fixture.get("needs", []))
            for command in fixture["run"]:
                ran = self.shell(command)
                if ran.returncode != 0:
                    raise RuntimeError(f"fixture {name}: `{command}` ended with {ran.returncode}: {ran.stderr.strip()[-400:]}")
            self.done.add(name)

    def broken(self, text, entry):
        """What the command promises and does not keep, as a list of causes."""
        self.prepare(entry.get("needs", []))
        command = text if self.whole and entry.get("long") else entry.get("run", text)
        ran = self.shell(command)
        wanted = entry.get("status", 0)
        if ran.returncode != wanted:
            return [f"`{command}` ended with {ran.returncode} instead of {wanted}: {ran.stderr.strip()[-400:]}"]
        causes = []
        for promise in entry["expect"]:
            try:
                cause = self.check(promise, ran)
            except (OSError, ValueError, KeyError, TypeError, IndexError) as error:
                cause = f"{type(error).__name__}: {error}"
            if cause:
                causes.append(f"`{command}`: {promise}: {cause}")
        return causes

    def check(self, promise, ran):
        kind, _, rest = promise.partition(" ")
        if kind in ("stdout", "stderr"):
            text = getattr(ran, kind)
            return None if re.search(rest, text, re.MULTILINE) else f"it was {text[-400:]!r}"
        if kind == "file":
            return None if (self.folder / rest).stat().st_size > 0 else "empty"
        if kind == "picture":
            colours = picture_colours(self.folder / rest)
            return None if colours >= 8 else f"only {colours} colours"
        if kind == "json":
            name, _, condition = rest.partition(": ")
            document = json.loads(ran.stdout if name == "-" else (self.folder / name).read_text())
            return None if eval(condition, {"d": document}) else f"false of {json.dumps(document)[:400]}"  # noqa: S307, from our own table
        raise ValueError("no such kind of promise")

    def close(self):
        shutil.rmtree(self.folder, ignore_errors=True)


def exists(source, build, command):
    """Whether what a command that is not run here begins with is there; None if it is nothing that this test knows."""
    words = command.split()
    if words[0] == "make":
        return re.search(rf"^{re.escape(words[1])}:", (source / "Makefile").read_text(), re.MULTILINE) is not None
    if words[0] == "python3":
        return (source / words[1]).is_file()
    if words[0].startswith("scripts/"):
        return (source / words[0]).is_file()
    bench = re.match(r"build/\w+/bin/(?:bench_)?(\w+)", words[0])
    if bench:
        listed = subprocess.run(["git", "-C", source, "grep", "-q", "-w", bench.group(1), "--", "bench"])
        return listed.returncode == 0
    if words[0] == "ctest" and "-R" in words:
        listed = subprocess.run(["ctest", "--test-dir", build, "-N", "-R", words[words.index("-R") + 1]], capture_output=True, text=True)
        return "Total Tests: 0" not in listed.stdout
    return None


def shown_plugin_problems(source):
    """The plugin that the README shows is an example that is built."""
    block = re.search(r"```cpp\n(.*?)```", (source / "README.md").read_text(), re.DOTALL)
    code = (source / "sdk/examples/still.cpp").read_text()
    same = block is not None and code == "// SPDX-License-Identifier: MIT\n" + block.group(1)
    return [] if same else ["README.md: the plugin that is shown is not sdk/examples/still.cpp"]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("source", type=lambda text: Path(text).resolve())
    parser.add_argument("build", type=lambda text: Path(text).resolve())
    parser.add_argument("--long", action="store_true", help="run whole what is marked so")
    parser.add_argument("--only", default="", help="run only commands that contain this text")
    arguments = parser.parse_args()
    table = tomllib.loads((HERE / "readme_commands.toml").read_text())
    entries, problems, used, count = table["command"], shown_plugin_problems(arguments.source), set(), 0
    promises = Promises(arguments.source, arguments.build, table, arguments.long)
    try:
        for page in tracked_pages(arguments.source):
            for number, command in command_lines((arguments.source / page).read_text(), page == "README.md"):
                where = f"{page}:{number}"
                if not command.startswith(PROGRAMS):
                    if command and exists(arguments.source, arguments.build, command) is False:
                        problems.append(f"{where}: `{command}`: there is no such thing")
                    continue
                matching = [i for i, entry in enumerate(entries) if fnmatch.fnmatchcase(command, entry["text"])
                            and fnmatch.fnmatch(page, entry.get("page", "*"))]
                if not matching:
                    problems.append(f"{where}: `{command}` has no entry in readme_commands.toml")
                    continue
                first, entry = matching[0] not in used, entries[matching[0]]
                used.add(matching[0])
                if not first or "covered" in entry or arguments.only not in command or (arguments.long and not entry.get("long")):
                    continue
                if "data" in entry and not (promises.data / entry["data"]).is_dir():
                    print("skipped", where, command, "no data:", entry["data"], flush=True)
                    continue
                count += 1
                try:
                    causes = promises.broken(command, entry)
                except (RuntimeError, subprocess.TimeoutExpired) as error:
                    causes = [str(error)]
                problems += [f"{where}: {cause}" for cause in causes]
                print("failed" if causes else "ok", where, command, flush=True)
        if not arguments.only:
            problems += [f"readme_commands.toml: no page has `{entry['text']}`" for i, entry in enumerate(entries) if i not in used]
    finally:
        promises.close()
    print("\n".join(problems))
    print(f"{count} commands ran, {len(problems)} problems")
    return 1 if problems or count == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
