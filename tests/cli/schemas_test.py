#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""schemas_test.py SOURCE BUILD [--only TEXT]: validates what --json prints, and the JSON files that commands write, with docs/schemas/.

schemas_commands.toml has the commands. These fail: a document that its schema does not allow; a schema that no document uses, or a member of it
that none has; a document's name in the sources without a schema; a command with the option --json that is not run; an object to which a member can be
added unnoticed.
Exit status: 0 all is well, 1 it is not.
"""
import argparse
import json
import re
import subprocess
import sys
import tomllib
from pathlib import Path

from readme_test import Promises

try:
    from jsonschema import Draft202012Validator, validators
    from jsonschema.exceptions import SchemaError, best_match
except ImportError:
    sys.exit("the Python package jsonschema is missing: `scripts/install-deps.sh test` installs python3-jsonschema")

HERE = Path(__file__).resolve().parent
FOLDERS = ("app", "cli", "editor", "engine", "loaders", "plugins", "robot", "sdk")
DIALECT = "https://json-schema.org/draft/2020-12/schema"
SHARED = "common.schema.json"  # parts that others refer to
NO_DOCUMENTS = {  # names in the sources that are none of a JSON document
    "batch/1": "a plan, TOML",
    "journal/1": "the head of a text file",
    "log/1": "in the metadata of an MCAP log",
    "machine/1": "a profile, TOML",
    "materials/1": "a table of materials, TOML",
    "robot/1": "a configuration, TOML",
    "scenario/1": "a scenario, TOML",
    "world/2": "the head of a binary cache",
}


NOT_SEEN = {  # members that no command of schemas_commands.toml brings about
    "edit-1.schema.json#/$defs/report/properties/copied": "the console alone has a clipboard",
    "planes-1.schema.json#/properties/score/anyOf/0/properties/fault_list/items/properties/gap": "labels have no rectangles",
}


class BadJson(ValueError):
    """Text that is no JSON of RFC 8259, or says one thing twice."""


def parse(text):
    """The document of a text. Numbers that are not finite, and names that stand twice in one object, are errors."""

    def refuse(constant):
        raise BadJson(f"{constant} is no number of JSON")

    def unique(pairs):
        names = [name for name, _ in pairs]
        twice = sorted({name for name in names if names.count(name) > 1})
        if twice:
            raise BadJson(f"an object has these members twice: {', '.join(twice)}")
        return dict(pairs)

    return json.loads(text, parse_constant=refuse, object_pairs_hook=unique)


def schema_name(document):
    """"run/1" of a document that says "hallway.run/1"."""
    said = document.get("schema") if isinstance(document, dict) else None
    if not isinstance(said, str) or not said.startswith("hallway."):
        raise BadJson("it has no member \"schema\" with a name of Hallway")
    return said[len("hallway."):]


class Schemas:
    """docs/schemas/, with validators for its documents."""

    def __init__(self, folder):
        self.folder = folder
        self.by_file = {path.name: self.read(path) for path in sorted(folder.glob("*.json"))}
        self.uris = {name: (folder / name).resolve().as_uri() for name in self.by_file}
        # Taken out, for it would choose a class of validators that does not note what it sees.
        self.dialects = {name: schema.pop("$schema", None) for name, schema in self.by_file.items()}
        self.seen = set()  # (the object "properties" of a schema, a member that a document had)

    @staticmethod
    def read(path):
        try:
            return parse(path.read_text())
        except ValueError as error:
            sys.exit(f"docs/schemas/{path.name}: {error}")

    def names(self):
        return {re.sub(r"-(\d+)\.schema\.json$", r"/\1", name) for name in self.by_file if name != SHARED}

    def problems(self):
        """What is wrong with the schemas themselves."""
        for name, schema in self.by_file.items():
            try:
                Draft202012Validator.check_schema(schema)
            except SchemaError as error:
                yield f"docs/schemas/{name}: {error.json_path}: {error.message[:300]}"
            if self.dialects[name] != DIALECT:
                yield f"docs/schemas/{name}: its $schema is not {DIALECT}"
            said = schema.get("properties", {}).get("schema", {}).get("const", "")
            if name != SHARED and name != said.replace("hallway.", "", 1).replace("/", "-") + ".schema.json":
                yield f"docs/schemas/{name}: it is of documents that say \"{said}\""

    def noting_validator(self):
        """The class of validators that note which members they see."""
        plain = Draft202012Validator.VALIDATORS["properties"]

        def note_properties(validator, properties, instance, schema):
            if isinstance(instance, dict):
                self.seen.update((id(properties), name) for name in properties.keys() & instance.keys())
            yield from plain(validator, properties, instance, schema)

        return validators.extend(Draft202012Validator, {"properties": note_properties})

    def unseen(self):
        """Members that schemas name and no document had: "FILE#/path/in/it"."""
        for file, schema in self.by_file.items():
            for path, properties in properties_of(schema):
                for name, member in properties.items():
                    if member is not False and (id(properties), name) not in self.seen:
                        yield f"{file}#{path}/{name}"

    def validator(self, name):
        """Of documents of that name. Throws BadJson without a schema."""
        file = name.replace("/", "-") + ".schema.json"
        if file not in self.by_file:
            raise BadJson(f"docs/schemas/{file} is missing")
        start = {"$ref": self.uris[file]}
        by_uri = {self.uris[other]: schema for other, schema in self.by_file.items()}
        try:
            from referencing import Registry
            from referencing.jsonschema import DRAFT202012
        except ImportError:  # before jsonschema 4.18, as in Debian 12
            from jsonschema import RefResolver
            return self.noting_validator()(start, resolver=RefResolver("", start, store=by_uri))
        registry = Registry().with_resources((uri, DRAFT202012.create_resource(schema)) for uri, schema in by_uri.items())
        return self.noting_validator()(start, registry=registry)


def properties_of(schema, path=""):
    """(path, object) of each "properties" of a schema."""
    if isinstance(schema, list):
        for index, part in enumerate(schema):
            yield from properties_of(part, f"{path}/{index}")
    elif isinstance(schema, dict):
        for name, part in schema.items():
            if name == "properties" and not path.endswith("/properties"):
                yield f"{path}/{name}", part
            yield from properties_of(part, f"{path}/{name}")


def objects_of(document, path=()):
    """(path, object) of a document, of the elements of a list alike the first object alone."""
    if isinstance(document, dict):
        yield path, document
        for name, member in document.items():
            yield from objects_of(member, (*path, name))
    elif isinstance(document, list):
        seen = set()
        for index, element in enumerate(document):
            shape = frozenset(element) if isinstance(element, dict) else type(element)
            if isinstance(element, (dict, list)) and shape not in seen:
                seen.add(shape)
                yield from objects_of(element, (*path, index))


def faults_of(document, validator):
    """What the schema does not allow, and where: at most five."""
    faults = []
    for error in validator.iter_errors(document):
        cause = best_match([error])  # of several that could be meant, what is nearest
        faults.append(f"{cause.json_path}: {cause.message[:300]}")
        if len(faults) == 5:
            break
    return faults


def open_objects(document, validator):
    """Paths of objects to which a member can be added that the schema does not know."""
    for path, node in objects_of(document):
        node["a member that nobody knows"] = {}
        if validator.is_valid(document):
            yield "$" + "".join(f"[{part}]" if isinstance(part, int) else f".{part}" for part in path)
        del node["a member that nobody knows"]


class Checks:
    """Documents that were seen, and what is wrong with them."""

    def __init__(self, schemas):
        self.schemas, self.problems, self.counts = schemas, [], {}

    def check(self, label, text, wanted=None, status=None):
        """A document: of the name `wanted`, and its own "status" is that of its command."""
        try:
            document = parse(text)
            name = schema_name(document)
            validator = self.schemas.validator(name)
        except ValueError as error:
            self.problems.append(f"{label}: {error}; it begins with {text[:200]!r}")
            return
        self.counts[name] = self.counts.get(name, 0) + 1
        if wanted is not None and name != wanted:
            self.problems.append(f"{label}: it is a document {name} instead of {wanted}: {text[:300]!r}")
            return
        if status is not None and document.get("status", status) != status:
            self.problems.append(f"{label}: it says status {document['status']}, and the command ended with {status}")
        faults = faults_of(document, validator)
        self.problems += [f"{label}: {name}: {fault}" for fault in faults]
        if not faults:
            self.problems += [f"{label}: {name}: {path}: its schema allows members that it does not know" for path in open_objects(document, validator)]


def names_in_sources(source):
    """The names of documents in the sources, each with a file that has it."""
    names = {}
    for folder in FOLDERS:
        for path in sorted((source / folder).rglob("*.?pp")):
            for name in re.findall(r'"hallway\.([\w-]+/\d+)(?:\\n)?"', path.read_text()):
                names.setdefault(name, path.relative_to(source))
    return names


def missing_schemas(source, schemas):
    known, found = schemas.names(), names_in_sources(source)
    for name, path in sorted(found.items()):
        if name not in known and name not in NO_DOCUMENTS:
            yield f"{path}: documents hallway.{name} have no schema in docs/schemas/"
    for name in sorted(known - found.keys()):
        yield f"docs/schemas/: hallway.{name} is nowhere in the sources"
    for name in sorted(NO_DOCUMENTS.keys() - found.keys()):
        yield f"schemas_test.py: hallway.{name} is nowhere in the sources"


def json_commands(program, promises):
    """The commands of a program that take --json."""
    for command in parse(promises.shell(f"{program} help --json").stdout)["commands"]:
        if any("--json" in option["names"] for option in command["options"]):
            yield re.sub(r"^hallway study .*", "hallway study", command["command"])  # one for all


def run_commands(table, promises, checks, only):
    """@return whether all were run"""
    whole = not only
    for entry in table["command"]:
        command, wanted_status = entry["run"], entry.get("status", 0)
        if only not in command:
            continue
        if "file" in entry and not (promises.folder / entry["file"]).exists():
            print("skipped", command, flush=True)
            whole = False
            continue
        try:
            promises.prepare(entry.get("needs", []))
            ran = promises.shell(command)
        except (RuntimeError, subprocess.TimeoutExpired) as error:
            checks.problems.append(f"`{command}`: {error}")
            continue
        label, before = f"`{command}`", len(checks.problems)
        if ran.returncode != wanted_status:
            checks.problems.append(f"{label}: it ended with {ran.returncode} instead of {wanted_status}: {ran.stderr.strip()[-400:]}")
        checks.check(label, ran.stdout, entry["prints"], ran.returncode)
        for pattern, name in entry.get("writes", {}).items():
            files = sorted(promises.folder.glob(pattern))
            if not files:
                checks.problems.append(f"{label}: there is no file {pattern}")
            for path in files:
                checks.check(f"{label}: {path.relative_to(promises.folder)}", path.read_text(), name)
        print("failed" if len(checks.problems) > before else "ok", command, flush=True)
    return whole


def check_all_files(promises, checks):
    """Every JSON file below out/, also what the table does not name."""
    for path in sorted((promises.folder / "out").rglob("*.json")):
        checks.check(str(path.relative_to(promises.folder)), path.read_text())


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("source", type=lambda text: Path(text).resolve())
    parser.add_argument("build", type=lambda text: Path(text).resolve())
    parser.add_argument("--only", default="", help="run only commands that contain this text")
    arguments = parser.parse_args()
    table = tomllib.loads((HERE / "schemas_commands.toml").read_text())
    schemas = Schemas(arguments.source / "docs" / "schemas")
    checks = Checks(schemas)
    checks.problems += [*schemas.problems(), *missing_schemas(arguments.source, schemas)]
    promises = Promises(arguments.source, arguments.build, table, False)
    try:
        whole = run_commands(table, promises, checks, arguments.only)
        check_all_files(promises, checks)
        if not arguments.only:
            lines = [entry["run"] for entry in table["command"]]
            for program in ("hallway", "hallway-robot"):
                checks.problems += [f"`{command} --json` is not in schemas_commands.toml" for command in json_commands(program, promises)
                                    if not any(re.search(rf"\b{command}\b.*--json", line) for line in lines)]
            checks.problems += [f"docs/schemas/: no document uses hallway.{name}" for name in sorted(schemas.names() - checks.counts.keys())]
        if whole:
            unseen = set(schemas.unseen())
            checks.problems += [f"docs/schemas/{member}: no document has it" for member in sorted(unseen - NOT_SEEN.keys())]
            checks.problems += [f"schemas_test.py: {member} is seen, or is no member" for member in sorted(NOT_SEEN.keys() - unseen)]
    finally:
        promises.close()
    for name, count in sorted(checks.counts.items()):
        print(f"{count:4} hallway.{name}")
    print("\n".join(checks.problems))
    print(f"{sum(checks.counts.values())} documents of {len(checks.counts)} schemas, {len(checks.problems)} problems")
    return 1 if checks.problems or not checks.counts else 0


if __name__ == "__main__":
    sys.exit(main())
