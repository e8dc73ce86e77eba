#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""watch_test.py SOURCE BUILD: `hallway watch` in a terminal of its own, as a person uses it.

A pseudo-terminal takes keys and gives what is drawn; Screen below is as much of an xterm as ncurses asks for.
"""
import codecs
import fcntl
import json
import os
import pathlib
import pty
import re
import select
import signal
import struct
import subprocess
import sys
import tempfile
import termios
import time
import unittest

SOURCE, BUILD = (pathlib.Path(argument).resolve() for argument in sys.argv[1:3])
HALLWAY = BUILD / "bin" / "hallway"
LIMIT_S = 240  # for events that come at once on an idle machine
ENVIRONMENT = {**os.environ, "TERM": "xterm", "LC_ALL": "C.UTF-8"}
ARROWS = "→↗↑↖←↙↓↘"
PLACES = "○◎△□◇"


class Screen:
    """The cells of an xterm. A sequence that it does not know is an error, so that nothing is guessed."""

    SEQUENCE = re.compile(r"\x1b(?:\[([?>!]?)([0-9;]*)([@-~])|[()]([0-9A-B])|([=>78MDEc]))")

    def __init__(self, width, height):
        self.decoder = codecs.getincrementaldecoder("utf-8")("replace")
        self.rest, self.row, self.column, self.alternate, self.last = "", 0, 0, False, " "
        self.cells = []
        self.resize(width, height)

    def resize(self, width, height):
        self.width, self.height = width, height
        self.cells = [(row + [" "] * width)[:width] for row in self.cells[:height]]
        self.cells += [[" "] * width for _ in range(height - len(self.cells))]
        self.top, self.bottom = 0, height - 1
        self.move(self.row, self.column)

    def text(self):
        return "\n".join("".join(row).rstrip() for row in self.cells)

    def feed(self, data):
        text, self.rest = self.rest + self.decoder.decode(data), ""
        at = 0
        while at < len(text):
            if text[at] != "\x1b":
                self.put(text[at])
                at += 1
                continue
            match = self.SEQUENCE.match(text, at)
            if match is None:
                if len(text) - at > 40:
                    raise AssertionError(f"unknown sequence {text[at:at + 20]!r}")
                self.rest = text[at:]
                return
            at = match.end()
            if match[3]:
                self.control(match[1], match[2], match[3])
            elif match[5] == "M":
                self.scroll(-1) if self.row == self.top else self.move(self.row - 1, self.column)

    def put(self, one):
        if one == "\n":
            self.scroll(1) if self.row == self.bottom else self.move(self.row + 1, self.column)
        elif one == "\r":
            self.column = 0
        elif one == "\b":
            self.column = max(self.column - 1, 0)
        elif one == "\t":
            self.column = min((self.column // 8 + 1) * 8, self.width - 1)
        elif one not in "\x07\x0e\x0f":
            if self.column == self.width:
                self.column = 0
                self.put("\n")
            self.cells[self.row][self.column] = self.last = one
            self.column += 1

    def move(self, row, column):
        self.row, self.column = min(max(row, 0), self.height - 1), min(max(column, 0), self.width - 1)

    def scroll(self, count, top=None):
        top = self.top if top is None else top
        for _ in range(abs(count)):
            if count > 0:
                del self.cells[top]
                self.cells.insert(self.bottom, [" "] * self.width)
            else:
                del self.cells[self.bottom]
                self.cells.insert(top, [" "] * self.width)

    def control(self, private, numbers, final):
        values = [int(n) if n else 0 for n in numbers.split(";")]
        n = max(values[0], 1)
        row = self.cells[self.row]
        if private:
            if private == "?" and values[0] == 1049:
                self.alternate = final == "h"
            return
        if final in "Hf":
            self.move(n - 1, max(values[1] if len(values) > 1 else 1, 1) - 1)
        elif final in "ABCDGd":
            self.move(*{"A": (self.row - n, self.column), "B": (self.row + n, self.column), "C": (self.row, self.column + n),
                        "D": (self.row, self.column - n), "G": (self.row, n - 1), "d": (n - 1, self.column)}[final])
        elif final == "J":
            first = 0 if values[0] == 2 else self.row + 1
            for k in range(first, self.height):
                self.cells[k] = [" "] * self.width
            if values[0] == 0:
                row[self.column:] = [" "] * (self.width - self.column)
        elif final == "K":
            a, b = {0: (self.column, self.width), 1: (0, self.column + 1), 2: (0, self.width)}[values[0]]
            row[a:b] = [" "] * (b - a)
        elif final == "X":
            end = min(self.column + n, self.width)
            row[self.column:end] = [" "] * (end - self.column)
        elif final == "P":
            del row[self.column:self.column + n]
            row.extend([" "] * (self.width - len(row)))
        elif final == "@":
            row[self.column:self.column] = [" "] * n
            del row[self.width:]
        elif final in "LM":
            self.scroll(n if final == "M" else -n, self.row)
        elif final in "ST":
            self.scroll(n if final == "S" else -n)
        elif final == "r":
            self.top, self.bottom = n - 1, (values[1] if len(values) > 1 else self.height) - 1
            self.move(0, 0)
        elif final == "b":
            for _ in range(n):
                self.put(self.last)
        elif final not in "mhltcn":
            raise AssertionError(f"unknown control {final!r}")


class Watched:
    """`hallway watch` in a terminal."""

    def __init__(self, arguments, width=80, height=24, environment=ENVIRONMENT):
        self.screen, self.raw = Screen(width, height), b""
        self.master, self.slave = pty.openpty()
        self.size(width, height)
        self.modes = termios.tcgetattr(self.slave)
        self.process = subprocess.Popen([HALLWAY, "watch", *map(str, arguments)], stdin=self.slave, stdout=self.slave, stderr=subprocess.PIPE,
                                        env=environment, start_new_session=True,
                                        preexec_fn=lambda: fcntl.ioctl(0, termios.TIOCSCTTY, 0))

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.kill()
        self.process.wait()
        self.process.stderr.close()
        os.close(self.master)
        os.close(self.slave)

    def size(self, width, height):
        fcntl.ioctl(self.master, termios.TIOCSWINSZ, struct.pack("HHHH", height, width, 0, 0))

    def resize(self, width, height):
        self.screen.resize(width, height)
        self.size(width, height)

    def type(self, keys):
        os.write(self.master, keys.encode())

    def read(self, seconds):
        ready, _, _ = select.select([self.master], [], [], seconds)
        if ready:
            data = os.read(self.master, 65536)
            self.raw += data
            self.screen.feed(data)
        return bool(ready)

    def wait_for(self, condition, what):
        """Until the screen, as text, fulfils the condition. @return the text"""
        end = time.monotonic() + LIMIT_S
        while True:
            text = self.screen.text()
            if condition(text):
                return text
            if time.monotonic() > end or self.process.poll() is not None:
                raise AssertionError(f"never: {what}; status {self.process.poll()}\n{text}")
            self.read(0.2)

    def shows(self, text):
        return self.wait_for(lambda screen: text in screen, text)

    def frame(self):
        found = re.search(r"frame (\d+) of", self.screen.text())
        return int(found[1]) if found else -1

    def end(self):
        """Until the program has ended. @return its status"""
        limit = time.monotonic() + LIMIT_S
        while self.process.poll() is None:
            if time.monotonic() > limit:
                raise AssertionError("does not end\n" + self.screen.text())
            self.read(0.2)
        while self.read(0):
            pass
        return self.process.returncode

    def is_whole(self):
        """Whether the terminal is as it was, and shows no other page."""
        return termios.tcgetattr(self.slave) == self.modes and not self.screen.alternate and b"\x1b[?1049h" in self.raw


def comparable(file):
    """The content of a file of a run, without the facts of clock and machine (tests/integration/determinism_test.cpp)."""
    if file.name in ("metrics.json", "run.json"):
        document = json.loads(file.read_bytes())
        for fact in ("iteration_ms", "iteration_cpu_ms", "host"):
            document.pop(fact, None)
        return document
    return None if file.name == "timing.csv" else file.read_bytes()


def drawn(text):
    """What is on the canvas of a page of 80 x 24 and more: left of the panel."""
    return "\n".join(row.split("│")[0] for row in text.splitlines()[1:-6])


def places(text):
    """The characters of places of a topological map on the canvas."""
    return [one for one in drawn(text) if one in PLACES]


def has_plan(text):
    return sum("⠁" <= one <= "⣿" for one in text) > 60 and any(arrow in text for arrow in ARROWS)


class WatchCase(unittest.TestCase):
    """Tests of a scenario, of which there is a run that nobody watched."""

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.run_folder = pathlib.Path(cls.folder.name) / "run"
        subprocess.run([HALLWAY, "run", cls.SCENARIO, *cls.OPTIONS, "--quiet", "--out", cls.run_folder], check=True)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def assert_same_run(self, other):
        files = {str(f.relative_to(folder)) for folder in (self.run_folder, other) for f in folder.rglob("*") if f.is_file()}
        self.assertGreater(len(files), 10)
        for name in sorted(files):
            self.assertEqual(comparable(self.run_folder / name), comparable(other / name), name)


class Watch(WatchCase):
    SCENARIO = SOURCE / "maps" / "office_drive.toml"
    OPTIONS = ("--steps", "200", "--foxglove")

    def test_plays_a_run_in_a_terminal(self):
        with Watched([self.run_folder]) as watched:
            watched.wait_for(has_plan, "plan and robot")
            watched.type(" ")
            watched.shows("PAUSED")
            before = watched.frame()
            watched.type(".")
            watched.wait_for(lambda _: watched.frame() == before + 1, "one frame ahead")
            watched.type(",,")
            watched.wait_for(lambda _: watched.frame() == before - 1 if before > 0 else watched.frame() == 0, "one frame back")
            width = re.search(r"([\d.]+) m wide", watched.screen.text())[1]
            watched.type("z")
            watched.wait_for(lambda text: (w := re.search(r"([\d.]+) m wide", text)) and float(w[1]) < float(width), "less is shown")
            watched.type("f")
            watched.shows("following")
            watched.type("?")
            watched.shows("one frame back")
            watched.type("?a")
            watched.resize(200, 60)
            text = watched.wait_for(lambda text: has_plan(text) and len(text.splitlines()[0]) > 20 and "? keys" in text.splitlines()[-1], "a larger page")
            self.assertGreater(sum("⠁" <= one <= "⣿" for one in text), 300)
            watched.resize(40, 12)
            watched.wait_for(lambda text: "? keys" in text, "a small page")
            watched.resize(20, 5)
            watched.shows("is too small")
            watched.resize(80, 24)
            watched.type("\x1b[4~>")  # END
            watched.shows("frame 199 of 199")
            watched.shows("END")
            watched.type("<")
            watched.shows("frame 0 of 199")
            watched.type("q")
            self.assertEqual(watched.end(), 0)
            self.assertTrue(watched.is_whole())

    def test_run_that_is_watched_is_the_same(self):
        out = pathlib.Path(self.folder.name) / "watched"
        with Watched([self.SCENARIO, "--steps", "200", "--foxglove", "--out", out, "--speed", "64"]) as watched:
            watched.wait_for(has_plan, "plan and robot")
            watched.type(" ")
            watched.shows("PAUSED")
            watched.type("..")
            watched.type(" +")
            watched.shows("END")
            watched.type("q")
            self.assertEqual(watched.end(), 0)
            self.assertTrue(watched.is_whole())
            self.assertIn(b"written to", watched.raw.rsplit(b"\x1b[?1049l", 1)[1])
        self.assert_same_run(out)

    def test_run_goes_on_without_its_view(self):
        out = pathlib.Path(self.folder.name) / "closed"
        with Watched([self.SCENARIO, "--steps", "200", "--foxglove", "--out", out, "--speed", "0.0625"]) as watched:
            watched.wait_for(has_plan, "plan and robot")
            watched.type("q")
            self.assertEqual(watched.end(), 0)
            self.assertTrue(watched.is_whole())
        self.assert_same_run(out)

    def test_ctrl_c_leaves_the_terminal_whole(self):
        for arguments in ([self.run_folder], [self.SCENARIO, "--out", pathlib.Path(self.folder.name) / "interrupted"]):
            with Watched(arguments) as watched:
                watched.wait_for(has_plan, "plan and robot")
                self.assertNotEqual(termios.tcgetattr(watched.slave), watched.modes)
                watched.type("\x03")
                self.assertEqual(watched.end(), 130)
                self.assertTrue(watched.is_whole())
        folder = pathlib.Path(self.folder.name) / "interrupted"
        self.assertTrue(json.loads((folder / "run.json").read_text())["stopped_early"])

    def test_signals_leave_the_terminal_whole(self):
        for number in (signal.SIGTERM, signal.SIGABRT, signal.SIGHUP):
            with Watched([self.run_folder]) as watched:
                watched.wait_for(has_plan, "plan and robot")
                watched.process.send_signal(number)
                self.assertEqual(watched.end(), 143 if number == signal.SIGTERM else -number)
                self.assertTrue(watched.is_whole())

    def test_dots_and_locales(self):
        with Watched([self.run_folder], environment={**ENVIRONMENT, "LC_ALL": "C"}) as watched:
            text = watched.wait_for(lambda text: text.count("#") > 30, "a plan in ASCII")
            self.assertTrue(text.isascii())
            watched.type("q")
            self.assertEqual(watched.end(), 0)
        with Watched([self.run_folder, "--dots", "blocks"], environment={**ENVIRONMENT, "LC_ALL": "C"}) as watched:
            watched.wait_for(lambda text: sum("▀" <= one <= "▟" for one in text) > 30, "a plan in blocks")
            watched.type("q")
            self.assertEqual(watched.end(), 0)

    def test_lines_without_a_terminal(self):
        out = pathlib.Path(self.folder.name) / "lines"
        for arguments in ([self.run_folder], [self.SCENARIO, "--steps", "200", "--foxglove", "--out", out]):
            ended = subprocess.run([HALLWAY, "watch", *arguments], stdin=subprocess.DEVNULL, capture_output=True, text=True, env=ENVIRONMENT)
            self.assertEqual(ended.returncode, 0, ended.stderr)
            self.assertNotIn("\x1b", ended.stdout)
            states = re.findall(r"^(\d+)\.00 s  frame (\d+)  at \(-?[\d.]+, -?[\d.]+\)", ended.stdout, re.MULTILINE)
            self.assertEqual([(str(s), str(10 * s)) for s in range(20)], states)
        self.assertIn("written to", ended.stdout)
        self.assert_same_run(out)

    def test_lines_in_a_dumb_terminal(self):
        for environment in ({**ENVIRONMENT, "TERM": "dumb"}, {**ENVIRONMENT, "TERM": "no-such-terminal"}):
            with Watched([self.run_folder], environment=environment) as watched:
                self.assertEqual(watched.end(), 0)
                self.assertIn(b"10.00 s  frame 100  at", watched.raw)
                self.assertNotIn(b"\x1b", watched.raw)
        with Watched([self.run_folder, "--lines"]) as watched:
            self.assertEqual(watched.end(), 0)
            self.assertNotIn(b"\x1b", watched.raw)

    def test_lines_leave_a_json_document_whole(self):
        out = pathlib.Path(self.folder.name) / "json"
        ended = subprocess.run([HALLWAY, "watch", self.SCENARIO, "--steps", "20", "--json", "--out", out], stdin=subprocess.DEVNULL,
                               capture_output=True, text=True, env=ENVIRONMENT)
        self.assertEqual(json.loads(ended.stdout)["schema"], "hallway.result/1")
        self.assertIn("1.00 s  frame 10", ended.stderr)

    def test_errors(self):
        folder = pathlib.Path(self.folder.name)
        (folder / "empty").mkdir()
        without_log = folder / "without_log"
        without_log.mkdir()
        (without_log / "run.json").write_bytes((self.run_folder / "run.json").read_bytes())
        (folder / "bad.toml").write_text("schema = 'hallway.scenario/1'\nmap = 3\n")
        (folder / "other.toml").write_text("[package]\nname = 'other'\n")
        (folder / "broken.toml").write_text("map = = 3\n")
        (folder / "scenario.txt").write_text("map = 'office.map'\nsteps = 'three'\n")
        with open(folder / "large", "wb") as large:
            large.truncate(1 << 32)
        for arguments, status, text in (
                ([folder / "empty"], 3, "is no folder of a run"),
                ([without_log], 3, "has no log (run.mcap)"),
                ([folder / "bad.toml"], 3, "bad.toml:2"),
                ([folder / "missing.toml"], 3, "missing.toml: does not exist; the folder of a run, a scenario (.toml) or a map (.map) is wanted"),
                ([folder / "none"], 3, "none: does not exist; the folder of a run, a scenario (.toml) or a map (.map) is wanted"),
                ([SOURCE / "README.md"], 3, "README.md: is neither the folder of a run nor a scenario (.toml) or a map (.map)"),
                ([self.run_folder / "metrics.json"], 3, "metrics.json: is neither the folder of a run nor a scenario"),
                ([folder / "other.toml"], 3, "other.toml: is neither the folder of a run nor a scenario"),
                ([folder / "large"], 3, "large: is neither the folder of a run nor a scenario"),
                (["/dev/null"], 3, "/dev/null: is neither the folder of a run nor a scenario"),
                ([folder / "broken.toml"], 3, "broken.toml:1"),
                ([folder / "scenario.txt"], 3, "scenario.txt:2"),
                ([self.run_folder / "run.mcap"], 3, "is a log; the folder of its run"),
                ([self.run_folder, "--seed", "3"], 2, "other options are of a scenario"),
                ([self.run_folder, "--speed", "0"], 2, "--speed"),
                ([self.run_folder, "--dots", "sixel"], 2, "braille")):
            ended = subprocess.run([HALLWAY, "watch", *arguments], stdin=subprocess.DEVNULL, capture_output=True, text=True, env=ENVIRONMENT)
            self.assertEqual(ended.returncode, status, (arguments, ended.stderr))
            self.assertIn(text, ended.stderr)

    def test_damaged_log_is_shown_up_to_the_damage(self):
        folder = pathlib.Path(self.folder.name) / "damaged"
        subprocess.run(["cp", "-r", self.run_folder, folder], check=True)
        log = folder / "run.mcap"
        log.write_bytes(log.read_bytes()[:log.stat().st_size // 2])
        ended = subprocess.run([HALLWAY, "watch", folder], stdin=subprocess.DEVNULL, capture_output=True, text=True, env=ENVIRONMENT)
        self.assertEqual(ended.returncode, 0)
        self.assertIn("0.00 s  frame 0", ended.stdout)
        self.assertIn("damaged at byte", ended.stderr)


class WatchChart(WatchCase):
    """A robot that charts: its topological map, and what it draws."""

    SCENARIO = SOURCE / "maps" / "cubicles_faults.toml"
    OPTIONS = ("--steps", "500")
    LAST = "frame 499 of 499"

    def to_the_end(self, watched):
        charted = len(json.loads((pathlib.Path(self.run_folder) / "topology.json").read_bytes())["nodes"])
        watched.wait_for(has_plan, "plan and robot")
        watched.type(" >")
        return watched.wait_for(lambda text: self.LAST in text and "END" in text and self.nodes(text) == charted and len(set(places(text))) >= 2,
                                f"the last frame, with {charted} places of several kinds")

    def nodes(self, text):
        found = re.search(r"(\d+) nodes, loop open", text)
        return int(found[1]) if found else -1

    def test_shows_the_chart_of_a_run(self):
        for width, height in ((80, 24), (200, 60)):
            with Watched([self.run_folder], width, height) as watched:
                text = self.to_the_end(watched)
                nodes = self.nodes(text)
                self.assertLessEqual(len(places(text)), nodes, text)
                watched.type("t")
                text = watched.wait_for(lambda text: not places(text), "no places")
                self.assertTrue(has_plan(text), text)
                self.assertEqual(self.nodes(text), nodes)
                watched.type("t")
                watched.wait_for(places, "places again")
                watched.type("<")
                watched.wait_for(lambda text: "frame 0 of 499" in text and not places(text), "nothing, for nothing is charted yet")
                watched.type("q")
                self.assertEqual(watched.end(), 0)
                self.assertTrue(watched.is_whole())

    def test_shows_what_the_plugin_draws(self):
        with Watched([self.run_folder]) as watched:
            text = self.to_the_end(watched)
            state = re.search(r"nodes, loop open *\n[^│]*│ +(\w[\w ]*)", text)[1].rstrip()
            self.assertIn(state, ("start", "seek", "follow", "turn", "settle", "advance", "sweep", "pass", "reverse", "round", "back off", "veer"))
            watched.wait_for(lambda text: state in drawn(text), "the state beside the robot")
            watched.type("w")
            watched.wait_for(lambda text: state not in drawn(text), "no drawing")
            watched.type("?")
            watched.shows("what a plugin draws (hidden)")
            watched.type("q")
            self.assertEqual(watched.end(), 0)

    def test_chart_in_ascii(self):
        with Watched([self.run_folder, "--dots", "ascii"]) as watched:
            watched.shows("frame")
            watched.type(" >")
            watched.wait_for(lambda text: self.LAST in text and "D" in "".join(row.split("|")[0] for row in text.splitlines()[1:-6]), "a step of the wall")
            watched.type("q")
            self.assertEqual(watched.end(), 0)

    def test_run_that_is_watched_is_the_same(self):
        out = pathlib.Path(self.folder.name) / "watched"
        with Watched([self.SCENARIO, *self.OPTIONS, "--out", out, "--speed", "256"]) as watched:
            watched.wait_for(lambda text: has_plan(text) and places(text), "plan, robot and chart")
            watched.type("tw")
            watched.type("tw f")
            watched.shows("PAUSED")
            watched.type(",,. ")
            text = watched.shows("END")
            self.assertIn("nodes, loop open", text)
            watched.type("q")
            self.assertEqual(watched.end(), 0)
            self.assertTrue(watched.is_whole())
        self.assert_same_run(out)

    def test_ctrl_c_leaves_the_terminal_whole(self):
        for arguments in ([self.run_folder], [self.SCENARIO, "--out", pathlib.Path(self.folder.name) / "interrupted", "--speed", "64"]):
            with Watched(arguments) as watched:
                watched.wait_for(lambda text: has_plan(text) and places(text), "plan, robot and chart")
                watched.type("\x03")
                self.assertEqual(watched.end(), 130)
                self.assertTrue(watched.is_whole())

    def test_lines(self):
        ended = subprocess.run([HALLWAY, "watch", self.run_folder], stdin=subprocess.DEVNULL, capture_output=True, text=True, env=ENVIRONMENT)
        self.assertEqual(ended.returncode, 0, ended.stderr)
        counts = [int(n) for n in re.findall(r"  (\d+) nodes?, loop open  \w", ended.stdout)]
        self.assertGreaterEqual(counts[-1], 4)
        self.assertEqual(counts, sorted(counts))


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
