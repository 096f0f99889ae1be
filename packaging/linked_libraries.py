#!/usr/bin/env python3
# linked_libraries.py COPYRIGHT PROGRAM [LIBRARY…]: every shared library that the program or a library of ours loads has a paragraph in
# COPYRIGHT that says "linked as libNAME.so" under a licence that is not the GPL, LGPL or EPL, and no paragraph says so of one
# that the program does not load.
import pathlib
import re
import subprocess
import sys

# the runtime of C and C++ (the paragraph on top of COPYRIGHT), the sanitizers' of a build that has them, and our own
runtime = {"linux-vdso", "ld-linux-x86-64", "ld-linux-aarch64", "libc", "libm", "libdl", "libpthread", "librt", "libstdc++",
           "libgcc_s", "libasan", "libubsan", "libtsan", "libvoussoir_core", "libvoussoir_text"}
refused = re.compile(r"GPL|EPL|CPL", re.I)
faults = []

stated = {}
for paragraph in pathlib.Path(sys.argv[1]).read_text(encoding="utf-8").split("\n\n"):
    licence = re.search(r"^License: (.*)$", paragraph, re.M)
    for name in re.findall(r"linked as (\S+?)\.so", " ".join(paragraph.split())):
        stated[name] = licence[1] if licence else "none"
for name, licence in stated.items():
    if refused.search(licence) or licence == "none":
        faults.append(f"{name} is linked, and its licence is {licence}")


def loaded(binary):
    text = subprocess.run(["ldd", binary], check=True, capture_output=True, text=True).stdout
    return {pathlib.Path(line.split()[0]).name.split(".so")[0] for line in text.splitlines() if line.strip()}


of_program = loaded(sys.argv[2])
for binary in sys.argv[2:]:
    for name in sorted(loaded(binary) - runtime - stated.keys()):
        faults.append(f"{binary} loads {name}.so, of which {sys.argv[1]} says nothing")
for name in sorted(stated.keys() - of_program):
    faults.append(f"{sys.argv[1]} says that {name}.so is linked, but {sys.argv[2]} does not load it")
if "libc" not in of_program:
    faults.append(f"ldd found no C library in {sys.argv[2]}")
for fault in faults:
    print(fault)
print(f"{len(of_program - runtime)} libraries, {len(stated)} stated: {', '.join(sorted(stated))}")
sys.exit(1 if faults else 0)
