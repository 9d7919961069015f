"""Reads a SigMF collection and its recordings as the specification (1.2) has them.

Usage: sigmf_check.py FILE.sigmf-collection
Prints one line per recording; says what is wrong on stderr and exits with 1.
"""

import hashlib
import json
import os
import re
import sys

U64 = 2**64 - 1


def fail(text):
    sys.exit(text)


def integer(value, low=0, high=U64):
    return isinstance(value, int) and not isinstance(value, bool) and low <= value <= high


def number(value, low=-1e12, high=1e12):
    return isinstance(value, (int, float)) and not isinstance(value, bool) and low <= value <= high


def text(value, pattern=r".*"):
    return isinstance(value, str) and re.search(pattern, value, re.S) is not None


DATE = r"^\d{4}-[01]\d-[0-3]\dT[0-2]\d:[0-5]\d:[0-5]\d(\.\d+)?Z$"
DATATYPE = r"^((c|r)(f32|f64|i32|i16|u32|u16)_(le|be)|(c|r)(i8|u8))$"


def extensions(value):
    return isinstance(value, list) and all(
        set(e) == {"name", "version", "optional"}
        and text(e["name"]) and text(e["version"]) and isinstance(e["optional"], bool)
        for e in value)


# Name: (required, check).
GLOBAL = {
    "core:datatype": (True, lambda v: text(v, DATATYPE)),
    "core:version": (True, lambda v: text(v, r"^\d+\.\d+\.\d+$")),
    "core:sample_rate": (False, lambda v: number(v, 1)),
    "core:num_channels": (False, lambda v: integer(v, 1, 1000)),
    "core:sha512": (False, lambda v: text(v, r"^[0-9a-fA-F]{128}$")),
    "core:description": (False, text),
    "core:recorder": (False, text),
    "core:extensions": (False, extensions),
}
CAPTURE = {
    "core:sample_start": (True, integer),
    "core:global_index": (False, integer),
    "core:datetime": (False, lambda v: text(v, DATE)),
    "core:frequency": (False, number),
}
ANNOTATION = {
    "core:sample_start": (True, integer),
    "core:sample_count": (False, integer),
    "core:freq_lower_edge": (False, number),
    "core:freq_upper_edge": (False, number),
    "core:label": (False, lambda v: text(v, r"^.{1,20}$")),
    "core:comment": (False, text),
    "core:generator": (False, text),
}


def check_fields(where, fields, rules, namespaces):
    if not isinstance(fields, dict):
        fail(f"{where}: not an object")
    for name, (required, check) in rules.items():
        if name in fields and not check(fields[name]):
            fail(f"{where}: {name} is {fields[name]!r}")
        if required and name not in fields:
            fail(f"{where}: no {name}")
    for name in fields:
        space = name.split(":")[0]
        if name not in rules and (":" not in name or space == "core" or space not in namespaces):
            fail(f"{where}: unknown field {name}")


def check_sorted(where, segments):
    starts = [s["core:sample_start"] for s in segments]
    if starts != sorted(starts):
        fail(f"{where}: not sorted by core:sample_start")


def check_recording(base):
    with open(base + ".sigmf-meta", encoding="utf-8") as file:
        meta = json.load(file)
    if set(meta) != {"global", "captures", "annotations"}:
        fail(f"{base}: has {sorted(meta)}")
    about = meta["global"]
    namespaces = {e["name"] for e in about.get("core:extensions", [])}
    check_fields(f"{base} global", about, GLOBAL, namespaces)
    for part, rules in (("captures", CAPTURE), ("annotations", ANNOTATION)):
        if not isinstance(meta[part], list):
            fail(f"{base}: {part} is no array")
        for segment in meta[part]:
            check_fields(f"{base} {part}", segment, rules, namespaces)
        check_sorted(f"{base} {part}", meta[part])
    with open(base + ".sigmf-data", "rb") as file:
        data = file.read()
    if about["core:sha512"] != hashlib.sha512(data).hexdigest():
        fail(f"{base}: core:sha512 is not that of the data")
    bits = int(re.search(r"\d+", about["core:datatype"]).group())
    parts = 2 if about["core:datatype"].startswith("c") else 1
    size = bits // 8 * parts * about.get("core:num_channels", 1)
    if len(data) % size != 0:
        fail(f"{base}: {len(data)} bytes are no whole samples")
    samples = len(data) // size
    for note in meta["annotations"]:
        if note["core:sample_start"] + note.get("core:sample_count", 0) > samples:
            fail(f"{base}: an annotation lies beyond the data")
        if ("core:freq_lower_edge" in note) != ("core:freq_upper_edge" in note):
            fail(f"{base}: one edge of frequency without the other")
    print(os.path.basename(base), about["core:datatype"], about["core:sample_rate"], samples,
          len(meta["annotations"]))


def main():
    path = sys.argv[1]
    with open(path, encoding="utf-8") as file:
        whole = json.load(file)
    if set(whole) != {"collection"}:
        fail("collection: must be the only object")
    collection = whole["collection"]
    check_fields("collection", collection, {
        "core:version": (True, lambda v: text(v, r"^\d+\.\d+\.\d+$")),
        "core:description": (False, text),
        "core:streams": (False, lambda v: isinstance(v, list)),
    }, set())
    for stream in collection["core:streams"]:
        if set(stream) != {"name", "hash"}:
            fail(f"stream: has {sorted(stream)}")
        base = os.path.join(os.path.dirname(path), stream["name"])
        with open(base + ".sigmf-meta", "rb") as file:
            if stream["hash"] != hashlib.sha512(file.read()).hexdigest():
                fail(f"{base}: the collection's hash is not that of its metadata")
        check_recording(base)


main()
