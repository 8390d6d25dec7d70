// FreeType, HarfBuzz and fontconfig, found when the first text is met.
//
// Linked, the three and what they need would cost every start of the program one to three
// milliseconds, as much as it takes to draw a small model.
#pragma once

#include <fontconfig/fontconfig.h>
#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_OUTLINE_H
#include <hb-ft.h>
#include <hb.h>

namespace whittle {

// clang-format off
#define WHITTLE_FREETYPE_CALLS(CALL)                                                        \
  CALL(FT_Init_FreeType) CALL(FT_Done_FreeType) CALL(FT_New_Face) CALL(FT_Done_Face)        \
  CALL(FT_Select_Charmap) CALL(FT_Set_Pixel_Sizes) CALL(FT_Load_Glyph)                      \
  CALL(FT_Outline_Get_CBox) CALL(FT_Outline_Decompose)
#define WHITTLE_HARFBUZZ_CALLS(CALL)                                                        \
  CALL(hb_buffer_create) CALL(hb_buffer_destroy) CALL(hb_buffer_add_utf8)                   \
  CALL(hb_buffer_set_direction) CALL(hb_buffer_get_direction) CALL(hb_buffer_set_script)    \
  CALL(hb_buffer_set_language) CALL(hb_buffer_guess_segment_properties)                     \
  CALL(hb_buffer_get_glyph_infos) CALL(hb_buffer_get_glyph_positions)                       \
  CALL(hb_direction_from_string) CALL(hb_script_from_string) CALL(hb_language_from_string)  \
  CALL(hb_shape) CALL(hb_font_destroy) CALL(hb_ft_font_create) CALL(hb_ft_font_set_load_flags)
#define WHITTLE_FONTCONFIG_CALLS(CALL)                                                      \
  CALL(FcInitLoadConfigAndFonts) CALL(FcConfigDestroy) CALL(FcNameParse)                    \
  CALL(FcPatternDestroy) CALL(FcPatternAddBool) CALL(FcPatternGetString)                    \
  CALL(FcPatternGetInteger) CALL(FcConfigSubstitute) CALL(FcDefaultSubstitute)              \
  CALL(FcFontMatch) CALL(FcStrCmpIgnoreCase)
// clang-format on

/// The functions by their own names.
struct FontCalls {
#define WHITTLE_DECLARE(name) decltype(&::name) name = nullptr;
  WHITTLE_FREETYPE_CALLS(WHITTLE_DECLARE)
  WHITTLE_HARFBUZZ_CALLS(WHITTLE_DECLARE)
  WHITTLE_FONTCONFIG_CALLS(WHITTLE_DECLARE)
#undef WHITTLE_DECLARE

  /// Opens the libraries. False if one of them is not there, or lacks a function.
  bool load();
};

}  // namespace whittle
