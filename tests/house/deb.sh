#!/bin/sh
# Makes the Debian packages of a build, looks into them and runs the program, unpacked, on the example room.
#   deb.sh SOURCE BUILD
# fresh_debian.sh installs them on a system where nothing else is.
set -eu
source=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "$1" >&2; exit 1; }
cpack -G DEB --config "$2/CPackConfig.cmake" -B "$work" >"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
program=$(ls "$work"/luxfit_*.deb) dev=$(ls "$work"/libluxfit-dev_*.deb)

dpkg-deb -c "$program" | awk '{print $6}' >"$work/files"
dpkg-deb -c "$dev" | awk '{print $6}' >"$work/dev_files"
for file in usr/bin/luxfit usr/share/doc/luxfit/copyright usr/share/doc/luxfit/changelog.gz usr/share/doc/luxfit/CHANGELOG.md.gz \
  usr/share/doc/luxfit/docs/session-format.md usr/share/doc/luxfit/docs/tutorial.md usr/share/doc/luxfit/examples/example.py \
  usr/share/luxfit/office/session.toml usr/share/luxfit/schema/result.schema.json; do
  grep -qx "./$file" "$work/files" || fail "luxfit: no $file"
done
if grep -q '^LUXFIT_PYTHON:BOOL=ON' "$2/CMakeCache.txt" && [ -e "$2/apps/python" ]; then
  grep -q '^./usr/lib/python3/dist-packages/luxfit\.' "$work/files" || fail "luxfit: no Python module"
  grep -qx './usr/lib/python3/dist-packages/luxfit-stubs/__init__.pyi' "$work/files" || fail "luxfit: no types of the Python module"
fi
grep -qE '\.(h|a|cmake)$' "$work/files" && fail "luxfit: holds what belongs to libluxfit-dev"
for name in calib forward inverse; do
  grep -q "/libluxfit_$name\.a$" "$work/dev_files" || fail "libluxfit-dev: no library luxfit_$name"
  grep -q "/include/luxfit/$name/.*\.h$" "$work/dev_files" || fail "libluxfit-dev: no headers of $name"
done
grep -q '/luxfitConfig.cmake$' "$work/dev_files" || fail "libluxfit-dev: no CMake configuration"
grep -qE '/(bin|luxfit_apps)' "$work/dev_files" && fail "libluxfit-dev: holds what belongs to luxfit"
dpkg-deb -f "$program" Recommends | grep -qw colmap || fail "luxfit: does not recommend colmap"
dpkg-deb -f "$program" Depends | grep -q 'libopencv-core.*libstdc++6' || fail "luxfit: dependencies are not those of its libraries"

# What luxfitConfig.cmake finds on this machine has to come along with libluxfit-dev.
dpkg-deb -x "$dev" "$work/dev"
cmake -S "$source/tests/house/consumer" -B "$work/consumer" -G Ninja -DCMAKE_PREFIX_PATH="$work/dev/usr" >"$work/log" 2>&1 ||
  { cat "$work/log"; exit 1; }
# shellcheck disable=SC2046
apt-cache depends --recurse --installed --no-recommends --no-suggests --no-conflicts --no-breaks --no-replaces --no-enhances \
  $(dpkg-deb -f "$dev" Depends | sed 's/([^)]*)//g' | tr ',' ' ') | grep '^[a-z0-9]' | sort -u >"$work/come_along"
sed -nE 's#^[^:]+:[A-Z]*PATH=(/usr/(lib|include|share)/.+)$#\1#p' "$work/consumer/CMakeCache.txt" | while read -r path; do
  # Debian's records know some libraries by their place before /lib was merged into /usr.
  real=$(realpath "$path")
  { dpkg -S "$path" || dpkg -S "$real" || dpkg -S "${real#/usr}"; } 2>/dev/null | sed 's/: .*//' | tr ',' '\n' | sed 's/^ *//; s/:[a-z0-9]*$//' >"$work/owners"
  grep -qxF -f "$work/owners" "$work/come_along" || fail "libluxfit-dev: $path, of $(head -n 1 "$work/owners"), does not come along"
done
if command -v lintian >/dev/null; then
  lintian --fail-on error "$program" "$dev" 2>"$work/lintian" || { cat "$work/lintian" >&2; fail "lintian found errors"; }
fi

dpkg-deb -x "$program" "$work/root"
luxfit=$work/root/usr/bin/luxfit
[ "$($luxfit --version)" = "$(dpkg-deb -f "$program" Version)" ] || fail "program and package differ in version"
"$luxfit" run "$work/root/usr/share/luxfit/office/session.toml" -o "$work/out"
percent=$("$luxfit" check "$work/out" --json | sed -n 's/.*"mean_abs_error_percent": *\([0-9.]*\),.*/\1/p' | tail -n 1)
echo "mean error of the luxmeter readings: $percent %"
awk -v percent="$percent" 'BEGIN { exit !(percent > 0 && percent < 2) }' || fail "expected less than 2 %"
