# One dialect, one set of warnings, and arithmetic that is the same everywhere.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release)
endif()

# No contraction: a fused multiply-add here and none there would make two backends differ.
add_compile_options(-Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
                    -ffp-contract=off)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  add_compile_options(-Wno-restrict)  # false alarms in std::string, GCC bug 105651
endif()
# errno and floating-point traps are not used; without this every sqrt is a guarded call.
add_compile_options(-fno-math-errno -fno-trapping-math)

if(WHITTLE_SANITIZE)
  add_compile_options(-fsanitize=${WHITTLE_SANITIZE} -fno-sanitize-recover=all
                      -fno-omit-frame-pointer)
  add_link_options(-fsanitize=${WHITTLE_SANITIZE})
  # Compilers have no common name for these.
  add_compile_definitions(WHITTLE_SANITIZED)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    add_compile_options(-Wno-maybe-uninitialized)  # false alarms in what GCC itself inserts
  endif()
endif()

if(WHITTLE_FUZZ)
  if(NOT CMAKE_CXX_COMPILER_ID STREQUAL "Clang" OR NOT WHITTLE_TESTS)
    message(FATAL_ERROR "WHITTLE_FUZZ needs clang and WHITTLE_TESTS: cmake --preset asan")
  endif()
  # What the fuzzer learns coverage from. It need not see comparisons too: that would double the
  # time of a picture, and what the reader compares with is in its dictionary.
  add_compile_options(-fsanitize=fuzzer-no-link -fno-sanitize-coverage=trace-cmp)
endif()

# What Highway falls back to where a machine has no vectors: one lane with every compiler, as GCC 12 has
# it anyway. Its emulation of 128 bits treats NaN and infinity otherwise than any real instruction set.
add_compile_definitions(HWY_BROKEN_EMU128=1)
