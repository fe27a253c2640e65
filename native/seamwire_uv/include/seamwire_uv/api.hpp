// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// Marks what the shared library seamwire_uv exports, as SEAMWIRE_API does for seamwire.
#if defined(SEAMWIRE_STATIC)
#define SEAMWIRE_UV_API
#elif !defined(_WIN32)
#define SEAMWIRE_UV_API __attribute__((visibility("default")))
#elif defined(seamwire_uv_EXPORTS)  // CMake defines this while it compiles the shared library
#define SEAMWIRE_UV_API __declspec(dllexport)
#else
#define SEAMWIRE_UV_API __declspec(dllimport)
#endif
