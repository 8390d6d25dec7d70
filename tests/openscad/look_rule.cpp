#include "look_rule.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>

namespace whittle {
namespace {

/// Calls visit(x, y) for the pixel and those of its eight neighbours that are in the picture.
template <class Visit>
void for_around(const Picture& picture, int x, int y, const Visit& visit) {
  for (int v = std::max(y - 1, 0); v <= std::min(y + 1, picture.height - 1); ++v)
    for (int u = std::max(x - 1, 0); u <= std::min(x + 1, picture.width - 1); ++u) visit(u, v);
}

bool is_edge(const Look& look, int x, int y) {
  const Hit& here = look.facts.at(x, y);
  bool edge = false;
  for_around(look.ours, x, y, [&](int u, int v) {
    const Hit& there = look.facts.at(u, v);
    const bool one_face =
        there.id == here.id &&
        (!here.hit() || dot(here.normal - there.normal, here.normal - there.normal) < 1e-8f);
    edge = edge || !one_face || difference(look.ours.at(x, y), look.ours.at(u, v)) > 2;
  });
  return edge;
}

}  // namespace

int difference(const uint8_t* a, const uint8_t* b) {
  return std::max({std::abs(a[0] - b[0]), std::abs(a[1] - b[1]), std::abs(a[2] - b[2])});
}

size_t hits(const Frame& facts) {
  return static_cast<size_t>(std::ranges::count_if(facts.hits, &Hit::hit));
}

Differences compare(const Look& look) {
  Differences d;
  d.pixels = look.facts.hits.size();
  for (int y = 0; y < look.ours.height; ++y) {
    for (int x = 0; x < look.ours.width; ++x) {
      const bool hit = look.facts.at(x, y).hit();
      const uint8_t* theirs = look.theirs.at(x, y);
      d.hits += hit;
      if (is_edge(look, x, y)) {
        ++d.edges;
        int least = 255;
        for_around(look.ours, x, y, [&](int u, int v) {
          least = std::min(least, difference(theirs, look.ours.at(u, v)));
        });
        d.unexplained += least > 1;
        d.unequal += difference(theirs, look.ours.at(x, y)) > 1;
        continue;
      }
      d.inner_hits += hit;
      const uint8_t* ours = look.ours.at(x, y);
      const int off = difference(theirs, ours);
      d.largest = std::max(d.largest, off);
      if (off > 1 && d.wrong++ == 0) {
        char text[120];
        std::snprintf(text, sizeof text, "at (%d, %d): theirs %d %d %d, ours %d %d %d, id %u", x, y,
                      theirs[0], theirs[1], theirs[2], ours[0], ours[1], ours[2],
                      look.facts.at(x, y).id);
        d.first_wrong = text;
      }
    }
  }
  return d;
}

}  // namespace whittle
