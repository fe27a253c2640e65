// SPDX-License-Identifier: GPL-3.0-or-later
// This file is compiled without exceptions. Then pthread_cleanup_push creates a place that pthread_exit jumps to, and
// not a destructor, which the unwinder would have to find.
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
  // Windows ends a thread where it is, without unwinding.
  static_cast<void>(ended);
  work(data);
#endif
}

}  // namespace seamwire::python
