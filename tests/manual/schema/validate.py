#!/usr/bin/env python3
"""Judges records with jsonschema, a validator that is not written here: validate.py SCHEMA.json RECORDS.ndjson...

Every record must fit the schema, fields that it does not name forbidden. Records spoilt in one place, without a field that they need or
with an object in place of a value, must not fit; and what the schema knows must be in some record. Prints how many there were of each kind.
"""

import collections
import copy
import json
import sys

import jsonschema

# what a record cannot do without, as the tools' errors have it and not as the schema does
NEEDED = {
    "scene": ["format", "id", "geometry.shape", "facets", "light", "response"],
    "sample": ["scene", "id"],
    "summary": ["samples", "scored"],
    "plan": ["scene", "reflectances", "samples", "noise_sd", "expected_rmse.mean"],
    "iteration": ["sample", "run", "iteration", "cost"],
}

# what no record here has: that of RAW files, of cameras with a clock, of pictures whose tags are damaged, of days without sun, which vforward does not know, and of skies
# for which nobody plans
ABSENT = ("image.sensor", "image.taken", "image.notes", "estimate.fit.sun", "expected_sd.cloud", "expected_sd.even_sky", "expected_sd.sun")


def close(schema):
    """Forbids fields that the schema does not name: where a value is described, not in the forms that it can have."""
    described = [*schema.get("properties", {}).values()]
    described += [schema[key] for key in ("items", "additionalProperties") if isinstance(schema.get(key), dict)]
    for value in described:
        close(value)
        value["unevaluatedProperties"] = False
    for key in ("anyOf", "oneOf"):
        for form in schema.get(key, []):
            close(form)
    for definition in schema.get("$defs", {}).values():
        close(definition)


def paths(value, path=()):
    """Where all fields are, all entries of lists of objects, and the first of other lists."""
    entries = value.items() if isinstance(value, dict) else []
    if isinstance(value, list):
        entries = [(n, entry) for n, entry in enumerate(value) if n == 0 or isinstance(entry, dict)]
    for key, entry in entries:
        yield (*path, key)
        yield from paths(entry, (*path, key))


def of_any_entry(path):
    """The path with every number of an entry as 0."""
    return tuple(0 if isinstance(key, int) else key for key in path)


def known(schema, root, path=()):
    """The fields that a schema names, as `paths` has those of a record."""
    for name, value in schema.get("properties", {}).items():
        yield (*path, name)
        yield from known(value, root, (*path, name))
    if "items" in schema:
        yield from known(schema["items"], root, (*path, 0))
    for form in schema.get("anyOf", []) + schema.get("oneOf", []):
        yield from known(form, root, path)
    if "$ref" in schema:
        yield from known(root["$defs"][schema["$ref"].split("/")[-1]], root, path)


def spoilt(record, path, spoil):
    record = copy.deepcopy(record)
    parent = record
    for key in path[:-1]:
        parent = parent[key]
    spoil(parent, path[-1])
    return record


def drop(parent, key):
    del parent[key]


def replace(parent, key):
    parent[key] = {"spoilt": True}


def main(schema, *streams):
    with open(schema) as file:
        schema = json.load(file)
    jsonschema.Draft202012Validator.check_schema(schema)
    for record in schema["$defs"].values():
        jsonschema.Draft202012Validator.check_schema(record)
        close(record)
        record["unevaluatedProperties"] = False
    validator = jsonschema.Draft202012Validator(schema)
    kinds, spoilt_paths = collections.Counter(), set()
    for stream in streams:
        for number, line in enumerate(open(stream), 1):
            record = json.loads(line)
            kind = record["kind"]
            assert kind in schema["$defs"], f"{stream}:{number}: no schema of a {kind}"
            for error in validator.iter_errors(record):
                sys.exit(f"{stream}:{number}: {error.json_path}: {error.message[:300]}")
            kinds[kind] += 1
            for path in paths(record):
                if path == ("kind",) or (kind, of_any_entry(path)) in spoilt_paths:
                    continue
                spoilt_paths.add((kind, of_any_entry(path)))
                named = ".".join(map(str, path))
                if validator.is_valid(spoilt(record, path, replace)):
                    sys.exit(f"{stream}:{number}: an object fits in place of {named}")
                if named in NEEDED[kind] and validator.is_valid(spoilt(record, path, drop)):
                    sys.exit(f"{stream}:{number}: fits without {named}")
    for kind, record in schema["$defs"].items():
        missing = {path for path in known(record, record) if (kind, path) not in spoilt_paths} - {("kind",)}
        missing = {".".join(map(str, path)) for path in missing}
        unseen = {name for name in missing if not name.startswith(ABSENT)}
        if unseen:
            sys.exit(f"no {kind} has {', '.join(sorted(unseen))}")
    print(*(f"{kinds[kind]} {kind}" for kind in sorted(kinds)), sep=", ")
    print(len(spoilt_paths), "fields spoilt, none fits")


if __name__ == "__main__":
    main(*sys.argv[1:])
