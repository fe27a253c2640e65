// SPDX-License-Identifier: GPL-3.0-or-later
//
// Memory for large arrays, in large pages where Linux has them (madvise(2), MADV_HUGEPAGE). The system provides memory
// page by page, when a page is first used. Fewer and larger pages take less time, which docs/notebook/geodesics.md
// measures. Only the module replaces operator new, and only for itself (module.map).
// A library must not do so to the programs it is linked into. malloc and free are used, so any code may free this
// memory.
#include <sys/mman.h>

#include <cstddef>
#include <cstdlib>
#include <new>

namespace {

/// Of a large page, and the least array that gets some.
constexpr std::size_t kLargePage = std::size_t{2} << 20;

void* allocate(std::size_t size, std::size_t alignment) {
  if (size < kLargePage && alignment <= alignof(std::max_align_t)) return std::malloc(size > 0 ? size : 1);
  void* memory = nullptr;
  const bool is_large = size >= kLargePage && alignment <= kLargePage;
  if (posix_memalign(&memory, is_large ? kLargePage : alignment, size) != 0) return nullptr;
  if (is_large) madvise(memory, size, MADV_HUGEPAGE);  // a hint, which may fail
  return memory;
}

void* allocate_or_throw(std::size_t size, std::size_t alignment) {
  while (true) {
    if (void* const memory = allocate(size, alignment)) return memory;
    const std::new_handler handler = std::get_new_handler();
    if (handler == nullptr) throw std::bad_alloc();
    handler();
  }
}

}  // namespace

void* operator new(std::size_t size) { return allocate_or_throw(size, alignof(std::max_align_t)); }
void* operator new[](std::size_t size) { return allocate_or_throw(size, alignof(std::max_align_t)); }
void* operator new(std::size_t size, std::align_val_t alignment) {
  return allocate_or_throw(size, static_cast<std::size_t>(alignment));
}
void* operator new[](std::size_t size, std::align_val_t alignment) {
  return allocate_or_throw(size, static_cast<std::size_t>(alignment));
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }
