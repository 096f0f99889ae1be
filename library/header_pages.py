#!/usr/bin/env python3
# header_pages.py SOURCE OUT: the headers that library/voussoir.hpp includes as one page of Markdown: of every declaration its name, comment,
# text and line. Fails if a declaration has no comment, or cannot be read.
#
# Not Doxygen, which was tried on core/contact/contact_between.hpp with a filter that makes /// of //: it gave the comment of the
# file to the namespace, lost that of the function, and made 51 files (684 kB) in a look of its own of 48 lines.
import pathlib
import re
import sys

source, out = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
faults = []


def public_headers():
    text = (source / "library/voussoir.hpp").read_text(encoding="utf-8")
    return re.findall(r'^#include "([^"]+)"', text, re.M)


def prose(comment):
    """lines of a comment as paragraphs; lines that are indented further keep their breaks"""
    lines = [re.sub(r"^// ?", "", line) for line in comment]
    text = ""
    for line in lines:
        fixed = line.startswith("  ")
        text += ("\n" if fixed and not text.endswith("\n") and text else "" if not text or text.endswith("\n") else " ")
        text += ("    " + line.strip() + "\n") if fixed else line
    # angle brackets and underscores are letters here, and a list of indented lines needs a line before it
    return re.sub(r"(?<!\n)\n    ", "\n\n    ", text, count=1) if "\n    " in text else re.sub(r"([<*])", r"\\\1", text)


def name_of(declaration):
    text = re.sub(r"template <[^{]*?>\n", "", declaration)
    for pattern in (r"^\s*(?:struct|class|enum class|enum)\s+(?:alignas\([^)]*\)+\s+)?(\w+)", r"^\s*using\s+(\w+)",
                    r"^\s*(?:inline )?constexpr [^=]*?[ *](\w+)(?:\[\])?(?:\{| =|,)"):
        if found := re.search(pattern, text):
            return found[1]
    if found := re.search(r"(operator\S+|\w+)\(", text):
        return found[1]
    return None


def without_code(line):
    return re.sub(r'"(\\.|[^"\\])*"|//.*', "", line)


def shown(lines):
    """a function without its body"""
    text = "\n".join(lines)
    if re.search(r"^\s*(template <.*>\s*)?(struct|class|enum|using|inline constexpr|constexpr)\b", text):
        return text
    return re.sub(r"(\)(?: const)?) \{.*", r"\1;", text, flags=re.S)


def declarations(path):
    """(name, comment, text, line) of each declaration in namespace voussoir"""
    lines = (source / path).read_text(encoding="utf-8").split("\n")
    begin = lines.index("namespace voussoir {") + 1
    end = max(number for number, line in enumerate(lines) if line.startswith("}  // namespace voussoir"))
    comment, number = [], begin
    while number < end:
        line = lines[number]
        if line.startswith("//"):
            comment.append(line)
            number += 1
            continue
        if not line.strip():
            comment = []
            number += 1
            continue
        first, depth, round_depth = number, 0, 0
        while True:  # to the end of the declaration
            code = without_code(lines[number])
            depth += code.count("{") - code.count("}")
            round_depth += code.count("(") - code.count(")")
            number += 1
            if depth == 0 and round_depth == 0 and code.rstrip().endswith((";", "}")):
                break
            if number >= end:
                faults.append(f"{path}:{first + 1}: a declaration without an end")
                return
        text = lines[first:number]
        # a declaration without its definition is no news
        if not re.fullmatch(r"(struct|class) \w+;", text[0].strip()):
            yield name_of("\n".join(text)), comment, text, first + 1


def page_of(path):
    lines = (source / path).read_text(encoding="utf-8").split("\n")
    about = []
    for line in lines:
        if not line.startswith("//"):
            break
        about.append(line)
    if not about:
        faults.append(f"{path}: no comment on its contents")
    text = f"## `<voussoir/{path}>`\n\n{prose(about)}\n"
    before = ""
    for name, comment, declaration, line in declarations(path):
        if name is None:
            faults.append(f"{path}:{line}: no name was found in: {declaration[0]}")
            continue
        inside = any("//" in one for one in declaration)  # members or the line itself are explained
        if not comment and not inside and not before:
            faults.append(f"{path}:{line}: {name} has no comment")
        text += f"\n### {name}\n\n" + (prose(comment) + "\n\n" if comment else "")
        text += "```cpp\n" + shown(declaration) + f"\n```\n\n`{path}:{line}`\n"
        before = name if comment else ""
    return text


pages = [page_of(path) for path in public_headers()]
text = ("# Public headers\n\nThe headers that `<voussoir/voussoir.hpp>` includes, from their comments. "
        "What is stable: docs/library.md.\n\n" + "\n".join(pages))
out.parent.mkdir(parents=True, exist_ok=True)
out.write_text(text, encoding="utf-8")
for fault in faults:
    print(fault)
print(f"{len(pages)} headers, {text.count(chr(10) + '### ')} declarations, {len(faults)} faults: {out}")
sys.exit(1 if faults or len(pages) < 10 else 0)
