// Arrays whose elements are not set when they are made: filling a picture with zeros first, on one
// thread, costs as much as making it on all. Large ones are in large pages.
#pragma once

#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/large_pages.h"

namespace whittle {

/// As std::allocator, but elements made without a value are left as the memory was.
template <class T>
struct UninitializedAllocator : std::allocator<T> {
  template <class U>
  struct rebind {
    using other = UninitializedAllocator<U>;
  };
  T* allocate(size_t n) {
    T* const memory = std::allocator<T>::allocate(n);
    prefer_large_pages(memory, n * sizeof(T));
    return memory;
  }
  template <class U>
  void construct(U*) noexcept {
    static_assert(std::is_trivially_copyable_v<U>);  // so that it is there without being made
  }
  template <class U, class... Parts>
  void construct(U* place, Parts&&... parts) {
    std::construct_at(place, std::forward<Parts>(parts)...);
  }
};

/// Its size constructor and resize() leave new elements unset.
template <class T>
using UninitializedVector = std::vector<T, UninitializedAllocator<T>>;

}  // namespace whittle
