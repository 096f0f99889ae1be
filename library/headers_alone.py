#!/usr/bin/env python3
# headers_alone.py INCLUDE COMPILER [long]: every header in INCLUDE/voussoir includes only installed ones, and compiles alone, as the
# first of a program; what voussoir.hpp includes has no member that Eigen allocates: a program compiled for AVX2 would free it in
# another way than the library allocated it. Each compilation reads Eigen again, about 2 s: the short test compiles voussoir.hpp alone.
import pathlib
import re
import subprocess
import sys

include, compiler, everything = pathlib.Path(sys.argv[1]), sys.argv[2], sys.argv[3:] == ["long"]
headers = {str(path.relative_to(include)): path.read_text(encoding="utf-8")
           for path in sorted(include.glob("voussoir/**/*.hpp"))}
included = {name: re.findall(r'^ *# *include *[<"](voussoir/[^>"]+)', text, re.M) for name, text in headers.items()}
faults = []
for name, text in headers.items():
    faults += [f"{name} includes {path}, which is not installed" for path in included[name] if path not in headers]
    faults += [f"{name} includes \"{path}\": <voussoir/…> is the only path that users have"
               for path in re.findall(r'^ *# *include *"([^"]+)', text, re.M)]

reached, todo = set(), ["voussoir/voussoir.hpp"]
while todo:
    name = todo.pop()
    if name not in reached and name in headers:
        reached.add(name)
        todo += included[name]
for name in sorted(reached):
    faults += [f"{name} has a member that Eigen allocates: {line.strip()}" for line in headers[name].splitlines()
               if re.match(r"\s+(std::\w+<)*Eigen::(Vector|RowVector|Matrix|Array|Sparse)[Xd]?\w*[> ]*[^()]*;", line)]

eigen = subprocess.run(["pkg-config", "--cflags-only-I", "eigen3"], check=True, capture_output=True, text=True).stdout
flags = [compiler, "-std=c++20", "-x", "c++", f"-I{include}", "-isystem", eigen.strip().removeprefix("-I")]

chosen = sorted(headers) if everything else ["voussoir/voussoir.hpp"]
for name in chosen:
    ended = subprocess.run([*flags, "-fsyntax-only", "-include", name, "/dev/null"], capture_output=True, text=True)
    if ended.returncode != 0:
        faults.append(f"{name} does not compile alone:\n{ended.stderr[:2000]}")
for fault in faults:
    print(fault)
print(f"{len(headers)} installed headers, {len(chosen)} of them compiled alone, {len(faults)} faults")
sys.exit(1 if faults or len(headers) < 200 else 0)
