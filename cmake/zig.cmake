# SPDX-License-Identifier: GPL-3.0-or-later
# A toolchain for wheels that run where Blender does, made on Linux for all systems. The compiler is zig's clang with its libc++ linked in,
# as PyPI's package ziglang brings it. scripts/package uses it.
#
# SEAMWIRE_PLATFORM: the system to build for, as Blender names it. SEAMWIRE_ZIG: the zig program.

set(SEAMWIRE_PLATFORM "linux-x64" CACHE STRING "The system to build for, as Blender names it")
set(SEAMWIRE_ZIG "zig" CACHE FILEPATH "The zig program")
# CMake's trial builds read this file afresh, without the cache.
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES SEAMWIRE_PLATFORM SEAMWIRE_ZIG)

# -s leaves out symbols, and the debug information that takes a quarter of the compiler's time. Trial builds have the same options, because
# zig needs a minute to make its C++ library for each combination of them.
set(CMAKE_CXX_FLAGS_INIT "-O3 -s")
if(SEAMWIRE_PLATFORM MATCHES "-x64$")
  set(CMAKE_SYSTEM_PROCESSOR x86_64)
  string(APPEND CMAKE_CXX_FLAGS_INIT " -mcpu=x86_64_v2") # any x86-64 CPU with SSE4.2
else()
  set(CMAKE_SYSTEM_PROCESSOR aarch64)
endif()
if(SEAMWIRE_PLATFORM MATCHES "^linux-(x64|arm64)$")
  set(CMAKE_SYSTEM_NAME Linux)
  set(system linux-gnu.2.28) # what blender.org's Blender asks for
elseif(SEAMWIRE_PLATFORM STREQUAL "windows-x64")
  set(CMAKE_SYSTEM_NAME Windows)
  set(system windows-gnu)
elseif(SEAMWIRE_PLATFORM MATCHES "^macos-(x64|arm64)$")
  set(CMAKE_SYSTEM_NAME Darwin)
  set(system macos.11.0)
  set(CMAKE_USER_MAKE_RULES_OVERRIDE_CXX "${CMAKE_CURRENT_LIST_DIR}/zig-macos.cmake")
else()
  message(FATAL_ERROR "SEAMWIRE_PLATFORM: ${SEAMWIRE_PLATFORM} is none that wheels are built for")
endif()

set(CMAKE_CXX_COMPILER "${SEAMWIRE_ZIG}" "c++")
set(CMAKE_CXX_COMPILER_LAUNCHER "${CMAKE_CURRENT_LIST_DIR}/zig-compile")
set(CMAKE_CXX_COMPILER_TARGET "${CMAKE_SYSTEM_PROCESSOR}-${system}")
set(CMAKE_STRIP "" CACHE FILEPATH "Not needed" FORCE)
# The archiver of this machine knows its own object files only.
set(CMAKE_CXX_ARCHIVE_CREATE "\"${SEAMWIRE_ZIG}\" ar qc <TARGET> <OBJECTS>")
set(CMAKE_CXX_ARCHIVE_APPEND "\"${SEAMWIRE_ZIG}\" ar q <TARGET> <OBJECTS>")
set(CMAKE_CXX_ARCHIVE_FINISH "\"${SEAMWIRE_ZIG}\" ranlib <TARGET>")
