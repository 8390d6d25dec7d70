#include "notices.h"

#include <algorithm>
#include <utility>

namespace whittle {
namespace {

constexpr double kMilliseconds = 2500;
constexpr size_t kMostLines = 8;

}  // namespace

void Notices::forget() {
  const double now = watch_.milliseconds();
  size_t gone = 0;
  while (gone < until_.size() && until_[gone] <= now) ++gone;
  gone = std::max(gone, lines_.size() - std::min(lines_.size(), kMostLines));
  lines_.erase(lines_.begin(), lines_.begin() + ptrdiff_t(gone));
  until_.erase(until_.begin(), until_.begin() + ptrdiff_t(gone));
}

void Notices::tell(std::string line) {
  lines_.push_back(std::move(line));
  until_.push_back(watch_.milliseconds() + kMilliseconds);
  forget();
}

std::optional<double> Notices::next_change() {
  forget();
  if (until_.empty()) return std::nullopt;
  return std::max(until_.front() - watch_.milliseconds(), 0.0) / 1000;
}

bool Notices::is_empty() {
  forget();
  return error_.empty() && lines_.empty();
}

const std::vector<std::string>& Notices::lines() {
  forget();
  return lines_;
}

}  // namespace whittle
