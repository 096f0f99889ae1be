# schema.py PROGRAM SOURCE SCRATCH: the JSON Schema of `voussoir docs --schema` holds for every scene and study of the
# repository, refuses a value of another type at every key that they state, and refuses nothing that the program reads.
import json
import pathlib
import subprocess
import sys
import tomllib

import jsonschema

program, source, scratch = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
schema = json.loads(subprocess.run([program, "docs", "--schema"], check=True, capture_output=True).stdout)
jsonschema.Draft7Validator.check_schema(schema)
validator = jsonschema.Draft7Validator(schema)
faults = []

# no scenes: inputs of the fuzz targets, which may be damaged, and tables of the manual
folders = ["app", "cases", "docs", "examples", "viewer/test"]
files = sorted(file for folder in folders for file in (source / folder).rglob("*.toml"))
trees = {file: tomllib.loads(file.read_text(encoding="utf-8")) for file in files}
for file, tree in trees.items():
    for error in validator.iter_errors(tree):
        place = ".".join(map(str, error.absolute_path))
        faults.append(f"{file.relative_to(source)}: {place}: {error.message[:200]}")
studies = sum("quantity" in tree for tree in trees.values())
if len(files) < 200 or studies < 20:
    faults.append(f"only {len(files)} files with {studies} studies were found in {source}")


def as_toml(value):
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False)
    if isinstance(value, list):
        return "[" + ", ".join(map(as_toml, value)) + "]"
    if isinstance(value, dict):
        return "{" + ", ".join(f"{json.dumps(key)} = {as_toml(inner)}" for key, inner in value.items()) + "}"
    return repr(value)


def program_reads(tree):
    file = scratch / "scene.toml"
    file.write_text("".join(f"{json.dumps(key)} = {as_toml(value)}\n" for key, value in tree.items()), encoding="utf-8")
    return subprocess.run([program, "check", str(file)], capture_output=True).returncode == 0


def places(value, keys=()):
    """paths to the values of all keys, and their addresses in the schema: without the numbers of lists"""
    items = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, inner in items:
        if isinstance(key, str):
            yield (*keys, key), tuple(part for part in (*keys, key) if isinstance(part, str))
        yield from places(inner, (*keys, key))


def changed(tree, path, change):
    copy = json.loads(json.dumps(tree))
    inner = copy
    for key in path[:-1]:
        inner = inner[key]
    change(inner, path[-1])
    return copy


def spoil(table, key):
    names = isinstance(table[key], list) and isinstance(table[key][0], str)  # for which one text is legal
    table[key] = 1 if names or isinstance(table[key], str) else "of no such type"


def remove(table, key):
    del table[key]


def misspell(table, key):
    table[key + "x"] = table.pop(key)


# each key once; scenes that name other files would need them beside the changed scene
scratch.mkdir(parents=True, exist_ok=True)
alone = [tree for tree in trees.values()
         if "quantity" not in tree and not any(word in str(tree) for word in ("'base'", "_file'", "'record'"))]
alone.sort(key=lambda tree: len(str(tree)))
tried, refused, refused_by_program_alone = set(), 0, 0
for tree in alone:
    for path, address in places(tree):
        for change in (spoil, remove, misspell):
            if (change, address) in tried:
                continue
            tried.add((change, address))
            mutant = changed(tree, path, change)
            legal = validator.is_valid(mutant)
            if legal and change is not remove:
                faults.append(f"the schema accepts {change.__name__} {'.'.join(address)}")
            if legal and change is remove:
                continue
            refused += 1
            if change is not misspell and program_reads(mutant):
                faults.append(f"the schema refuses what the program reads: {change.__name__} {'.'.join(map(str, path))}")
for fault in faults:
    print(fault)
print(f"{len(files)} files, {studies} of them studies; {len(tried)} changes of {len(tried) // 3} keys, {refused} refused")
if refused < 300:
    sys.exit(f"only {refused} changed scenes were refused")
sys.exit(1 if faults else 0)
