// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "detail/thread_safety.hpp"

namespace seamwire::detail {

/// An array whose copies share what has not been changed since (copy on write), page by page: a copy that differs in a
/// few places costs these, and a pointer a page. As with other containers, one array is for one thread; the pages that
/// several share are only read.
template <class T>
class PagedArray {
 public:
  PagedArray() = default;

  std::size_t size() const { return size_; }
  const T& operator[](std::size_t i) const { return pages_[i / kPage][i % kPage]; }
  /// To be written to: a page that is shared is copied first.
  ///
  /// A use count of 1 is reliable although other threads may drop their copies meanwhile. Only a copy of this array
  /// could raise it, and the array is for one thread. If others drop theirs just now, the page is copied in vain.
  T& edit(std::size_t i) {
    std::shared_ptr<T[]>& page = pages_[i / kPage];
    if (page.use_count() > 1) {
      std::shared_ptr<T[]> own = make_page();
      std::copy_n(page.get(), kPage, own.get());
      page = std::move(own);
    } else {
      acquire(page);
    }
    return page[i % kPage];
  }
  /// New items have any value.
  void resize(std::size_t size) {
    const std::size_t pages = (size + kPage - 1) / kPage;
    if (pages <= pages_.size()) {
      pages_.resize(pages);
    } else {
      // In one piece, which is there until the last of its pages goes: the system is faster with that.
      const std::size_t added = pages - pages_.size();
      const std::shared_ptr<T[]> piece(new T[added * kPage]);
      pages_.reserve(pages);
      for (std::size_t i = 0; i < added; ++i) {
        pages_.push_back(std::shared_ptr<T[]>(piece.get() + i * kPage, [piece](T*) {}));
      }
    }
    size_ = size;
  }
  /// Whether both read an item from the same place.
  bool shares(const PagedArray& other, std::size_t i) const { return &(*this)[i] == &other[i]; }

 private:
  static constexpr std::size_t kPage = 2048;
  /// Orders what former owners on other threads read of a page before what its only owner writes. use_count() alone
  /// orders nothing; the fence pairs with the owners' decrements of the count.
  static void acquire([[maybe_unused]] const std::shared_ptr<T[]>& page) {
#ifdef SEAMWIRE_THREAD_SANITIZER
    const std::shared_ptr<T[]> copy = page;  // it knows no fences, but knows the decrement that ends the copy
#else
    std::atomic_thread_fence(std::memory_order_acquire);
#endif
  }
  static std::shared_ptr<T[]> make_page() { return std::shared_ptr<T[]>(new T[kPage]); }

  std::vector<std::shared_ptr<T[]>> pages_;
  std::size_t size_ = 0;
};

}  // namespace seamwire::detail
