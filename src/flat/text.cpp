#include "flat/text.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "flat/font_calls.h"
#include "shape/fragments.h"

namespace whittle {
namespace {

/// OpenSCAD's when no font is named.
constexpr const char* kDefaultFont = "Liberation Sans";

/// FreeType's coordinates count 64ths of a font unit: faces are set to as many pixels as units.
constexpr double kUnit = 64;

/// OpenSCAD divides outlines by 1000 and what lies between them by 1024.
constexpr double kBetween = 1000.0 / 1024;

std::string family_of(const FontCalls& calls, FcPattern* pattern) {
  FcChar8* family = nullptr;
  if (calls.FcPatternGetString(pattern, FC_FAMILY, 0, &family) != FcResultMatch) return {};
  return reinterpret_cast<const char*>(family);
}

/// Whether a pattern has this family among its names, but for upper and lower case.
bool has_family(const FontCalls& calls, FcPattern* pattern, const std::string& name) {
  FcChar8* family = nullptr;
  for (int i = 0; calls.FcPatternGetString(pattern, FC_FAMILY, i, &family) == FcResultMatch; ++i)
    if (calls.FcStrCmpIgnoreCase(family, reinterpret_cast<const FcChar8*>(name.c_str())) == 0)
      return true;
  return false;
}

}  // namespace

struct FontLibrary::Face {
  const FontCalls* calls = nullptr;
  FT_Face face = nullptr;
  hb_font_t* font = nullptr;
  double units_per_em = 1;
  std::optional<std::string> replacement;
};

struct FontLibrary::State {
  FontCalls calls;
  FcConfig* config = nullptr;
  FT_Library free_type = nullptr;
  std::map<std::string, Face> faces;  ///< by the name that was asked for

  State() {
    if (!calls.load()) return;
    config = calls.FcInitLoadConfigAndFonts();
    if (calls.FT_Init_FreeType(&free_type) != 0) free_type = nullptr;
  }
  ~State() {
    for (auto& [name, face] : faces) {
      if (face.font != nullptr) calls.hb_font_destroy(face.font);
      if (face.face != nullptr) calls.FT_Done_Face(face.face);
    }
    if (free_type != nullptr) calls.FT_Done_FreeType(free_type);
    if (config != nullptr) calls.FcConfigDestroy(config);
  }
};

FontLibrary::FontLibrary() = default;
FontLibrary::~FontLibrary() = default;

FontLibrary::Face* FontLibrary::find(const std::string& name) {
  if (!state_) state_ = std::make_unique<State>();
  const FontCalls& calls = state_->calls;
  if (state_->config == nullptr || state_->free_type == nullptr) return nullptr;
  const auto [at, is_new] = state_->faces.try_emplace(name);
  Face& face = at->second;
  if (!is_new) return face.face != nullptr ? &face : nullptr;

  using Pattern = std::unique_ptr<FcPattern, decltype(calls.FcPatternDestroy)>;
  const std::string asked = name.empty() ? kDefaultFont : name;
  const Pattern pattern(calls.FcNameParse(reinterpret_cast<const FcChar8*>(asked.c_str())),
                        calls.FcPatternDestroy);
  if (!pattern) return nullptr;
  const std::string family = family_of(calls, pattern.get());
  calls.FcPatternAddBool(pattern.get(), FC_OUTLINE, FcTrue);
  calls.FcPatternAddBool(pattern.get(), FC_SCALABLE, FcTrue);
  calls.FcConfigSubstitute(state_->config, pattern.get(), FcMatchPattern);
  calls.FcDefaultSubstitute(pattern.get());
  FcResult result;
  const Pattern match(calls.FcFontMatch(state_->config, pattern.get(), &result),
                      calls.FcPatternDestroy);
  FcChar8* file = nullptr;
  int index = 0;
  if (!match || calls.FcPatternGetString(match.get(), FC_FILE, 0, &file) != FcResultMatch)
    return nullptr;
  calls.FcPatternGetInteger(match.get(), FC_INDEX, 0, &index);
  const char* const path = reinterpret_cast<const char*>(file);
  if (calls.FT_New_Face(state_->free_type, path, index, &face.face) != 0) {
    face.face = nullptr;
    return nullptr;
  }
  face.calls = &calls;
  calls.FT_Select_Charmap(face.face, FT_ENCODING_UNICODE);
  face.units_per_em = std::max<int>(face.face->units_per_EM, 1);
  calls.FT_Set_Pixel_Sizes(face.face, 0, FT_UInt(face.units_per_em));
  face.font = calls.hb_ft_font_create(face.face, nullptr);
  calls.hb_ft_font_set_load_flags(face.font, FT_LOAD_NO_HINTING | FT_LOAD_NO_BITMAP);
  // Nobody is surprised that a default is another one elsewhere.
  if (!name.empty() && !family.empty() && !has_family(calls, match.get(), family))
    face.replacement = family_of(calls, match.get());
  return &face;
}

namespace {

/// Takes an outline apart into points, font units.
struct Pen {
  std::vector<Contour> contours;
  int segments = 2;
  Vec2 offset;
  Vec2 at;

  Vec2 place(const FT_Vector* v) const {
    return {double(v->x) / kUnit + offset.x, double(v->y) / kUnit + offset.y};
  }
  void add(Vec2 p) {
    if (contours.empty()) contours.emplace_back();
    Contour& contour = contours.back();
    if (contour.empty() || !(contour.back() == p)) contour.push_back(p);
    at = p;
  }

  static int move_to(const FT_Vector* to, void* self) {
    Pen& pen = *static_cast<Pen*>(self);
    pen.contours.emplace_back();
    pen.add(pen.place(to));
    return 0;
  }
  static int line_to(const FT_Vector* to, void* self) {
    Pen& pen = *static_cast<Pen*>(self);
    pen.add(pen.place(to));
    return 0;
  }
  static int conic_to(const FT_Vector* control, const FT_Vector* to, void* self) {
    Pen& pen = *static_cast<Pen*>(self);
    const Vec2 a = pen.at, b = pen.place(control), c = pen.place(to);
    for (int i = 1; i <= pen.segments; ++i) {
      const double t = double(i) / pen.segments, s = 1 - t;
      pen.add(a * (s * s) + b * (2 * s * t) + c * (t * t));
    }
    return 0;
  }
  static int cubic_to(const FT_Vector* first, const FT_Vector* second, const FT_Vector* to,
                      void* self) {
    Pen& pen = *static_cast<Pen*>(self);
    const Vec2 a = pen.at, b = pen.place(first), c = pen.place(second), d = pen.place(to);
    for (int i = 1; i <= pen.segments; ++i) {
      const double t = double(i) / pen.segments, s = 1 - t;
      pen.add(a * (s * s * s) + b * (3 * s * s * t) + c * (3 * s * t * t) + d * (t * t * t));
    }
    return 0;
  }
};

int segments_of(const Text& text) {
  return std::max(fragments(text.size, text.fragments) / 8 + 1, 2);
}

using Buffer = std::unique_ptr<hb_buffer_t, decltype(FontCalls::hb_buffer_destroy)>;

Buffer shaped(const Text& text, const FontLibrary::Face& face) {
  const FontCalls& calls = *face.calls;
  Buffer buffer(calls.hb_buffer_create(), calls.hb_buffer_destroy);
  const std::string utf8 = text.text.substr(0, kMostGlyphBytes);
  calls.hb_buffer_add_utf8(buffer.get(), utf8.data(), int(utf8.size()), 0, int(utf8.size()));
  const auto or_default = [](const std::string& given, const char* otherwise) {
    return given.empty() || given == "default" ? std::string(otherwise) : given;
  };
  const std::string direction = or_default(text.direction, "ltr"),
                    script = or_default(text.script, "Latn"),
                    language = or_default(text.language, "en");
  calls.hb_buffer_set_direction(buffer.get(),
                                calls.hb_direction_from_string(direction.c_str(), -1));
  calls.hb_buffer_set_script(buffer.get(), calls.hb_script_from_string(script.c_str(), -1));
  calls.hb_buffer_set_language(buffer.get(), calls.hb_language_from_string(language.c_str(), -1));
  // What is not said, or is no direction, follows from the text.
  calls.hb_buffer_guess_segment_properties(buffer.get());
  calls.hb_shape(face.font, buffer.get(), nullptr, 0);
  return buffer;
}

double offset_x(const std::string& align, double width) {
  return align == "right" ? -width : align == "center" ? -width / 2 : 0;
}
double offset_y(const std::string& align, double ascent, double descent) {
  if (align == "top") return -ascent;
  if (align == "center") return (descent - ascent) / 2;
  return align == "bottom" ? descent : 0;
}

}  // namespace

TextOutline outline_text(const Text& text, FontLibrary& fonts) {
  TextOutline outline;
  if (!(text.size > 0) || !std::isfinite(text.size) || !std::isfinite(text.spacing)) return outline;
  FontLibrary::Face* const face = fonts.find(text.font);
  outline.no_fonts = face == nullptr;
  if (face == nullptr) return outline;
  outline.replacement = std::exchange(face->replacement, std::nullopt);

  const FontCalls& calls = *face->calls;
  const Buffer buffer = shaped(text, *face);
  unsigned count = 0;
  const hb_glyph_info_t* const glyphs = calls.hb_buffer_get_glyph_infos(buffer.get(), &count);
  const hb_glyph_position_t* const places =
      calls.hb_buffer_get_glyph_positions(buffer.get(), &count);
  const bool is_horizontal =
      HB_DIRECTION_IS_HORIZONTAL(calls.hb_buffer_get_direction(buffer.get()));
  double width = 0, ascent = 0, descent = 0;
  Vec2 advance;
  for (unsigned i = 0; i < count; ++i) {
    if (calls.FT_Load_Glyph(face->face, glyphs[i].codepoint,
                            FT_LOAD_NO_HINTING | FT_LOAD_NO_BITMAP) != 0 ||
        face->face->glyph->format != FT_GLYPH_FORMAT_OUTLINE)
      continue;
    FT_Outline& shape = face->face->glyph->outline;
    FT_BBox box;
    calls.FT_Outline_Get_CBox(&shape, &box);
    const Vec2 step = Vec2{double(places[i].x_advance), double(places[i].y_advance)} *
                      (text.spacing * kBetween / kUnit);
    if (is_horizontal) {
      width += step.x;
      ascent = std::max(ascent, double(box.yMax) * kBetween / kUnit);
      descent = std::max(descent, -double(box.yMin) * kBetween / kUnit);
    } else {
      width = std::max(width, double(box.xMax - box.xMin) * kBetween / kUnit);
      ascent += step.y;
    }
    Pen pen;
    pen.segments = segments_of(text);
    pen.offset =
        advance + Vec2{double(places[i].x_offset), double(places[i].y_offset)} * (kBetween / kUnit);
    const FT_Outline_Funcs functions = {
        Pen::move_to, Pen::line_to, Pen::conic_to, Pen::cubic_to, 0, 0};
    calls.FT_Outline_Decompose(&shape, &functions, &pen);
    for (Contour& contour : pen.contours)
      if (contour.size() > 1 && contour.front() == contour.back()) contour.pop_back();
    if (!pen.contours.empty()) outline.glyphs.push_back(std::move(pen.contours));
    advance = advance + step;
  }
  // Points of 1/72 inch on a grid of 100 to the inch.
  const double scale = text.size * 100 / 72 / face->units_per_em;
  const Vec2 offset = {offset_x(text.halign, width), offset_y(text.valign, ascent, descent)};
  for (std::vector<Contour>& contours : outline.glyphs)
    for (Contour& contour : contours)
      for (Vec2& p : contour) p = (p + offset) * scale;
  return outline;
}

Polygons text_polygons(const TextOutline& outline) {
  std::vector<Polygons> glyphs;
  glyphs.reserve(outline.glyphs.size());
  for (const std::vector<Contour>& contours : outline.glyphs) glyphs.push_back(even_odd(contours));
  return unite(glyphs);
}

}  // namespace whittle
