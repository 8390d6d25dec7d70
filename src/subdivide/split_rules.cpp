#include "subdivide/split_rules.h"

#include <algorithm>

#include "subdivide/formula_size.h"
#include "subdivide/near_triangles.h"

namespace whittle {
namespace {

/// A cell whose formula has not become shorter, in itself and in its sibling, over this many splits
/// in a row is a corner or an edge where many surfaces meet: no split will part them.
uint32_t stall_limit(uint32_t literals) {
  return std::max(6u, literals);
}

/// One conjunction or disjunction, which needs no table, of so many literals costs no more.
constexpr uint32_t kQuickLiterals = 10;

/// Whether splitting a cell of so many literals saves more than it takes, all counted in visits of
/// a node by a ray. Each ray saves a part of the literals that it would look at, and makes a visit
/// and a bit more; beyond `quick` literals, with which a leaf is solved for many rays at once, it
/// saves much more. The split itself takes so much for each literal of the formula.
bool pays_off(uint32_t literals, double rays, uint32_t quick = kTableLiterals) {
  constexpr double kSavedEach = 0.32, kSavedBeyond = 4, kMoreVisits = 1.3, kSplitEach = 120;
  const uint32_t beyond = std::max(literals, quick) - quick;
  return rays * (kSavedEach * literals + kSavedBeyond * beyond - kMoreVisits) >
         kSplitEach * literals;
}

/// Of the memory that is left each part of a cell gets as much as it has of the literals, and as if
/// it had so many more: where few surfaces meet for good, many cells are needed too.
constexpr uint32_t kFew = 16;

}  // namespace

double half_area(const Box& box) {
  const Vec3 size = box.size();
  return size.x * size.y + size.y * size.z + size.z * size.x;
}

SplitRules::SplitRules(const Scene& scene, const SubdivideSettings& settings)
    : scene_(scene),
      settings_(settings),
      region_edge_(max_component(scene.region.size())),
      is_auto_(settings.leaf_size == kAutoLeafSize) {}

SplitRules::Outlook SplitRules::outlook(const OpenCell& open) const {
  // At 512 x 512 rays this is the smallest edge that others have.
  constexpr double kFewestRays = 1.0 / 1024;
  Outlook o;
  const double edge = max_component(open.box.size()) / region_edge_;
  o.rays = edge * edge * settings_.rays;
  if (settings_.is_small)
    o.is_small = settings_.is_small({open.box.lo + scene_.origin, open.box.hi + scene_.origin});
  const bool is_useless = !settings_.is_small &&
                          (is_auto_ ? !pays_off(open.literals, o.rays)
                                    : edge * edge * open.literals < settings_.least_use) &&
                          !open.is_crowded;
  const size_t split_bytes =
      2 * (sizeof(Cell) + bytes_unsplit(open.literals, most_words(open.tokens())));
  o.must_end = is_useless ||
               (is_auto_ ? o.rays * 0.25 < kFewestRays : edge * 0.5 < settings_.smallest_edge) ||
               open.stalled >= stall_limit(open.literals) || open.depth >= kMostDepth ||
               open.memory < split_bytes;
  // To split takes much less than to make a formula of triangles: of a crowd of them, or where even
  // one that is a single group would not be the end.
  const bool is_never_simple =
      is_auto_ && open.near_count > 0 && pays_off(open.literals, o.rays, kQuickLiterals);
  o.is_long =
      !o.must_end && (open.is_crowded || is_never_simple ||
                      (open.literals > kExpandAll && !has_few_half_spaces(scene_, open.tokens())));
  return o;
}

bool SplitRules::is_simple(const LeafAnalysis& analysis, const Outlook& outlook) const {
  if (is_auto_) {
    const uint32_t quick = analysis.is_one_group() ? kQuickLiterals : kTableLiterals;
    return !pays_off(analysis.size(), outlook.rays, quick);
  }
  if (settings_.leaf == LeafRule::kHalfSpaces) return analysis.size() <= settings_.leaf_size;
  return analysis.primitive_count() <= settings_.leaf_size || analysis.is_plain_union();
}

size_t SplitRules::bytes_unsplit(size_t literals, size_t words) const {
  // Blocks of open cells are rounded up to powers of two.
  return 2 * OpenCell::bytes(words) + sizeof(Leaf) + literals * (sizeof(Step) + sizeof(Token)) +
         std::min(literals, scene_.half_spaces.size()) * sizeof(LeafLiteral);
}

size_t SplitRules::most_words(std::span<const Token> formula) const {
  if (scene_.boundaries.empty()) return formula.size();
  return formula.size() + count_boundaries(scene_, formula) * NearTriangles::kMostWords;
}

void SplitRules::share(const OpenCell& parent, std::span<OpenCell* const> parts, size_t cell_bytes,
                       uint32_t splits) const {
  size_t taken = cell_bytes, weights = 0;
  bool stalls = true;
  for (const OpenCell* part : parts) {
    stalls = stalls && part != nullptr && part->literals >= parent.literals && !part->is_crowded;
    if (part == nullptr) continue;
    taken += bytes_unsplit(part->literals, part->words());
    weights += part->literals + kFew;
  }
  const double rest = parent.memory > taken ? double(parent.memory - taken) : 0;
  for (OpenCell* part : parts) {
    if (part == nullptr) continue;
    part->stalled = stalls ? parent.stalled + splits : 0;
    part->memory = bytes_unsplit(part->literals, part->words()) +
                   size_t(rest * double(part->literals + kFew) / double(weights));
  }
}

}  // namespace whittle
