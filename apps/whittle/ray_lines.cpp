#include "ray_lines.h"

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <optional>
#include <system_error>
#include <utility>

namespace whittle {
namespace {

constexpr size_t kReadBytes = size_t(1) << 18;
/// What is read before rays are cast, bytes, if so much is there.
constexpr size_t kBatchBytes = size_t(1) << 23;
/// No line of six numbers is longer.
constexpr size_t kMostLine = 1 << 12;
constexpr size_t kLinesEach = 512;

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == ',' || c == '\r';
}

struct Line {
  std::string_view text;
  size_t number;
};

Error not_a_ray(size_t line, const std::string& why) {
  return {ErrorKind::kInput, fmt::format("<stdin>:{}: error: {}", line, why)};
}

/// Whether more can be read without waiting.
bool is_ready(int descriptor) {
  pollfd one{descriptor, POLLIN, 0};
  return ::poll(&one, 1, 0) > 0;
}

}  // namespace

Result<Ray> parse_ray(std::string_view text) {
  double numbers[6];
  size_t count = 0;
  const char* at = text.data();
  const char* const end = at + text.size();
  while (true) {
    while (at != end && is_blank(*at)) ++at;
    if (at == end) break;
    double number = 0;
    const auto [next, code] = std::from_chars(at, end, number);
    const bool is_number =
        code == std::errc() && std::isfinite(number) && (next == end || is_blank(*next));
    if (!is_number || count == 6) {
      count = 7;
      break;
    }
    numbers[count++] = number;
    at = next;
  }
  if (count != 6) {
    return Error{ErrorKind::kUsage,
                 "a ray is six numbers, where it starts and which way it goes: x,y,z dx,dy,dz"};
  }
  const Vec3 way = normalize(Vec3{numbers[3], numbers[4], numbers[5]});
  if (way == Vec3{} || !is_finite(way))
    return Error{ErrorKind::kUsage, "the way of a ray must have a length"};
  return Ray{{numbers[0], numbers[1], numbers[2]}, way, 0};
}

Status for_ray_lines(int descriptor, const Workers& workers,
                     const std::function<Status(const std::vector<Ray>&)>& take) {
  std::string text;
  size_t lines_before = 0;
  for (bool is_over = false; !is_over;) {
    do {
      const size_t filled = text.size();
      text.resize(filled + kReadBytes);
      const ssize_t got = ::read(descriptor, text.data() + filled, kReadBytes);
      text.resize(filled + size_t(std::max<ssize_t>(got, 0)));
      if (got < 0 && errno == EINTR) continue;
      if (got < 0) {
        return Error{ErrorKind::kInput, fmt::format("<stdin>: error: cannot be read: {}",
                                                    std::generic_category().message(errno))};
      }
      is_over = got == 0;
    } while (!is_over && text.size() < kBatchBytes && is_ready(descriptor));

    std::vector<Line> lines;
    size_t begin = 0;
    while (begin < text.size()) {
      const size_t end = text.find('\n', begin);
      if (end == std::string::npos && !is_over) break;
      const std::string_view line = std::string_view(text).substr(begin, end - begin);
      ++lines_before;
      if (!std::ranges::all_of(line, is_blank)) lines.push_back({line, lines_before});
      begin = end == std::string::npos ? text.size() : end + 1;
    }
    std::vector<Ray> rays(lines.size());
    std::atomic<size_t> first_bad = lines.size();
    workers.for_parts(lines.size(), kLinesEach, [&](size_t first, size_t last, size_t) {
      for (size_t i = first; i < last; ++i) {
        if (const Result<Ray> ray = parse_ray(lines[i].text)) {
          rays[i] = *ray;
          continue;
        }
        size_t least = first_bad;
        while (i < least && !first_bad.compare_exchange_weak(least, i)) {
        }
        return;
      }
    });
    rays.resize(first_bad);
    if (Status taken = rays.empty() ? Status(Done{}) : take(rays); !taken) return taken;
    if (first_bad < lines.size()) {
      const Line& bad = lines[first_bad];
      return not_a_ray(bad.number, parse_ray(bad.text).error().message);
    }
    text.erase(0, begin);
    if (text.size() > kMostLine)
      return not_a_ray(lines_before + 1, "the line is too long for a ray");
  }
  return Done{};
}

}  // namespace whittle
