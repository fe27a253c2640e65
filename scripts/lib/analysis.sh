# SPDX-License-Identifier: GPL-3.0-or-later
# shellcheck shell=bash
# What reads the code and runs nothing of it; to be sourced after common.sh by scripts/test, which has `check`.

CLANG=clang++-14

format_check() { git ls-files -z '*.cpp' '*.hpp' | xargs -0 "$VENV/bin/clang-format" --dry-run --Werror; }

stage_lint() {
  local result=0
  check lint clang-format format_check || result=1
  check lint ruff "$VENV/bin/ruff" check . || result=1
  check lint ruff-format "$VENV/bin/ruff" format --check . || result=1
  return $result
}

# tidy PATHSPEC...: clang-tidy on the files that git knows.
tidy() {
  git ls-files -z "$@" |
    xargs -0 -n 1 -P "$(nproc)" "$VENV/bin/clang-tidy" -p build/tidy --quiet --warnings-as-errors='*' "${tidy_options[@]}" 2>/dev/null
}

# The build folder tells clang-tidy how each file is compiled; nothing is built there.
tidy_check() {
  local result=0 tidy_options=()
  cmake -S . -B build/tidy -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_INTERPROCEDURAL_OPTIMIZATION=OFF \
    -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON -DSEAMWIRE_BENCHMARKS=ON -DSEAMWIRE_PYTHON=ON \
    -DPython_EXECUTABLE="$VENV/bin/python" -Dpybind11_DIR="$("$VENV/bin/python" -m pybind11 --cmakedir)" \
    >build/configure-tidy.log || { cat build/configure-tidy.log; return 1; }
  tidy 'native/*.cpp' ':!native/tests' ':!native/python' ':!native/bench' ':!native/examples' || result=1
  # Bytes there are numbers from NumPy, not characters; the module's own function uses the namespace of its parts.
  tidy_options=(--checks=-bugprone-signed-char-misuse,-google-build-using-namespace,-performance-unnecessary-value-param)
  tidy native/python/*.cpp || result=1
  # The analyzer takes two thirds of the time, a minute per test file, and the tests run under sanitizers.
  tidy_options=('--checks=-clang-analyzer-*')
  tidy 'native/tests/*.cpp' || result=1
  # In the benchmarks the analyzer complains about OpenMesh's and Google Benchmark's headers only. Benchmarks that need other libraries are left out.
  tidy_options=('--checks=-clang-analyzer-*,-google-build-using-namespace')
  tidy native/bench/*.cpp 'native/examples/*.cpp' ':!native/bench/cgal_*.cpp' ':!native/bench/lengths_bench.cpp' \
    ':!native/bench/linear_solvers_bench.cpp' ':!native/bench/nearest_vertices_bench.cpp' || result=1
  return $result
}

# Each kernel is one loop, to be vectorized for SSE (16 bytes) and for AVX2 (32), by GCC and by Clang. GCC may count a loop twice, for
# what is left over after the last whole vector.
vectorized_kernels() {
  local kernels result=0 loops width count compile
  [ "$(uname -m)" = x86_64 ] || { say "Kernels: checked on x86-64 only"; return; }
  for kernels in native/seamwire/src/geodesics/window_kernels.cpp native/seamwire_uv/src/maps/dirichlet_kernels.cpp; do
    compile=(-std=c++20 -O3 -march=x86-64-v2 -ffp-contract=off -fno-math-errno -fno-trapping-math -Inative/seamwire/include -Inative/seamwire/src -Inative/seamwire_uv/include -Inative/seamwire_uv/src
      -c "$kernels" -o /dev/null)
    loops=$(grep -c '^  SEAMWIRE_VECTORIZE$' "$kernels")
    "$CLANG" "${compile[@]}" -Werror=pass-failed || result=1
    for width in 16 32; do
      count=$(g++ "${compile[@]}" -fopt-info-vec-optimized 2>&1 | grep "loop vectorized using $width byte vectors" | sort -u | wc -l)
      [ "$count" -eq "$loops" ] || { echo "GCC vectorizes $count of the $loops loops of $kernels with $width bytes"; result=1; }
    done
  done
  return $result
}

# The library as Debian's users build it: static, with the installed OpenMesh, found and linked by another project.
debian_openmesh() {
  cmake -S . -B build/debian -G Ninja -DCMAKE_BUILD_TYPE=Release -DBUILD_SHARED_LIBS=OFF >build/configure-debian.log || { cat build/configure-debian.log; return 1; }
  cmake --build build/debian --target seamwire_uv --parallel "$(nproc)" || return 1
  ctest --test-dir build/debian --no-tests=error --output-on-failure -R '^install\.'
}

stage_analysis() {
  local result=0
  check analysis thread-safety scripts/lib/thread_safety || result=1
  check analysis other-systems scripts/lib/read_for_macos || result=1
  check analysis clang-tidy tidy_check || result=1
  check analysis vectorized-kernels vectorized_kernels || result=1
  check analysis debian-openmesh debian_openmesh || result=1
  check analysis api-docs scripts/docs --ready || result=1
  return $result
}
