// SPDX-License-Identifier: GPL-3.0-or-later
//
// Kernels: functions that are compiled once for each of several instruction sets. No variant contracts a product and a
// sum, so all give the same bits.
#pragma once

#include <vector>

/// Before a loop without a branch, which the compiler should turn into vector instructions.
#if defined(__clang__)
#define SEAMWIRE_VECTORIZE _Pragma("clang loop vectorize(assume_safety) interleave_count(1)")
#elif defined(__GNUC__)
#define SEAMWIRE_VECTORIZE _Pragma("GCC ivdep")
#else
#define SEAMWIRE_VECTORIZE
#endif

/// Defines `kVariants`, an InstructionSets. KERNELS(TARGET, WIDTH) is a macro that defines functions with the attribute
/// TARGET, and a constant `kKernels` with pointers to them. WIDTH is how many doubles a vector register holds.
///
/// AVX-512 is left out. It is no faster than AVX2 here.
#if defined(__GNUC__) && defined(__x86_64__)
#define SEAMWIRE_COMPILE_VARIANTS(KERNELS)    \
  namespace plain {                           \
  KERNELS(, 2)                                \
  }                                           \
  namespace avx2 {                            \
  KERNELS(__attribute__((target("avx2"))), 4) \
  }                                           \
  constexpr InstructionSets kVariants(plain::kKernels, &avx2::kKernels);
#else
#define SEAMWIRE_COMPILE_VARIANTS(KERNELS) \
  namespace plain {                        \
  KERNELS(, 2)                             \
  }                                        \
  constexpr InstructionSets kVariants(plain::kKernels);
#endif

namespace seamwire::detail {

/// The variants of some kernels. `Kernels` is a struct of pointers to functions.
template <class Kernels>
class InstructionSets {
 public:
  /// `plain`: for every processor that the library as a whole is compiled for. `avx2`: may be null.
  constexpr explicit InstructionSets(const Kernels& plain, const Kernels* avx2 = nullptr)
      : plain_(&plain), avx2_(avx2) {}

  /// The fastest kernels that this processor can run.
  const Kernels& fastest() const { return has_avx2() ? *avx2_ : *plain_; }
  /// All that this processor can run, the slowest first.
  std::vector<const Kernels*> usable() const {
    std::vector<const Kernels*> all{plain_};
    if (has_avx2()) all.push_back(avx2_);
    return all;
  }

 private:
  bool has_avx2() const {
#if defined(__GNUC__) && defined(__x86_64__)
    return avx2_ != nullptr && __builtin_cpu_supports("avx2");
#else
    return false;
#endif
  }

  const Kernels *plain_, *avx2_;
};

}  // namespace seamwire::detail
