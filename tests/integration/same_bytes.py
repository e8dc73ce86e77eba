#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""same_bytes.py A B: whether two folders of one case of same_bytes.sh have the same files but for facts of the clock."""
import csv
import json
import pathlib
import re
import sys

CLOCK_FILES = re.compile(r"timing\.csv|times.*\.csv|.*\.part")
CLOCK_KEYS = re.compile(r"host|iteration(_cpu)?_ms|(call_|wall_|cpu_)?(seconds|ms|s)|memory_peak_bytes|latency.*|times")
# In what is printed for people: numbers with a unit of time or memory, and bars of progress.
CLOCK_WORDS = re.compile(rb'\d[\d.]*(?= ?(?:s|ms|us|\xc2\xb5s|MiB|KiB|MB|kB)\b)|(?<="seconds": )[\d.e-]+|(?<="memory_peak_bytes": )\d+')

# A plugin's file is another one in each build; so are logs, which name it.
PLUGIN_HASH = re.compile(rb'("id":"\w+","version":"[\w.]+","hash":|"file":"[^"]*\.mcap","hash":)"[0-9a-f]{32}"')


def without_clock(value):
    if isinstance(value, dict):
        of_build = {"id", "version", "hash"} <= value.keys() or str(value.get("file")).endswith(".mcap") or "cell" in str(value.get("schema"))
        return {k: without_clock(v) for k, v in value.items() if not CLOCK_KEYS.fullmatch(k) and not (of_build and k == "hash")}
    return [without_clock(v) for v in value] if isinstance(value, list) else value


def documents(text):
    """The JSON documents of a text one after another, or None where it is something else."""
    decoder, found, at = json.JSONDecoder(), [], 0
    while at < len(text):
        if text[at].isspace():
            at += 1
            continue
        try:
            value, at = decoder.raw_decode(text, at)
        except ValueError:
            return None
        if not isinstance(value, dict):
            return None
        found.append(list(without_clock(value).items()))
    return found or None


def table_without_clock(text):
    """A table with a header, without the columns of the clock."""
    rows = list(csv.reader(text.splitlines()))
    keep = [i for i, name in enumerate(rows[0]) if not any(CLOCK_KEYS.fullmatch(part) for part in name.split("."))]
    return "\n".join(",".join(row[i] for i in keep if i < len(row)) for row in rows)


def log_without_build(data):
    """An MCAP log without the plugin's hash in its metadata, and without the check sums over it (end of data, footer)."""
    records, at = [], 8
    while at + 9 <= len(data) - 8:
        kind, end = data[at], at + 9 + int.from_bytes(data[at + 1 : at + 9], "little")
        record = data[at:end]
        if kind == 0x0C:
            record = PLUGIN_HASH.sub(rb"\1#", record)
        elif kind in (0x0F, 0x02):
            record = record[:-4]
        records.append(record)
        at = end
    return b"".join(records) + data[at:]


def content(path):
    data = path.read_bytes()
    if path.suffix == ".mcap":
        return log_without_build(data)
    if path.name == "results.csv":
        return table_without_clock(data.decode()).encode()
    if path.name in (".out", ".err") or path.suffix in (".json", ".txt"):
        try:
            found = documents(data.decode())
        except UnicodeDecodeError:
            found = None
        if found:
            return json.dumps(found, indent=1).encode()
        return CLOCK_WORDS.sub(b"#", data)
    return data


def clock_charts(folder):
    """The charts of times of the studies in a folder."""
    for study in folder.rglob("study.json"):
        for chart in json.loads(study.read_text())["charts"]:
            if chart["clock"]:
                yield from (study.parent / (chart["file"] + ending) for ending in (".svg", ".png"))


def files(folder):
    charts = set(clock_charts(folder))
    return {
        str(p.relative_to(folder)): p
        for p in folder.rglob("*")
        if p.is_file() and ".hallway" not in p.parts and not CLOCK_FILES.fullmatch(p.name) and p not in charts
    }


def first_difference(a, b):
    lines_a, lines_b = a.split(b"\n"), b.split(b"\n")
    for number, (x, y) in enumerate(zip(lines_a, lines_b), 1):
        if x != y:
            return f"line {number}\n    < {x[:160]!r}\n    > {y[:160]!r}"
    return f"{len(lines_a)} and {len(lines_b)} lines"


def main():
    a, b = (pathlib.Path(folder) for folder in sys.argv[1:])
    in_a, in_b, same = files(a), files(b), True
    for name in sorted(in_a.keys() | in_b.keys()):
        if name not in in_a or name not in in_b:
            print(f"{a.name}/{name}: only in {'AFTER' if name in in_b else 'BEFORE'}")
            same = False
            continue
        x, y = content(in_a[name]), content(in_b[name])
        if x != y:
            print(f"{a.name}/{name} differs: {first_difference(x, y)}")
            same = False
    if not any(in_a.values()):
        sys.exit(f"{a.name}: nothing to compare")
    status = (a / ".status").read_text().strip()
    if same:
        print(f"{a.name}: the same, {len(in_a)} files, status {status}")
    sys.exit(0 if same else 1)


main()
