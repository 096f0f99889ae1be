#!/usr/bin/env bash
# A comparison of the probe's hashes proves something only if a start that differs by one ulp changes all of them.
#   one_ulp_shows.sh <probe>
set -euo pipefail
same=$(comm -12 <("$1" | grep fnv1a64 | sort) <("$1" --nudge | grep fnv1a64 | sort))
[ -z "$same" ] || { echo "FAILED: one ulp did not change $(wc -l <<<"$same") hashes, such as: ${same%%$'\n'*}"; exit 1; }
echo "one ulp changes every hash"
