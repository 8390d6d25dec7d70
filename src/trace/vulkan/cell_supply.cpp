#include "trace/vulkan/cell_supply.h"

#include <utility>

#include "base/timing.h"

namespace whittle {
namespace {

/// Subtrees begin so many splits below the region, or where refining has come to before.
constexpr uint32_t kTopSplits = 8;
/// So many of them are refined side by side: enough for all threads.
constexpr size_t kJobsAtOnce = 16;

/// Whether a cell has a place in the host's tree.
bool has_place(CellKind kind) {
  return kind == CellKind::kNode || is_leaf(kind);
}

/// Whether something of the cell or below it has.
bool may_show(CellLink link) {
  std::vector<CellLink> links{link};
  while (!links.empty()) {
    const CellLink now = links.back();
    links.pop_back();
    if (is_leaf(now.kind()) || now.kind() == CellKind::kOpen) return true;
    if (now.kind() == CellKind::kNode)
      links.insert(links.end(), {now.children()[1].link(), now.children()[0].link()});
  }
  return false;
}

}  // namespace

CellSupply::CellSupply(const Scene& scene, const CellTree& tree, bool doubles, int threads)
    : scene_(scene), tree_(tree), doubles_(doubles), workers_(threads), refiners_(workers_) {
  if (tree_.root == nullptr) return;
  flat_.root = kOpenPlace;
}

bool CellSupply::is_open() const {
  return flat_.root == kOpenPlace && tree_.root->link().kind() == CellKind::kOpen;
}

const Cell& CellSupply::cell_in(TreePlace place) const {
  if (place.parent == kNoChild) return *tree_.root;
  return flat_.nodes[place.parent].cells[place.side];
}

void CellSupply::follow() {
  const uint64_t moves = tree_.refiner_pool->moves();
  if (moves == moves_) return;
  std::vector<Followed> items{{{}, moves_}};
  while (!items.empty()) {
    Followed now = items.back();
    items.pop_back();
    follow(now);
    const uint32_t what = flat_.at(now.place);
    if (!is_node(what) || pair_of(*flat_.nodes[what].cells).changed <= now.moves) continue;
    for (const uint32_t side : {1u, 0u}) items.push_back({{what, side}, now.moves});
  }
  moves_ = moves;
}

/// Puts into a place what the cell is there now, if that has been known before.
void CellSupply::follow(Followed& at) {
  const CellLink link = cell_in(at.place).link();
  uint32_t& what = flat_.at(at.place);
  const void* was = nullptr;
  if (is_node(what)) was = flat_.nodes[what].cells;
  if (is_cell(what)) was = flat_.leaves[what & ~kCellBit];
  const void* const is = has_place(link.kind()) ? link.target() : nullptr;
  if (was == is && was != nullptr) return;
  if (was != nullptr) aside_[was] = {what, at.moves};
  const auto known = is != nullptr ? aside_.find(is) : aside_.end();
  if (known != aside_.end()) {
    what = known->second.what;
    at.moves = known->second.moves;
    aside_.erase(known);
  } else if (what != kOpenPlace) {
    what = may_show(link) ? kOpenPlace : kNoChild;
  }
}

Result<CellBatch> CellSupply::at_once(const Sight* sight) {
  if (is_open()) refine_levels(tree_, workers_);
  CellBatch all;
  const auto take = [&](CellBatch batch) {
    all = std::move(batch);
    return true;
  };
  const Status done = deliver(
      sight, kInfinity, [] { return nullptr; }, take);
  if (!done) return done.error();
  return all;
}

Result<CellBatch> CellSupply::refined(const std::vector<OpenCellInSight>& open, const Sight& sight,
                                      std::vector<VisibleCell>& visible) {
  std::vector<Job> jobs;
  for (const OpenCellInSight& cell : open)
    jobs.push_back({&cell_in(cell.place), cell.box, cell.place, 0});
  CellBatch batch;
  std::vector<size_t> ends;
  if (Status done = run(jobs, {&sight, nullptr}, batch, &ends); !done) return done.error();
  std::vector<VisibleCell> all;
  all.reserve(visible.size() + batch.visible.size());
  auto known = visible.cbegin();
  auto added = batch.visible.cbegin();
  for (size_t i = 0; i < open.size(); ++i) {
    const auto known_end = visible.cbegin() + ptrdiff_t(open[i].rank);
    const auto added_end = batch.visible.cbegin() + ptrdiff_t(ends[i]);
    all.insert(all.end(), std::exchange(known, known_end), known_end);
    all.insert(all.end(), std::exchange(added, added_end), added_end);
  }
  all.insert(all.end(), known, visible.cend());
  visible = std::move(all);
  return batch;
}

Status CellSupply::stream(const Sight& sight, double first_batch_ms,
                          const std::function<Solved()>& solved, const Take& take) {
  refine_levels(tree_, workers_);
  return deliver(&sight, first_batch_ms, solved, take);
}

Status CellSupply::deliver(const Sight* sight, double milliseconds,
                           const std::function<Solved()>& solved, const Take& take) {
  std::vector<Job> items, jobs;
  if (tree_.root != nullptr) items.push_back({tree_.root, tree_.region, {}, 0});
  CellBatch batch;
  Stopwatch watch;
  while (!items.empty()) {
    jobs.clear();
    while (!items.empty() && (sight == nullptr || jobs.size() < kJobsAtOnce)) {
      const Job now = items.back();
      items.pop_back();
      const CellLink link = now.cell->link();
      if (link.kind() != CellKind::kNode || now.depth >= kTopSplits) {
        jobs.push_back(now);
        continue;
      }
      const double split = now.cell->split;
      const auto node = uint32_t(flat_.nodes.size());
      flat_.nodes.push_back(
          {.split = split, .cells = link.children(), .axis = uint8_t(link.axis())});
      flat_.at(now.place) = node;
      // What is pushed last comes first.
      const uint32_t first = sight && sight->starts_above(link.axis(), split) ? 1 : 0;
      for (const uint32_t side : {1 - first, first}) {
        Box box = now.box;
        (side == 0 ? box.hi : box.lo)[link.axis()] = split;
        items.push_back({link.children() + side, box, {node, side}, now.depth + 1});
      }
    }
    const Solved hides = solved();
    if (Status done = run(jobs, {sight, hides.get()}, batch); !done) return done;
    if (!items.empty() && (batch.cells.empty() || watch.milliseconds() < milliseconds)) continue;
    batch.is_last = items.empty();
    if (!take(std::exchange(batch, {}))) return Done{};
    milliseconds *= 2;
    watch = {};
  }
  return Done{};
}

Status CellSupply::run(const std::vector<Job>& jobs, const Wanted& wanted, CellBatch& batch,
                       std::vector<size_t>* ends) {
  std::vector<FlatPart> parts(jobs.size());
  std::vector<Status> done(jobs.size(), Status(Done{}));
  workers_.for_parts(jobs.size(), 1, [&](size_t first, size_t last, size_t worker) {
    Refiner& refiner = *refiners_.of(worker, tree_);
    for (size_t i = first; i < last; ++i)
      done[i] = flatten(scene_, *jobs[i].cell, jobs[i].box, wanted, refiner, doubles_, parts[i]);
  });
  for (size_t i = 0; i < jobs.size(); ++i) {
    if (!done[i]) return done[i];
    append(parts[i], jobs[i].place, cell_count_, word_count_, flat_);
    batch.visible.insert(batch.visible.end(), parts[i].visible.begin(), parts[i].visible.end());
    if (ends) ends->push_back(batch.visible.size());
  }
  cell_count_ += uint32_t(flat_.cells.size() / shader::kCellWords);
  word_count_ += uint32_t(flat_.words.size());
  batch.cells.insert(batch.cells.end(), flat_.cells.begin(), flat_.cells.end());
  batch.words.insert(batch.words.end(), flat_.words.begin(), flat_.words.end());
  flat_.cells.clear();
  flat_.words.clear();
  return Done{};
}

}  // namespace whittle
