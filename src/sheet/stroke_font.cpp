#include "sheet/stroke_font.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace whittle {
namespace {

/// Capitals are 6 of these steps high, from 2, the baseline, to 8; what hangs below goes to 0.
constexpr double kSteps = 6, kBaseline = 2;
/// Between letters, and a space, in steps.
constexpr double kGap = 2, kSpace = 3;

/// Of each sign from '!' to '~' its strokes, apart by spaces: each a row of points of one digit for
/// x and one for y.
constexpr std::array<const char*, 94> kSigns = {
    "0804 0202",                            // !
    "0807 2827",                            // "
    "1218 3238 0444 0646",                  // #
    "473818070615354443321203 2921",        // $
    "0248 0807171808 3332424333",           // %
    "4206071827260403122244",               // &
    "0807",                                 // '
    "18070312",                             // (
    "08171302",                             // )
    "0446 0644 2327",                       // *
    "0545 2327",                            // +
    "1201",                                 // ,
    "0535",                                 // -
    "0202",                                 // .
    "0248",                                 // /
    "120307183847433212",                   // 0
    "172822 1232",                          // 1
    "07183847460242",                       // 2
    "0718384746354443321203 1535",          // 3
    "32380444",                             // 4
    "480805354443321203",                   // 5
    "473818070312324344351504",             // 6
    "084812",                               // 7
    "150607183847463515 1504031232434435",  // 8
    "031232434738180706153546",             // 9
    "0202 0505",                            // :
    "1515 1201",                            // ;
    "380532",                               // <
    "0444 0646",                            // =
    "083502",                               // >
    "07183847462524 2222",                  // ?
    "34231415263534 344447381807031232",    // @
    "022842 1535",                          // A
    "02083847463505 3544433202",            // B
    "4738180703123243",                     // C
    "02082846442202",                       // D
    "48080242 0535",                        // E
    "480802 0535",                          // F
    "47381807031232434525",                 // G
    "0208 4248 0545",                       // H
    "1218 0222 0828",                       // I
    "0312324348",                           // J
    "0208 4804 1542",                       // K
    "080242",                               // L
    "0208254842",                           // M
    "02084248",                             // N
    "120307183847433212",                   // O
    "02083847463505",                       // P
    "120307183847433212 2442",              // Q
    "02083847463505 2542",                  // R
    "473818070615354443321203",             // S
    "0848 2822",                            // T
    "080312324348",                         // U
    "082248",                               // V
    "0812253248",                           // W
    "0248 0842",                            // X
    "082548 2522",                          // Y
    "08480242",                             // Z
    "18080212",                             // [
    "0842",                                 // backslash
    "08181202",                             // ]
    "062846",                               // ^
    "0141",                                 // _
    "0817",                                 // `
    "3526160503122233 3632",                // a
    "0802 0516263533221203",                // b
    "3526160503122233",                     // c
    "3526160503122233 3832",                // d
    "04343526160503122233",                 // e
    "12172838 0626",                        // f
    "3526160503122233 3631201001",          // g
    "0802 0516263532",                      // h
    "0602 0808",                            // i
    "161100 1818",                          // j
    "0802 3603 1432",                       // k
    "080312",                               // l
    "0602 05162522 25364542",               // m
    "0602 0516263532",                      // n
    "120305162635332212",                   // o
    "0600 0516263533221203",                // p
    "3630 3526160503122233",                // q
    "0602 051626",                          // r
    "3616051424332202",                     // s
    "181322 0626",                          // t
    "0603122233 3632",                      // u
    "062246",                               // v
    "0612253246",                           // w
    "0236 0632",                            // x
    "0622 4610",                            // y
    "06360232",                             // z
    "28171605141322",                       // {
    "0901",                                 // |
    "08171625141302",                       // }
    "04153445",                             // ~
};
constexpr std::string_view kDegree = "0718271607", kTimes = "0347 0743", kUnknown = "0208484202";

/// Takes the next character off a text. What is no UTF-8 counts byte by byte.
uint32_t take_character(std::string_view& text) {
  const auto byte = [&](size_t i) { return uint32_t(uint8_t(text[i])); };
  const uint32_t first = byte(0);
  const size_t size = first < 0xc2 ? 1 : first < 0xe0 ? 2 : first < 0xf0 ? 3 : first < 0xf5 ? 4 : 1;
  uint32_t code = size == 1 ? first : first & (0x7fu >> size);
  size_t taken = 1;
  for (; taken < size && taken < text.size() && (byte(taken) & 0xc0) == 0x80; ++taken)
    code = code << 6 | (byte(taken) & 0x3fu);
  text.remove_prefix(taken);
  return taken == size ? code : 0xfffd;
}

std::string_view glyph_of(uint32_t code) {
  if (code >= '!' && code <= '~') return kSigns[code - '!'];
  constexpr uint32_t kDegreeCode = 0xb0, kTimesCode = 0xd7;
  return code == kDegreeCode ? kDegree : code == kTimesCode ? kTimes : kUnknown;
}

/// Calls visit(glyph, where it starts in steps); the end of the last.
template <class Visit>
double walk(std::string_view text, const Visit& visit) {
  double at = 0, end = 0;
  while (!text.empty()) {
    const uint32_t code = take_character(text);
    if (code == ' ') {
      at += kSpace + kGap;
      end = at - kGap;
      continue;
    }
    const std::string_view glyph = glyph_of(code);
    double width = 0;
    for (size_t i = 0; i < glyph.size(); i += glyph[i] == ' ' ? 1 : 2)
      if (glyph[i] != ' ') width = std::max(width, double(glyph[i] - '0'));
    // Digits stand below one another.
    if (code >= '0' && code <= '9') width = 4;
    visit(glyph, at);
    end = at + width;
    at = end + kGap;
  }
  return end;
}

}  // namespace

double text_width(std::string_view text, double height) {
  return walk(text, [](std::string_view, double) {}) * height / kSteps;
}

std::vector<Stroke> text_strokes(std::string_view text, Vec2 start, double height) {
  std::vector<Stroke> strokes;
  const double step = height / kSteps;
  walk(text, [&](std::string_view glyph, double at) {
    bool goes_on = false;
    for (size_t i = 0; i < glyph.size();) {
      if (glyph[i] == ' ') {
        goes_on = false;
        ++i;
        continue;
      }
      if (!goes_on) strokes.emplace_back();
      goes_on = true;
      const double x = at + (glyph[i] - '0'), y = glyph[i + 1] - '0' - kBaseline;
      strokes.back().push_back({start.x + x * step, start.y - y * step});
      i += 2;
    }
  });
  return strokes;
}

}  // namespace whittle
