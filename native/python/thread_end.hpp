// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace seamwire::python {

/// Runs work(data). If that ends the thread, as pthread_exit does, ended() runs before any destructor or handler of the
/// frames around it. ended() must not return. Functions that work() calls must not have destructors or handlers,
/// because glibc may use another unwinder than the one that our frames are made for.
void run_to_thread_end(void (*work)(void* data), void* data, void (*ended)(void* nothing));

}  // namespace seamwire::python
