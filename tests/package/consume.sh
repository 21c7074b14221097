#!/usr/bin/env bash
# consume.sh SOURCE BUILD C-COMPILER VERSION
set -euo pipefail
source=$1 build=$2 compiler=$3 version=$4
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

cmake --install "$build" --prefix "$work/prefix" >/dev/null
library=$(dirname "$(find "$work/prefix" -name libperegrine.so)")
export LD_LIBRARY_PATH=$library

mkdir "$work/consumer"
awk '/^```c$/ { on = 1; next } /^```$/ { on = 0 } on' "$source/README.md" >"$work/consumer/example.c"
grep -q rt_render_frame "$work/consumer/example.c"

cat >"$work/consumer/CMakeLists.txt" <<END
cmake_minimum_required(VERSION 3.25)
project(consumer C)
find_package(peregrine ${version%.*} REQUIRED)
add_executable(example example.c)
target_link_libraries(example PRIVATE peregrine::peregrine)
END
cmake -G Ninja -S "$work/consumer" -B "$work/consumer/build" -DCMAKE_PREFIX_PATH="$work/prefix" \
    -DCMAKE_C_COMPILER="$compiler" >/dev/null
cmake --build "$work/consumer/build" >/dev/null
"$work/consumer/build/example" | tee "$work/by_cmake"
grep -q '^the floor is 3 m below, triangle 0$' "$work/by_cmake" ||
    { echo "the example gave another answer"; exit 1; }
grep -q '^the middle of the picture is 0 0 0$' "$work/by_cmake" &&
    { echo "the example renders a black picture"; exit 1; }

export PKG_CONFIG_PATH=$library/pkgconfig
# shellcheck disable=SC2046
"$compiler" -std=c11 -pedantic -Wall -Wextra -Werror "$work/consumer/example.c" \
    -o "$work/by_pkg_config" $(pkg-config --cflags --libs peregrine)
"$work/by_pkg_config" | cmp - "$work/by_cmake"
