#!/usr/bin/python3
# metadata.py SOURCE: CITATION.cff by the rules of the Citation File Format 1.2.0, codemeta.json by the terms of CodeMeta 2.0, as far as we
# use them. The format's own schema is not in Debian, and CodeMeta 2.0 has none: the rules are ours, closed, so that a
# key that is none of theirs is a fault. Status 77 without python3-jsonschema and python3-yaml.
import json
import pathlib
import sys

try:
    import jsonschema
    import yaml
except ImportError as problem:
    print(f"skipped: {problem} (Debian: python3-jsonschema, python3-yaml)")
    sys.exit(77)

text = {"type": "string", "minLength": 1}


def table(required, **optional):
    return {"type": "object", "required": list(required), "additionalProperties": False,
            "properties": {key: rule for key, rule in {**required, **optional}.items()}}


def some(of):
    return {"type": "array", "minItems": 1, "uniqueItems": True, "items": of}


person = table({"family-names": text, "given-names": text}, **{"orcid": text, "affiliation": text, "email": text})
entity = table({"name": text}, **{"website": text, "city": text, "country": text})
authors = some({"anyOf": [person, entity]})
reference = table({"type": {"enum": ["thesis", "article", "book", "report", "software"]}, "authors": authors, "title": text},
                  **{"thesis-type": text, "year": {"type": "integer"}, "institution": entity, "doi": text, "url": text})
citation = table({"cff-version": {"const": "1.2.0"}, "message": text, "title": text, "authors": authors},
                 **{"type": {"enum": ["software", "dataset"]}, "abstract": text, "version": text, "keywords": some(text),
                    "license": text, "references": some(reference), "repository-code": text,
                    "date-released": {"type": "string", "pattern": "^[0-9]{4}-[0-9]{2}-[0-9]{2}$"}})

agent = {"anyOf": [table({"@type": {"const": "Organization"}, "name": text}),
                   table({"@type": {"const": "Person"}, "givenName": text, "familyName": text})]}
publication = table({"@type": text, "name": text, "author": some(agent)}, datePublished=text, publisher=agent, url=text)
codemeta = table({"@context": {"const": "https://doi.org/10.5063/schema/codemeta-2.0"}, "@type": {"const": "SoftwareSourceCode"},
                  "name": text, "version": text, "description": text, "license": {"type": "string", "format": "uri"},
                  "author": some(agent)},
                 programmingLanguage=some(text), operatingSystem=text, softwareRequirements=some(text), keywords=some(text),
                 referencePublication=publication, codeRepository=text, datePublished=text)

source = pathlib.Path(sys.argv[1])
# dates as texts, as JSON has them
cff = yaml.load((source / "CITATION.cff").read_text(encoding="utf-8"), Loader=yaml.BaseLoader)
for work in cff.get("references", []):
    work["year"] = int(work["year"])
faults = []
for name, rules, found in (("CITATION.cff", citation, cff),
                           ("codemeta.json", codemeta, json.loads((source / "codemeta.json").read_text(encoding="utf-8")))):
    validator = jsonschema.Draft7Validator(rules)
    faults += [f"{name}: {'.'.join(map(str, error.absolute_path))}: {error.message[:200]}" for error in validator.iter_errors(found)]
    # the rules themselves refuse a file without any of its keys, or with another
    for key in rules["required"]:
        if validator.is_valid({other: value for other, value in found.items() if other != key}):
            faults.append(f"{name}: would pass without {key}")
    if validator.is_valid({**found, "colour": "red"}):
        faults.append(f"{name}: would pass with a key that the format does not know")
for fault in faults:
    print(fault)
print(f"CITATION.cff and codemeta.json: {len(faults)} faults")
sys.exit(1 if faults else 0)
