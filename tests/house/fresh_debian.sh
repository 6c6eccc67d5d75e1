#!/bin/sh
# The packages on a fresh Debian 12, as a new user would install them: apt, then the example room fitted and read from Python,
# then an outside project built against the libraries. Prints how many packages came along and the seconds of each step.
#   fresh_debian.sh FOLDER_WITH_DEBS | SOURCE [WORK_FOLDER]
# SOURCE, a clone of the repository: the packages are built first, on another fresh Debian 12. Both are the steps of
# apps/Dockerfile. PHOTOS, a folder that phone_office wrote, adds a new user's first hour. WHEEL, a wheel that make_wheel.py wrote, is
# installed alone on a third one, and goes from photos to luminaires there. SUITE=trixie takes Debian 13. Not a ctest: it needs root, the
# package debootstrap, a network and 4 GB (8 GB to build). CCACHE_DIR, where it is set, is lent to the build.
set -eu
given=$(realpath "$1")
here=$(dirname "$(realpath "$0")")
work=$(realpath -m "${2:-${TMPDIR:-/tmp}/fresh_debian}")
mkdir -p "$work"
suite=${SUITE:-bookworm}
root=
leave() { [ -z "$root" ] || for mounted in "$root/ccache" "$root/proc"; do ! mountpoint -q "$mounted" || umount "$mounted"; done; }
trap leave EXIT

# fresh NAME: a minimal system of that name to work in from then on.
fresh() {
  [ -d "$work/$suite" ] || debootstrap --variant=minbase "$suite" "$work/$suite" http://deb.debian.org/debian >"$work/log"
  leave
  root=
  rm -rf "${work:?}/$1"
  cp -a "$work/$suite" "$work/$1"
  root=$work/$1
  mount -t proc proc "$root/proc"
  : >"$work/log"
}
inside() {
  chroot "$root" /usr/bin/env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8 DEBIAN_FRONTEND=noninteractive \
    sh -eu -c "$1" >>"$work/log" 2>&1 || { tail -n 30 "$work/log" >&2; exit 1; }
}
said() { inside "$1" && tail -n "$2" "$work/log"; }
last=$(date +%s)
step() {
  now=$(date +%s)
  printf '%-60s %5d s\n' "$1" $((now - last))
  last=$now
}
count() { chroot "$root" dpkg-query -f . -W | wc -c; }

debs=$given
if [ -e "$given/CMakeLists.txt" ]; then
  fresh build
  mkdir -p "$root$given" "$root/ccache"
  git -C "$given" archive HEAD | tar -x -C "$root$given"
  [ -z "${CCACHE_DIR:-}" ] || mount --bind "$CCACHE_DIR" "$root/ccache"
  last=$(date +%s)
  inside "cd $given && .ci/setup.sh \$(cat .ci/packages.txt) dpkg-dev file pybind11-dev python3-dev"
  step 'build: .ci/setup.sh'
  inside "cd $given && export CCACHE_DIR=/ccache && cmake --preset package && cmake --build build/package && cpack --preset deb"
  step 'build: configured, compiled, packed'
  debs=$root$given/build/package
fi

rm -rf "$work/debs"
mkdir "$work/debs"
cp "$debs"/luxfit_*.deb "$debs"/libluxfit-dev_*.deb "$work/debs"
fresh trial
cp -r "$work/debs" "$here/consumer" "$root/root"
before=$(count) start=$(date +%s) last=$(date +%s)
inside 'apt-get -q update'
step 'apt-get update'
inside 'apt-get -q install -y --no-install-recommends /root/debs/luxfit_*.deb'
step 'apt-get install ./luxfit_*.deb without recommendations'
without=$(count)
inside 'cp -r /usr/share/luxfit/office /root/ && luxfit run /root/office/session.toml -o /root/out'
step 'luxfit run'
printf 'from the .deb to the result: %d s, %d packages came along\n' $((last - start)) $((without - before - 1))
said 'luxfit check /root/out' 3
if [ -n "${PHOTOS:-}" ]; then
  cp -r "$PHOTOS" "$root/root/photos"
  cp "$here/first_hour.sh" "$root/root"
  last=$(date +%s)
  said '/root/first_hour.sh /usr/share/luxfit /root/photos' 7
  step 'from photos of a phone to the report'
fi
said '/usr/bin/python3 -c "import luxfit; print(luxfit.read_result(\"/root/out\"), luxfit.__version__)"' 1
last=$(date +%s)
inside 'apt-get -q install -y colmap'
step 'apt-get install colmap (recommended)'
inside 'luxfit run /root/office/session.toml -o /root/out_colmap'
step 'luxfit run, with COLMAP for views without tags'
printf 'with recommendations: %d packages came along\n' $(($(count) - before - 1))
last=$(date +%s)
inside 'apt-get -q install -y --no-install-recommends /root/debs/libluxfit-dev_*.deb g++ cmake ninja-build'
# shellcheck disable=SC2016
inside 'cmake -S /root/consumer -B /root/build -G Ninja && cmake --build /root/build && for c in /root/build/consumer_*; do $c; done'
step 'find_package(luxfit) from libluxfit-dev'
if [ -n "${WHEEL:-}" ]; then
  fresh wheel
  mkdir -p "$root/root/fixtures" "$root/root/apps/python"
  cp "$WHEEL" "$here/../apps/python/fit_room_test.py" "$root/root"
  cp -r "$here/../../fixtures/office" "$root/root/fixtures"
  cp "$here/../../apps/python/from_photos.py" "$root/root/apps/python"
  start=$(date +%s) last=$start
  inside 'apt-get -q update && apt-get -q install -y --no-install-recommends python3-venv python3-numpy'
  step 'apt-get install python3-venv python3-numpy'
  inside 'python3 -m venv --system-site-packages /root/venv && /root/venv/bin/pip install -q --no-index /root/luxfit-*.whl'
  step 'pip install of the wheel'
  inside 'LUXFIT_FIXTURES=/root/fixtures /root/venv/bin/python -B /root/fit_room_test.py FromPhotos'
  step 'luxfit.fit_room, from photos'
  printf 'from the wheel to luminaires: %d s\n' $((last - start))
fi
