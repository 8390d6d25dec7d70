#include "image/colorscheme.h"

#include <algorithm>
#include <array>
#include <cctype>

namespace whittle {
namespace {

constexpr Rgb8 hex(uint32_t rgb) {
  return {uint8_t(rgb >> 16), uint8_t(rgb >> 8 & 255), uint8_t(rgb & 255)};
}

constexpr ColorScheme flat(std::string_view name, uint32_t background, uint32_t front,
                           uint32_t back) {
  return {name, hex(background), hex(background), hex(front), hex(back), hex(front), hex(back)};
}

/// Of schemes that have other colours for what is not evaluated.
constexpr ColorScheme with_preview(ColorScheme scheme, uint32_t front, uint32_t back) {
  scheme.lone = hex(front);
  scheme.preview_back = hex(back);
  return scheme;
}

constexpr ColorScheme with_drawing(ColorScheme scheme, uint32_t plane, uint32_t outline) {
  scheme.plane = hex(plane);
  scheme.outline = hex(outline);
  return scheme;
}

constexpr std::array kSchemes{
    flat("Cornfield", 0xFFFFE5, 0xF9D72C, 0x9DCB51),
    flat("Metallic", 0xAAAAFF, 0xDDDDFF, 0xDD22DD),
    flat("Sunset", 0xAA4444, 0xFFAAAA, 0x882233),
    with_drawing(flat("Starnight", 0x000000, 0xFFFFE0, 0x00FFFF), 0x9370DB, 0xFF00FF),
    flat("BeforeDawn", 0x333333, 0xCCCCCC, 0x5563DD),
    flat("Nature", 0xFAFAFA, 0x16A085, 0xDBF4DA),
    flat("Daylight Gem", 0xF0F0F0, 0x02DAF7, 0x014DA1),
    flat("Nocturnal Gem", 0x0C0C0C, 0x02DAF7, 0x014DA1),
    with_drawing(flat("DeepOcean", 0x333333, 0xEEEEEE, 0x0BABC8), 0x9370DB, 0xFF00FF),
    with_drawing(flat("Solarized", 0xFDF6E3, 0xB58800, 0x882233), 0x6C71C4, 0xB58800),
    with_drawing(with_preview(flat("Tomorrow", 0xF8F8F8, 0x3E999F, 0xEAB700), 0x4271AE, 0xF5871F),
                 0x718C00, 0xC82829),
    with_drawing(
        with_preview(flat("Tomorrow Night", 0x1D1F21, 0x8ABEB7, 0xF0C674), 0x81A2BE, 0xDE935F),
        0xB5BD68, 0xCC6666),
    ColorScheme{"ClearSky", hex(0x87CEEB), hex(0xC9E9F6), hex(0xFFEC5E), hex(0x9DCB51),
                hex(0xF9D72C), hex(0x9DCB51)},
    flat("Monotone", 0xFFFFE5, 0xF9D72C, 0xF9D72C),
};

bool same_name(std::string_view a, std::string_view b) {
  return std::ranges::equal(
      a, b, [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

}  // namespace

std::span<const ColorScheme> color_schemes() {
  return kSchemes;
}

const ColorScheme* find_color_scheme(std::string_view name) {
  const auto found =
      std::ranges::find_if(kSchemes, [&](const ColorScheme& s) { return same_name(s.name, name); });
  return found == kSchemes.end() ? nullptr : &*found;
}

std::string color_scheme_names() {
  std::string names;
  for (const ColorScheme& scheme : kSchemes) {
    if (!names.empty()) names += ", ";
    names += scheme.name;
  }
  return names;
}

}  // namespace whittle
