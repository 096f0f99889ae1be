#!/usr/bin/env bash
# install_headers.sh SOURCE DESTINATION: the public headers, as DESTINATION/voussoir.hpp, DESTINATION/core/… and DESTINATION/text/….
# Their includes become #include <voussoir/core/…>, so that users need the folder above DESTINATION alone in their path.
set -euo pipefail
source=$1 destination=$2
# not public: tests and their oracles; arithmetic whose rounding depends on our own flags; what needs integers of Boost or a
# library for JSON
internal='/testing/|_test\.hpp$|/glpk[^/]*\.hpp$|/ipopt\.hpp$|_inl\.hpp$|^core/(step|implicit)/|^core/run/(fields|twin)\.hpp$'
internal+='|^core/contact/separation\.hpp$|^core/solvers/(symmetric_system|cone_scaling|double_double)\.hpp$'
internal+='|^core/limit/(follow_envelope|exact_.*|proof)\.hpp$|^core/output/json_parts\.hpp$|^core/scene/scene_schema\.hpp$'

rm -rf "$destination/core" "$destination/text"
mkdir -p "$destination"
cd "$source"
find core text -name '*.hpp' | grep -Ev "$internal" | LC_ALL=C sort | xargs cp --parents -t "$destination"
cp library/voussoir.hpp "$destination"
# all at once: a process for each header would take a minute
find "$destination" -name '*.hpp' -exec chmod 644 {} + \
  -exec sed -i -E 's|^( *# *include )"((core\|text)/[^"]+)"|\1<voussoir/\2>|' {} +
