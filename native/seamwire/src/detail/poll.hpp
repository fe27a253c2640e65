// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <vector>

#include "seamwire/task.hpp"

namespace seamwire::detail {

/// A loop's looks at its task, one in some thousands of steps.
class Poll {
 public:
  /// Between two looks: well under a millisecond, where a step takes a tenth of a microsecond.
  static constexpr std::size_t kSteps = 4096;
  /// Where a step may take several microseconds.
  static constexpr std::size_t kFewSteps = 64;

  /// The loop takes about `total` steps, the part of the whole work from `begin` to `end`.
  Poll(const Task& task, double begin, double end, std::size_t total, std::size_t steps_between = kSteps)
      : task_(task),
        begin_(begin),
        length_(end - begin),
        total_(static_cast<double>(std::max<std::size_t>(total, 1))),
        mask_(steps_between - 1) {}
  /// Reports 0 all the time: for the beginning of work, or for a task whose progress only rises.
  explicit Poll(const Task& task, std::size_t steps_between = kSteps) : Poll(task, 0.0, 0.0, 1, steps_between) {}
  Poll(Task&& task, double begin, double end, std::size_t total, std::size_t steps_between = kSteps) = delete;
  explicit Poll(Task&& task, std::size_t steps_between = kSteps) = delete;

  /// At the beginning of each step, the first is 0. Throws Cancelled.
  void at(std::size_t step) const {
    if ((step & mask_) == 0) task_.check(begin_ + length_ * std::min(1.0, static_cast<double>(step) / total_));
  }
  /// The same for steps that are not numbered.
  void next() { at(steps_++); }

 private:
  const Task& task_;
  double begin_, length_, total_;
  std::size_t mask_;  // of a power of two
  std::size_t steps_ = 0;
};

/// std::ranges::sort() with looks at the task. If it stops the sort, the items are in no order, and some may be lost.
template <class T, class Order = std::ranges::less, class KeyOf = std::identity>
void polled_sort(std::vector<T>& items, Poll poll, const Order& order = {}, const KeyOf& key_of = {}) {
  std::ranges::sort(items, [&](const T& one, const T& other) {
    poll.next();
    return order(std::invoke(key_of, one), std::invoke(key_of, other));
  });
}

/// The task for a part of the work, which counts from 0 to 1 itself. `task` must outlive it.
inline Task part_of(const Task& task, double begin, double end) {
  if (!task.progress) return task;
  return {.stop = task.stop,
          .progress = [&task, begin, end](double fraction) { return task.progress(begin + (end - begin) * fraction); }};
}

Task part_of(Task&& task, double begin, double end) = delete;

/// A task for parts of work that count from 0 each: it reports the largest fraction so far. The task given must
/// outlive it.
class RisingProgress {
 public:
  explicit RisingProgress(Task&& task) = delete;
  explicit RisingProgress(const Task& task) : task_{.stop = task.stop, .progress = {}} {
    if (!task.progress) return;
    task_.progress = [this, &task](double fraction) { return task.progress(most_ = std::max(most_, fraction)); };
  }
  RisingProgress(const RisingProgress&) = delete;
  RisingProgress& operator=(const RisingProgress&) = delete;

  const Task& task() const { return task_; }

 private:
  Task task_;
  double most_ = 0.0;
};

/// The system hands out memory page by page when it is first written, some milliseconds for 16 MB; so, between looks at
/// the task, vector.resize(size).
template <class T>
void resize(std::vector<T>& vector, std::size_t size, const Task& task, double progress) {
  constexpr std::size_t kBytes = std::size_t{1} << 20;
  vector.reserve(size);
  while (vector.size() < size) {
    task.check(progress);
    vector.resize(std::min(size, vector.size() + std::max<std::size_t>(kBytes / sizeof(T), 1)));
  }
}

/// A copy made in the same way.
template <class T>
std::vector<T> copied(const std::vector<T>& from, const Task& task, double progress) {
  constexpr std::size_t kBytes = std::size_t{1} << 20;
  std::vector<T> copy;
  copy.reserve(from.size());
  while (copy.size() < from.size()) {
    task.check(progress);
    const auto next = from.begin() + static_cast<std::ptrdiff_t>(copy.size());
    const std::size_t count = std::min(from.size() - copy.size(), std::max<std::size_t>(kBytes / sizeof(T), 1));
    copy.insert(copy.end(), next, next + static_cast<std::ptrdiff_t>(count));
  }
  return copy;
}

}  // namespace seamwire::detail
