#!/bin/sh
# skip.sh REASON: replaces the module's test if there is no module.
echo "skipped: $1"
exit 77
