// Large pages. The system provides memory page by page, when each page is first touched; with small
// pages that takes longer for a picture than tracing it.
#pragma once

#include <cstddef>

namespace whittle {

/// Asks for large pages, as far as whole ones lie in this memory. A hint: it never fails.
void prefer_large_pages(void* memory, size_t bytes) noexcept;

}  // namespace whittle
