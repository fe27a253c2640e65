// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace seamwire::python {

/// Runs work(data). Should that end the thread, as pthread_exit does, then ended() runs in its place, before any
/// destructor or handler of the frames around, and must not return. The functions that work() calls must have none of
/// these themselves: glibc unwinds with the unwinder it finds, which need not be the one that our frames are made for.
void run_to_thread_end(void (*work)(void* data), void* data, void (*ended)(void* nothing));

}  // namespace seamwire::python
