// SPDX-License-Identifier: GPL-3.0-or-later
// Compiled without exceptions: so what pthread.h offers to clean up is no destructor, which the unwinder would have to
// find, but a place that pthread_exit jumps to.
#include "thread_end.hpp"

#if __has_include(<pthread.h>) && !defined(_WIN32)
#include <pthread.h>
#endif

namespace seamwire::python {

void run_to_thread_end(void (*work)(void* data), void* data, void (*ended)(void* nothing)) {
#ifdef pthread_cleanup_push
  pthread_cleanup_push(ended, nullptr);
  work(data);
  pthread_cleanup_pop(0);
#else
  // Windows ends a thread where it is, and touches no frame.
  static_cast<void>(ended);
  work(data);
#endif
}

}  // namespace seamwire::python
