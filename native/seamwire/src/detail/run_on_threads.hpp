// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>

#include "seamwire/api.hpp"
#include "seamwire/task.hpp"

namespace seamwire::detail {

/// Calls work(i, task) for each i below `count` on as many threads as there are cores, eight at most. Meanwhile the
/// calling thread reports fraction(number of finished calls) to `task`, and stops the work if the caller cancels. Once
/// all threads have ended, it rethrows the first exception that was thrown on one of them.
///
/// Work that calls this function itself does that part alone, because the cores are busy.
SEAMWIRE_API void run_on_threads(std::size_t count, const Task& task,
                                 const std::function<double(std::size_t)>& fraction,
                                 const std::function<void(std::size_t, const Task&)>& work);

}  // namespace seamwire::detail
