#!/bin/sh
# schema.sh PROGRAM SOURCE FOLDER: the JSON Schema of scenes and studies (schema.py); status 77 without jsonschema
for python in python3 /usr/bin/python3; do
  if command -v "$python" >/dev/null && "$python" -c 'import jsonschema, tomllib' 2>/dev/null; then
    exec "$python" "$(dirname "$0")/schema.py" "$@"
  fi
done
echo "skipped: Python's module jsonschema is not installed (Debian: python3-jsonschema)"
exit 77
