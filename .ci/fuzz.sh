#!/bin/sh
# Fuzzes the readers of photometric files, meshes, cameras, tables, tag maps, sessions and areas of a report, and the writer of JSON, over the
# fixtures, each for some seconds; nothing of the repository is changed.
#   .ci/fuzz.sh [SECONDS]        default 20
# What breaks a reader is left in the folder that is named at the end.
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
seconds=${1:-20}
"$root/.ci/setup.sh" clang libclang-rt-14-dev libeigen3-dev libembree-dev libtbb-dev \
  nlohmann-json3-dev libopencv-dev libmrcal-dev libyaml-cpp-dev libfmt-dev libtomlplusplus-dev libxxhash-dev libapriltag-dev pkg-config cmake ninja-build
work=$(mktemp -d)
cmake -S "$root/tests/fuzz" -B "$work/build" -G Ninja -D CMAKE_CXX_COMPILER=clang++ >"$work/log"
cmake --build "$work/build" --target ies_fuzz ldt_fuzz mesh_fuzz gltf_fuzz camera_fuzz table_fuzz session_fuzz >>"$work/log" || { cat "$work/log"; exit 1; }

mkdir "$work/ies" "$work/ldt" "$work/mesh"
name_of() { cksum <"$1" | cut -d ' ' -f 1; }
for kind in ies ldt; do
  find "$root/fixtures" "$root/tests/fuzz/photometry_seeds" -name "*.$kind" -size -64k | while read -r file; do
    cp "$file" "$work/$kind/$(name_of "$file").$kind"
  done
done
# The first byte of a mesh chooses its format: 0 is OBJ, 1 PLY.
for obj in "$root"/fixtures/*/*.obj "$root"/fixtures/*/*/*.obj; do
  { printf '\000'; cat "$obj"; } >"$work/mesh/$(name_of "$obj").obj"
done
cat >"$work/quad.ply" <<'PLY'
ply
format ascii 1.0
element vertex 4
property float x
property float y
property float z
element face 1
property list uchar int vertex_indices
end_header
0 0 0
3 0 0
3 2 0
0 2 0
4 0 1 2 3
PLY
{ printf '\001'; cat "$work/quad.ply"; } >"$work/mesh/quad.ply"

cp -r "$root/tests/fuzz/seeds" "$work/gltf"
cp -r "$root/tests/fuzz/camera_seeds" "$work/camera"

# The first byte chooses the reader: 0 is a table, 1 a tag map.
mkdir "$work/table"
{ printf '\000id,x_m,lux\nL1,1.2,257.6\n"a, b",3,\n'; } >"$work/table/table"
{ printf '\001'; cat "$root/fixtures/office/tags.json"; } >"$work/table/tags"

# 0 is a session, 1 the areas of a report, 2 OpenCV's camera file, 3 texts of a JSON artifact. A session names the files that the target writes.
mkdir "$work/session"
{ printf '\000'; cat "$root/tests/fuzz/session_seeds/session.toml"; } >"$work/session/session"
{ printf '\001'; cat "$root/tests/fuzz/session_seeds/targets.toml"; } >"$work/session/targets"
{ printf '\002'; cat "$root/fixtures/office/cam0.yaml"; } >"$work/session/camera"
printf '\003M\374ller\355\240\200/\303\244.png' >"$work/session/names"

# fuzz KIND MAX_BYTES MAX_MB [OPTION ...]
fuzz() {
  kind=$1 max_bytes=$2 max_mb=$3
  shift 3
  if ! (cd "$work" && "build/${kind}_fuzz" -max_total_time="$seconds" -max_len="$max_bytes" -rss_limit_mb="$max_mb" \
    -timeout=10 -print_final_stats=1 "$@" "$kind" >"$kind.log" 2>&1); then
    tail -n 60 "$work/$kind.log"
    echo "$kind: broken; the input is in $work" >&2
    exit 1
  fi
  grep -E 'number_of_executed_units|peak_rss_mb' "$work/$kind.log" | sed "s/^stat::/$kind: /"
}
# Two at a time.
both() {
  fuzz $1 &
  first=$!
  fuzz $2
  wait "$first"
}
both "ies 65536 512" "ldt 65536 512"
# What Embree's and TBB's own threads keep is no leak of the readers.
ASAN_OPTIONS=detect_leaks=0
export ASAN_OPTIONS
both "mesh 8192 2048" "camera 2048 1024"
both "table 4096 1024" "session 4096 1024"
fuzz gltf 4096 2048 -dict="$root/tests/fuzz/gltf.dict"
rm -r "$work"
