// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace seamwire::detail {

/// A priority queue for searches in which no key is less than those already taken out. It has buckets of equal width,
/// after Dial, "Algorithm 360: Shortest-path forest with topological ordering" (1969).
///
/// If every step into a state costs more than a bucket's width, the state cannot get better once its bucket is the
/// lowest. Such states come out of that bucket in any order (Goldberg, "A simple shortest path algorithm with linear
/// average time", 2001: the caliber). The few others of the lowest bucket are in a heap, and come out last. Keys beyond
/// the last bucket wait in a list. The order depends on the calls alone.
class BucketQueue {
 public:
  struct Entry {
    double key;
    std::int32_t state;
    bool in_order;
    bool operator>(const Entry& o) const { return key > o.key || (key == o.key && state > o.state); }
  };

  /// `step`: the most that a step often adds to a key. Only the speed depends on it.
  explicit BucketQueue(double step)
      : width_(step / kBucketsPerStep),
        per_width_(std::isfinite(1.0 / width_) ? 1.0 / width_ : 0.0),
        buckets_(kBuckets) {}

  bool empty() const { return size_ == 0; }

  /// No key that is still in the queue is less.
  double floor() const { return (base_ + static_cast<double>(lowest_) * width_) * (1.0 - kRounding); }

  /// `least`: no step to the state costs less.
  void push(double key, std::int32_t state, double least) {
    ++size_;
    place({key, state, !(least > kRoom * width_)});
  }

  /// Not on an empty queue.
  Entry pop() {
    while (buckets_[lowest_].empty() && heap_.empty()) advance();
    std::vector<Entry>& from = buckets_[lowest_].empty() ? heap_ : buckets_[lowest_];
    if (&from == &heap_) std::pop_heap(heap_.begin(), heap_.end(), std::greater<>());
    const Entry entry = from.back();
    from.pop_back();
    --size_;
    return entry;
  }

 private:
  static constexpr std::size_t kBuckets = 1024;
  static constexpr double kBucketsPerStep = 128.0;
  static constexpr double kRoom = 1.001, kRounding = 1e-9;  // much more than keys are rounded by

  void place(const Entry& entry) {
    const double number = (entry.key - base_) * per_width_;
    if (!(number < static_cast<double>(kBuckets))) {
      beyond_.push_back(entry);
    } else if (number < static_cast<double>(lowest_ + 1)) {
      heap_.push_back(entry);
      std::push_heap(heap_.begin(), heap_.end(), std::greater<>());
    } else {
      buckets_[static_cast<std::size_t>(number)].push_back(entry);
    }
  }

  void advance() {
    if (++lowest_ == kBuckets) {
      lowest_ = 0;
      base_ = std::ranges::min(beyond_, {}, &Entry::key).key;
      std::vector<Entry> waiting;
      waiting.swap(beyond_);
      for (const Entry& entry : waiting) place(entry);
    }
    std::vector<Entry>& bucket = buckets_[lowest_];
    const auto rest = std::partition(bucket.begin(), bucket.end(), [](const Entry& e) { return !e.in_order; });
    heap_.insert(heap_.end(), rest, bucket.end());
    bucket.erase(rest, bucket.end());
    std::make_heap(heap_.begin(), heap_.end(), std::greater<>());
  }

  double width_, per_width_, base_ = 0.0;
  std::vector<std::vector<Entry>> buckets_;
  std::size_t lowest_ = 0, size_ = 0;
  std::vector<Entry> heap_;    // of the lowest bucket, what must come out in order
  std::vector<Entry> beyond_;  // keys past the last bucket
};

}  // namespace seamwire::detail
