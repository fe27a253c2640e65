# SPDX-License-Identifier: GPL-3.0-or-later
# A toolchain for Linux wheels that run where blender.org's Blender does: glibc 2.28, any x86-64 CPU with SSE4.2. The
# compiler is zig's clang with its libc++ linked in, as PyPI's package ziglang brings it. scripts/package uses it.
#
# SEAMWIRE_ZIG: the zig program. SEAMWIRE_PYTHON_INCLUDE: the folder of Python.h of the Python to build for, which need not
# run here. SEAMWIRE_PYTHON_SUFFIX: what that Python's modules end with.

set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR x86_64)

set(SEAMWIRE_ZIG "zig" CACHE FILEPATH "The zig program")
# CMake's trial builds read this file afresh, without the cache.
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES SEAMWIRE_ZIG)

set(CMAKE_CXX_COMPILER "${SEAMWIRE_ZIG}" "c++")
set(CMAKE_CXX_COMPILER_TARGET "x86_64-linux-gnu.2.28")
set(CMAKE_CXX_FLAGS_INIT "-mcpu=x86_64_v2")
set(CMAKE_MODULE_LINKER_FLAGS_INIT "-s") # no symbols beyond those that Python looks up

# The wheel's Python, not the one that runs the build.
if(DEFINED SEAMWIRE_PYTHON_INCLUDE)
  set(Python_INCLUDE_DIR "${SEAMWIRE_PYTHON_INCLUDE}" CACHE PATH "Headers of the Python to build for" FORCE)
  set(PYBIND11_USE_CROSSCOMPILING ON)
  set(PYTHON_MODULE_EXTENSION "${SEAMWIRE_PYTHON_SUFFIX}")
  set(PYTHON_MODULE_DEBUG_POSTFIX "")
  set(PYTHON_IS_DEBUG FALSE)
endif()
