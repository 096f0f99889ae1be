# bare_root.sh VERSION, inside a bare Debian 12 root: installs the packages in its folder one after the other, each only with its
# dependencies, and uses them.
set -euo pipefail
version=$1
cd "$(dirname "$0")"
export DEBIAN_FRONTEND=noninteractive LC_ALL=C.UTF-8
install() { apt-get install --yes --no-install-recommends "$@" >/tmp/apt.log 2>&1 || { cat /tmp/apt.log; exit 1; }; }

echo "the program"
install ./voussoir_*.deb
[[ $(voussoir --version) == "voussoir $version "* ]]
for package in ./*.deb; do
  [ "$(dpkg-deb -f "$package" Version)" = "$version-1" ]
done
! ldd /usr/bin/voussoir | grep -E 'glpk|ipopt|gsl|gmp'  # nothing under the GPL or EPL
grep -q 'License: BSD-3-Clause' /usr/share/doc/voussoir/copyright
for page in examples examples/tutorial; do
  bash console_page.sh /usr/bin/voussoir "/usr/share/doc/voussoir/$page/README.md" "/tmp/$page"
done
. /usr/share/bash-completion/completions/voussoir
COMP_WORDS=(voussoir limit --load g) COMP_CWORD=3
_voussoir
[ "${COMPREPLY[*]}" = gravity ]

echo "the manual page"
install man-db
MANWIDTH=120 man --warnings voussoir >/tmp/manual 2>/tmp/warnings
[ ! -s /tmp/warnings ] || { cat /tmp/warnings; exit 1; }
grep -q "voussoir study gather" /tmp/manual
grep -q "voussoir $version" /tmp/manual

echo "the library"
install ./libvoussoir-dev_*.deb g++ pkg-config cmake make
[ "$(pkg-config --modversion voussoir)" = "$version" ]
g++ -std=c++20 -O2 /usr/share/doc/libvoussoir-dev/examples/sliding_block/main.cpp $(pkg-config --cflags --libs voussoir) -o /tmp/sliding_block
/tmp/sliding_block
export WITH_PLAIN_FLAGS=yes
consumer=/usr/share/doc/libvoussoir-dev/examples/library
./use_library.sh /usr /tmp/static g++ $consumer "$PWD/two_squares.toml" "$PWD/two_cubes.toml"

echo "the shared library"
./use_library.sh "$PWD/shared" /tmp/shared g++ $consumer "$PWD/two_squares.toml" "$PWD/two_cubes.toml"
ldd /tmp/shared/consumer/uses_voussoir | grep libvoussoir_core.so
cmp /tmp/static/bits.txt /tmp/shared/bits.txt

if compgen -G './python3-voussoir_*.deb' >/dev/null; then
  echo "the Python module"
  install ./python3-voussoir_*.deb
  (cd / && python3 -c "import voussoir; assert voussoir.__version__ == \"$version\", voussoir.__version__")
else
  echo "no Python module was built"
fi
