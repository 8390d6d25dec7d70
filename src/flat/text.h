// text(): glyphs as polygons, with OpenSCAD's fonts, sizes and alignments.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "flat/polygons.h"
#include "model/document.h"

namespace whittle {

/// The machine's fonts, as fontconfig finds them. Nothing is looked for before the first text, and
/// each font is opened once.
class FontLibrary {
 public:
  FontLibrary();
  ~FontLibrary();
  FontLibrary(const FontLibrary&) = delete;
  FontLibrary& operator=(const FontLibrary&) = delete;

  struct Face;
  /// The font that fontconfig has for a name like "Liberation Sans:style=Bold"; null if it has none
  /// at all. Stays valid as long as the library.
  Face* find(const std::string& name);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// The outlines of a text.
struct TextOutline {
  /// A glyph each, which encloses what its contours enclose an odd number of times.
  std::vector<std::vector<Contour>> glyphs;
  /// What was found in place of a font that is not there, by its family's name. Told once a font.
  std::optional<std::string> replacement;
  bool no_fonts = false;  ///< there is none on this machine, or no way to draw it
};

/// Lays a text out (HarfBuzz) and outlines it (FreeType). Curves have as many segments as OpenSCAD
/// gives them: an eighth of the fragments of a circle of radius `size`, and one more, at least two.
/// A text of more than kMostGlyphBytes is cut off. Empty where there is no font at all.
TextOutline outline_text(const Text& text, FontLibrary& fonts);
inline constexpr size_t kMostGlyphBytes = 100'000;

/// The region of a text.
Polygons text_polygons(const TextOutline& outline);

}  // namespace whittle
