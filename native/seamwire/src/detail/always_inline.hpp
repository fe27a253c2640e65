// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// For functions of inner loops that must become part of their caller: they take on its instruction set, and the
/// compiler keeps more in registers.
#if defined(__GNUC__)
#define SEAMWIRE_INLINE [[gnu::always_inline]] inline
#else
#define SEAMWIRE_INLINE inline
#endif
