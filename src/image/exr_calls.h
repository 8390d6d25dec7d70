// OpenEXR's C library, opened when the first .exr is met.
//
// Nothing of it is loaded by a run that only makes a PNG. The C++ library and the three that it
// needs, linked, cost every start three quarters of a millisecond.
#pragma once

#include <openexr.h>

namespace whittle {

// clang-format off
#define WHITTLE_EXR_CALLS(CALL)                                                             \
  CALL(exr_get_default_error_message) CALL(exr_start_write) CALL(exr_start_read)            \
  CALL(exr_finish) CALL(exr_add_part) CALL(exr_add_channel) CALL(exr_write_header)          \
  CALL(exr_initialize_required_attr_simple) CALL(exr_get_storage) CALL(exr_get_channels)    \
  CALL(exr_get_data_window) CALL(exr_get_scanlines_per_chunk)                               \
  CALL(exr_write_scanline_chunk_info) CALL(exr_write_scanline_chunk)                        \
  CALL(exr_encoding_initialize) CALL(exr_encoding_choose_default_routines)                  \
  CALL(exr_encoding_run) CALL(exr_encoding_destroy) CALL(exr_read_scanline_chunk_info)      \
  CALL(exr_decoding_initialize) CALL(exr_decoding_choose_default_routines)                  \
  CALL(exr_decoding_update) CALL(exr_decoding_run) CALL(exr_decoding_destroy)
// clang-format on

/// The functions by their own names.
struct ExrCalls {
#define WHITTLE_DECLARE(name) decltype(&::name) name = nullptr;
  WHITTLE_EXR_CALLS(WHITTLE_DECLARE)
#undef WHITTLE_DECLARE

  /// Opens the library. False if it is not there, or lacks a function.
  bool load();
};

}  // namespace whittle
