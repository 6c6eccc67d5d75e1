#!/bin/sh
# The packages on a fresh Debian 12, as a new user would install them: apt, then the example room fitted and read from Python,
# then an outside project built against the libraries. Prints how many packages came along and the seconds of each step.
#   fresh_debian.sh FOLDER_WITH_DEBS [WORK_FOLDER]
# Not a ctest: it needs root, the package debootstrap, a network and 4 GB. These are the commands of apps/Dockerfile.
set -eu
debs=$(realpath "$1")
here=$(dirname "$(realpath "$0")")
work=$(realpath -m "${2:-${TMPDIR:-/tmp}/fresh_debian}")
mkdir -p "$work"
[ -d "$work/bookworm" ] || debootstrap --variant=minbase bookworm "$work/bookworm" http://deb.debian.org/debian
rm -rf "$work/trial"
cp -a "$work/bookworm" "$work/trial"
mount -t proc proc "$work/trial/proc"
trap 'umount "$work/trial/proc"' EXIT
mkdir "$work/trial/root/debs"
cp "$debs"/luxfit_*.deb "$debs"/libluxfit-dev_*.deb "$work/trial/root/debs"
cp -r "$here/consumer" "$work/trial/root"

inside() { chroot "$work/trial" /usr/bin/env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8 sh -eu -c "$1"; }
start=$(date +%s) last=$(date +%s)
step() {
  now=$(date +%s)
  printf '%-52s %4d s\n' "$1" $((now - last))
  last=$now
}
count() { inside 'dpkg-query -f . -W | wc -c'; }

before=$(count)
inside 'apt-get -q update' >"$work/log" 2>&1
step 'apt-get update'
inside 'apt-get -q install -y --no-install-recommends /root/debs/luxfit_*.deb' >>"$work/log" 2>&1
step 'apt-get install ./luxfit_*.deb without recommendations'
without=$(count)
inside 'cp -r /usr/share/luxfit/office /root/ && luxfit run /root/office/session.toml -o /root/out' >>"$work/log" 2>&1
step 'luxfit run'
printf 'from the .deb to the result: %d s, %d packages came along\n' $((last - start)) $((without - before - 1))
inside 'luxfit check /root/out | tail -n 3'
inside '/usr/bin/python3 -c "import luxfit; print(luxfit.read_result(\"/root/out\"), luxfit.__version__)"'
inside 'apt-get -q install -y colmap' >>"$work/log" 2>&1
step 'apt-get install colmap (recommended)'
inside 'luxfit run /root/office/session.toml -o /root/out_colmap' >>"$work/log" 2>&1
step 'luxfit run, with COLMAP for views without tags'
printf 'with recommendations: %d packages came along\n' $(($(count) - before - 1))
inside 'apt-get -q install -y --no-install-recommends /root/debs/libluxfit-dev_*.deb g++ cmake ninja-build' >>"$work/log" 2>&1
inside 'cmake -S /root/consumer -B /root/build -G Ninja && cmake --build /root/build && for c in /root/build/consumer_*; do $c; done' >>"$work/log" 2>&1
step 'find_package(luxfit) from libluxfit-dev'
