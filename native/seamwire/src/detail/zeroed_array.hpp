// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <memory>
#include <new>
#include <type_traits>

namespace seamwire::detail {

/// An array of zeros. The system hands out its memory page by page when it is first touched, so an array that is used
/// in few places costs neither time nor memory for the rest.
template <class T>
class ZeroedArray {
 public:
  static_assert(std::is_trivial_v<T>);
  explicit ZeroedArray(std::size_t size)
      : values_(static_cast<T*>(std::calloc(std::max<std::size_t>(size, 1), sizeof(T)))) {
    if (!values_) throw std::bad_alloc();
  }
  T& operator[](std::size_t i) { return values_.get()[i]; }
  const T& operator[](std::size_t i) const { return values_.get()[i]; }

 private:
  struct Free {
    void operator()(T* values) const { std::free(values); }
  };
  std::unique_ptr<T, Free> values_;
};

}  // namespace seamwire::detail
