// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// Marks what the shared library seamwire exports: its interface, and the few internal functions that seamwire_uv
/// calls. Everything else is hidden. A static library defines SEAMWIRE_STATIC, and then the mark is empty.
#if defined(SEAMWIRE_STATIC)
#define SEAMWIRE_API
#elif !defined(_WIN32)
#define SEAMWIRE_API __attribute__((visibility("default")))
#elif defined(seamwire_EXPORTS)  // CMake defines this while it compiles the shared library
#define SEAMWIRE_API __declspec(dllexport)
#else
#define SEAMWIRE_API __declspec(dllimport)
#endif
