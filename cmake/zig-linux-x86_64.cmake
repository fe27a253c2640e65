# SPDX-License-Identifier: GPL-3.0-or-later
# A toolchain for Linux wheels that run where blender.org's Blender does: glibc 2.28, any x86-64 CPU with SSE4.2. The
# compiler is zig's clang with its libc++ linked in, as PyPI's package ziglang brings it.
#
# SEAMWIRE_ZIG: the zig program. SEAMWIRE_GLIBC: the oldest glibc to run on.

set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR x86_64)

set(SEAMWIRE_ZIG "zig" CACHE FILEPATH "The zig program")
set(SEAMWIRE_GLIBC "2.28" CACHE STRING "The oldest glibc to run on")
# CMake's trial builds read this file afresh, without the cache.
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES SEAMWIRE_ZIG SEAMWIRE_GLIBC)

set(CMAKE_CXX_COMPILER "${SEAMWIRE_ZIG}" "c++")
set(CMAKE_CXX_COMPILER_TARGET "x86_64-linux-gnu.${SEAMWIRE_GLIBC}")
set(CMAKE_CXX_FLAGS_INIT "-mcpu=x86_64_v2")
# The module is to be small: no symbols beyond what Python looks up.
set(CMAKE_MODULE_LINKER_FLAGS_INIT "-s")

set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
