#!/usr/bin/env bash
# make_dist.sh FOLDER: the source archive of the commit that is checked out, FOLDER/voussoir-VERSION.tar.gz, with the same bytes whenever it
# is made. It contains the viewer's bundle with its licences, so that a build needs no network.
set -euo pipefail
folder=$1
cd "$(dirname "$0")/.."
version=$(sed -nE 's/^project\(voussoir VERSION ([0-9.]+).*/\1/p' CMakeLists.txt)
[ -z "$(git status --porcelain --untracked-files=no)" ] ||
  echo "make dist: files differ from the commit; the archive has those of the commit" >&2
archive=$folder/voussoir-$version.tar.gz
mkdir -p "$folder"
git archive --prefix="voussoir-$version/" HEAD | gzip -n9 >"$archive"
listed=$(tar -tzf "$archive")
for file in viewer/bundle/asset.cpp viewer/bundle/LICENSES LICENSE packaging/copyright; do
  grep -qx "voussoir-$version/$file" <<<"$listed" || { echo "make dist: $file is not in $archive" >&2; exit 1; }
done
echo "make dist: $archive: $(wc -l <<<"$listed") entries, $(stat -c %s "$archive") bytes, sha256 $(sha256sum "$archive" | cut -d ' ' -f 1)"
