#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""layout_test.py SOURCE BUILD: the folders of production code keep to the link rules, which CMake has (BUILD/links.tsv).

- A file includes what its own folder's targets link, and nothing else of Hallway.
- No target reaches what a rule `hallway_never_links` forbids it.
- Each heavy library is included by one file.
- What carries samples names no kind of them: few files do, each for a reason.
- Every engine library has a short README; every source names its licence.
"""
import collections
import pathlib
import re
import sys
import unittest

SOURCE, BUILD = (pathlib.Path(argument).resolve() for argument in sys.argv[1:3])
PRODUCTION = ("sdk", "geometry", "engine", "editor", "loaders", "app", "cli", "robot", "plugins")
ROOTS = ("sdk/include", "engine", "plugins", "")  # include paths of the build, in their order
INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]', re.MULTILINE)
# What one file alone includes, by a pattern of its headers.
HEAVY = {
    "CLI11": r"CLI/", "Embree": r"embree", "EGL": r"EGL/", "OpenGL": r"GL/", "toml++": r"toml\+\+/", "tinygltf": r"tiny_gltf\.h$",
    "assimp": r"assimp/", "GMP": r"gmp\.h$", "muParser": r"muParser\.h$", "libedit": r"editline/", "ncurses": r"(ncurses|curses|term)\.h$", "zstd": r"zstd\.h$",
    "Protobuf": r"google/protobuf/|.*\.pb\.h$", "ROS bags": r"rosbag/",
}
# Who means a kind of sample, and why: rooms, and files of others.
MEANS_A_KIND = {
    "engine/sense/": "sensors make samples of their kind", "engine/eval/": "scores", "engine/conformance/": "tests plugins with samples",
    "robot/drivers/": "adapters",
    "engine/host/samples/sample_kind.cpp": "names of kinds that are reserved", "engine/host/samples/point_kind.cpp": "the row of points",
    "engine/host/samples/plane_kind.cpp": "the row of planes", "engine/host/samples/bump_kind.cpp": "the row of contact zones",
    "engine/host/samples/encoder_kind.cpp": "the row of wheel encoders", "engine/host/output/output_kind.cpp": "which sample an output becomes",
    "engine/host/samples/range_scan_kind.cpp": "the row of rays", "engine/host/samples/odometry_kind.cpp": "the row of odometry",
    "engine/host/samples/gnss_kind.cpp": "the row of positions", "engine/host/samples/imu_kind.cpp": "the row of IMUs", "engine/host/samples/magnetic_kind.cpp": "the row of headings",
    "engine/host/robot_parts.cpp": "checks the intrinsics of kinds", "engine/link/description_parts.cpp": "the intrinsics of kinds on the wire",
    "engine/run/scoring/iteration_maker.cpp": "whose associations are scored", "engine/run/scoring/truth_of.hpp": "the noise of landmarks and planes", "engine/run/scoring/plane_truth.cpp": "planes in points",
    "engine/run/sources/log_source.cpp": "reads tables of points and of planes", "engine/foxglove/view.cpp": "has a schema for each kind that it shows",
    "engine/watch/moment_maker.cpp": "shows rays, points, planes and contact zones", "engine/run/pictures/history.cpp": "draws points and planes", "engine/run/pictures/scans.cpp": "draws rays",
    "engine/run/feed/observation_tables.cpp": "writes tables of points and of planes", "engine/run/feed/found_table.hpp": "writes a table of planes",
    "engine/import/imu_rigs.cpp": "what a rig has", "engine/import/kitti_rig.cpp": "likewise", "engine/import/scan_cloud.cpp": "makes clouds of rays and of points",
    "cli/log_clouds.cpp": "which sensors have clouds", "cli/log_layouts.cpp": "which have an IMU's samples", "cli/log_tables.cpp": "a table for each kind",
}
KIND = re.compile(r"\bHW_SAMPLE_(?!TRACKED\b)[A-Z]")


def sources(folder):
    return sorted(p for p in (SOURCE / folder).rglob("*") if p.suffix in (".h", ".hpp", ".c", ".cpp"))


class Links:
    """The link table: which folder each target is in, and what it reaches."""

    def __init__(self):
        self.folder, self.public, self.direct, self.never = {}, {}, {}, []
        for line in (BUILD / "links.tsv").read_text().splitlines():
            target, folder, public, private = line.split("\t")
            if target == "never":
                self.never.append((folder, public.split(",")))
                continue
            self.folder[target] = folder
            self.public[target] = set(filter(None, public.split(",")))
            self.direct[target] = self.public[target] | set(filter(None, private.split(",")))

    def reached(self, target, links):
        """The targets that `target` links directly, and all that these give on by `links`."""
        found, open_ = set(), set(self.direct.get(target, ()))
        while open_:
            one = open_.pop()
            if one not in found:
                found.add(one)
                open_ |= links.get(one, set())
        return found

    def may_include(self):
        """By folder: the folders whose headers its files may include."""
        allowed = collections.defaultdict(set)
        for target, folder in self.folder.items():
            allowed[folder].add(folder)
            allowed[folder] |= {self.folder[t] for t in self.reached(target, self.public) if t in self.folder}
        return allowed

    def owner(self, path):
        """The folder of the table that a file of the tree is in."""
        while path and path not in self.folder.values():
            path = path.rpartition("/")[0]
        return path


class Layout(unittest.TestCase):
    links = Links()

    def test_a_folder_includes_what_it_links(self):
        allowed, wrong, seen = self.links.may_include(), [], collections.Counter()
        for folder in PRODUCTION:
            for file in sources(folder):
                own = self.links.owner(str(file.relative_to(SOURCE).parent))
                for name in INCLUDE.findall(file.read_text()):
                    found = next((f"{root}/{name}".lstrip("/") for root in (*ROOTS, str(file.parent.relative_to(SOURCE)))
                                  if (SOURCE / root / name).is_file() and "/" in name), None)
                    if found is None:
                        continue
                    other = self.links.owner(found)
                    seen[own] += 1
                    if other not in allowed[own]:
                        wrong.append(f"{file.relative_to(SOURCE)} includes {name}, of {other or 'no target'}, which {own} does not link")
        self.assertFalse(wrong, "\n".join(wrong))
        # Lines are found in every folder that has sources, but for those that include only libraries and files beside them.
        for folder in {self.links.owner(str(f.relative_to(SOURCE).parent)) for top in PRODUCTION for f in sources(top)}:
            if not folder.startswith(("sdk", "engine/base", "app", "plugins/options")):
                self.assertGreater(seen[folder], 0, f"no include line of {folder or 'no target'} was found")

    def test_nothing_reaches_what_it_never_links(self):
        self.assertGreaterEqual(len(self.links.never), 5)
        for folder, others in self.links.never:
            targets = [t for t, f in self.links.folder.items() if f == folder or f.startswith(folder + "/")]
            self.assertTrue(targets, f"a rule for {folder}, which has no targets")
            for target in targets:
                reached = {self.links.folder.get(t, "") for t in self.links.reached(target, self.links.direct)}
                for other in others:
                    inside = {f for f in reached if f == other or f.startswith(other + "/")} - {self.links.folder[target]}
                    self.assertFalse(inside, f"{target} of {folder} links {sorted(inside)}")

    def test_each_heavy_library_is_included_by_one_file(self):
        users = collections.defaultdict(set)
        for folder in PRODUCTION:
            for file in sources(folder):
                for name in INCLUDE.findall(file.read_text()):
                    for library, pattern in HEAVY.items():
                        if re.match(pattern, name):
                            users[library].add(str(file.with_suffix("") if library == "assimp" else file))
                    if name == "png.h":
                        users["libpng"].add(file.parent)
        for library in (*HEAVY, "libpng"):
            self.assertEqual(len(users[library]), 1, f"{library}: {sorted(map(str, users[library]))}")

    def test_few_files_name_a_kind_of_sample(self):
        naming = [str(f.relative_to(SOURCE)) for top in ("engine", "app", "cli", "robot") for f in sources(top) if KIND.search(f.read_text())]
        others = [f for f in naming if not f.startswith(tuple(MEANS_A_KIND))]
        self.assertFalse(others, "they name a kind: go by its row (host/samples/sample_kind.hpp), or say here why not")
        for one in MEANS_A_KIND:
            if not one.endswith("/"):
                self.assertIn(one, naming, "it names no kind any more")

    def test_every_library_has_a_short_readme(self):
        for folder in sorted(p for p in (SOURCE / "engine").iterdir() if p.is_dir()):
            self.assertLessEqual((folder / "README.md").read_text().count("\n"), 40, folder)

    def test_every_source_names_its_licence(self):
        for folder in (*PRODUCTION, "tests", "bench"):
            for file in sources(folder):
                self.assertTrue(file.read_text().startswith("// SPDX-License-Identifier: MIT\n"), file)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
