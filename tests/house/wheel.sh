#!/bin/sh
# Makes the wheel of a built Python module, installs it into a fresh virtual environment and goes from photos to luminaires there, by the
# libraries that the wheel brings. numpy is the system's: tests take nothing from the network.
#   wheel.sh SOURCE MODULE PYTHON VERSION
set -eu
source=$1 python=$3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "$1" >&2; exit 1; }
unset PYTHONPATH LD_LIBRARY_PATH
wheel=$("$python" -B "$source/apps/python/make_wheel.py" "$2" "$source/apps/python/luxfit.pyi" "$4" "$source/LICENSE" "$work")
echo "$(basename "$wheel"): $(($(stat -c %s "$wheel") / 1000000)) MB"
"$python" -m venv --system-site-packages "$work/venv"
"$work/venv/bin/pip" install --quiet --no-index --disable-pip-version-check "$wheel"
[ "$("$work/venv/bin/pip" list --disable-pip-version-check | awk '$1 == "luxfit" { print $2 }')" = "$4" ] || fail "pip does not list luxfit $4"
cd "$work"
"$work/venv/bin/python" - "$work/venv" <<'END'
import os
import pathlib
import sys

import numpy  # its libraries are the system's
before = {line.split()[-1] for line in open("/proc/self/maps")}
import luxfit

assert luxfit.__file__.startswith(sys.argv[1]), luxfit.__file__
mapped = {line.split()[-1] for line in open("/proc/self/maps")} - before
libraries = {path for path in mapped if ".so" in path and not path.startswith(sys.argv[1])}
system = ("ld-linux", "libc.", "libm.", "libdl.", "librt.", "libpthread.", "libresolv.", "libstdc++.", "libgcc_s.")
others = sorted(path for path in libraries if not os.path.basename(path).startswith(system))
assert not others, f"the module takes libraries of the system: {others}"
site = pathlib.Path(luxfit.__file__).parent
assert (site / "luxfit-stubs" / "__init__.pyi").exists(), "no types"
licenses = list(site.glob("luxfit-*.dist-info/licenses/*.txt"))
assert {"luxfit.txt"} < {path.name for path in licenses}, licenses
END
# Photos to luminaires, against the truth.
LUXFIT_FIXTURES=$source/fixtures "$work/venv/bin/python" -B "$source/tests/apps/python/fit_room_test.py" FromPhotos
