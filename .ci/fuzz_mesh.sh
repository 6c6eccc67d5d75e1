#!/bin/sh
# Fuzzes the mesh readers with clang's libFuzzer under address and undefined-behaviour sanitizers.
#   .ci/fuzz_mesh.sh [SECONDS]
set -eu
cd "$(dirname "$0")/.."
seconds=${1:-60}
build=build/fuzz_mesh
mkdir -p "$build/corpus" "$build/seeds"
clang++ -std=c++17 -O1 -g -fsanitize=fuzzer,address,undefined -fno-sanitize-recover=undefined -I. \
  -isystem /usr/include/eigen3 tests/fuzz/mesh_fuzz.cc \
  forward/mesh_file.cc forward/mesh_check.cc forward/overlaps.cc forward/scene.cc forward/patches.cc forward/visibility.cc \
  forward/internal/obj_mesh.cc forward/internal/ply_mesh.cc forward/internal/gltf_mesh.cc \
  forward/internal/mesh_topology.cc forward/internal/shell_volume.cc \
  -lembree3 -lassimp -ltbb -o "$build/mesh_fuzz"
# The first byte chooses the format: 0 is OBJ, 1 PLY.
for obj in fixtures/*/*.obj; do
  { printf '\000'; cat "$obj"; } > "$build/seeds/$(basename "$(dirname "$obj")").obj"
done
printf '\001ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n3 0 0\n3 2 0\n0 2 0\n4 0 1 2 3\n' \
  > "$build/seeds/quad.ply"
# Leaks are those of Embree's and TBB's own threads.
ASAN_OPTIONS=detect_leaks=0 "$build/mesh_fuzz" -max_total_time="$seconds" -max_len=8192 -timeout=10 -rss_limit_mb=2048 \
  -artifact_prefix="$build/" -print_final_stats=1 "$build/corpus" "$build/seeds"
