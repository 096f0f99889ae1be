#!/usr/bin/env bash
# bare_root_test.sh SOURCE FOLDER VERSION: makes the packages in FOLDER and installs them in a bare Debian 12 root, by bare_root.sh, which
# uses them there. Skipped by name if the root cannot be made.
set -euo pipefail
source=$1 folder=$2 version=$3
for tool in mmdebstrap lintian dpkg-shlibdeps file; do
  command -v $tool >/dev/null || { echo "skipped: $tool is not installed (Debian: mmdebstrap, lintian, dpkg-dev, file)"; exit 77; }
done
[ "$(id -u)" = 0 ] || { echo "skipped: only the user root can make a root"; exit 77; }

"$source/cmake/make_packages.sh" "$folder" "$(nproc)"
rm -rf "$folder/packages"
mkdir -p "$folder/packages"
cp "$folder"/*.deb "$source/packaging/bare_root.sh" "$source/app/testing/console_page.sh" "$source/library/use_library.sh" \
   "$source"/app/testing/two_squares.toml "$source"/app/testing/two_cubes.toml "$folder/packages"
# the shared library from the same objects
{
  cmake -B "$folder" -DVOUSSOIR_SHARED=ON && cmake --build "$folder" --parallel "$(nproc)" &&
    cmake --install "$folder" --prefix "$folder/packages/shared" && cmake -B "$folder" -DVOUSSOIR_SHARED=OFF
} >"$folder/shared.log" 2>&1 || { tail -n 20 "$folder/shared.log"; exit 1; }

# $1 is mmdebstrap's root
mmdebstrap --variant=minbase --mode=root --format=null --customize-hook="copy-in '$folder/packages' /" \
  --customize-hook="chroot \"\$1\" bash /packages/bare_root.sh $version" bookworm /dev/null
echo "packages of version $version work in a bare root"
