// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <optional>

namespace seamwire::detail {

/// Until when to wait; none: forever.
using Deadline = std::optional<std::chrono::steady_clock::time_point>;

/// Not a number, and what is negative, is now.
inline Deadline deadline_after(double seconds) {
  constexpr double kForever = 1e9;  // a longer time would overflow the clock
  if (seconds >= kForever) return std::nullopt;
  const std::chrono::duration<double> duration(std::max(0.0, seconds));
  return std::chrono::steady_clock::now() + std::chrono::ceil<std::chrono::steady_clock::duration>(duration);
}

/// Waits once, as condition_variable_any does: false where the deadline has passed.
template <class Lock>
bool wait_once(std::condition_variable_any& changed, Lock& lock, const Deadline& deadline) {
  if (deadline) return changed.wait_until(lock, *deadline) == std::cv_status::no_timeout;
  changed.wait(lock);
  return true;
}

}  // namespace seamwire::detail
