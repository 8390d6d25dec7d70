#include "limits.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <string_view>
#include <utility>
#include <vector>

#include "base/limit_hint.h"
#include "option_group.h"
#include "statistics.h"

namespace whittle {
namespace {

constexpr const char* kOption = "--limit";

// What numbers of 32 bits hold, with room to spare.
constexpr int64_t kMost = 1'000'000'000;

// Below this not even the threads can be started.
constexpr uint64_t kLeastMemory = uint64_t(64) << 20;

uint64_t parse_memory(const std::string& text) {
  const uint64_t bytes = parse_bytes(kOption, text, kMostMemory);
  if (bytes < kLeastMemory) {
    refuse(kOption, fmt::format("memory must be at least {}M, not {}", kLeastMemory >> 20, text));
  }
  return bytes;
}

void set(ReadLimits& limits, const std::string& text) {
  const size_t equals = text.find('=');
  const std::string name = text.substr(0, equals);
  const std::string value = equals == std::string::npos ? "" : text.substr(equals + 1);
  const auto count = [&](int64_t most) { return size_t(parse_count(kOption, value, 1, most)); };
  if (name == "bytes") {
    limits.bytes = size_t(parse_bytes(kOption, value, kMostTextBytes));
  } else if (name == "depth") {
    limits.depth = count(kMost);
  } else if (name == "nodes") {
    limits.nodes = count(kMost);
  } else if (name == "values") {
    limits.values = count(kMost);
  } else if (name == "facets") {
    limits.facets = count(kMost);
  } else if (name == "memory") {
    limit_memory(parse_memory(value));
  } else {
    refuse(kOption, fmt::format("unknown limit '{}'; there are: bytes, depth, nodes, values, "
                                "facets, memory; as in {} depth=1000",
                                name, kOption));
  }
}

}  // namespace

uint64_t parse_bytes(const char* option, const std::string& text, uint64_t most) {
  constexpr std::string_view kUnits = "KMG";
  const size_t unit = text.empty() ? std::string_view::npos : kUnits.find(text.back());
  const bool has_unit = unit != std::string_view::npos;
  const std::string_view digits = std::string_view(text).substr(0, text.size() - size_t(has_unit));
  const int shift = has_unit ? 10 * int(unit + 1) : 0;
  return uint64_t(parse_count(option, digits, 1, int64_t(most >> shift))) << shift;
}

void add_limit_option(CLI::App& app, ReadLimits& limits) {
  const ReadLimits defaults;
  OptionGroup(app, "Machine")
      .add_each(kOption, "NAME=VALUE",
                fmt::format("what is too much; and --limit again for more:\n"
                            "bytes={}, depth={}, nodes={},\n"
                            "values={} (of one statement), facets={},\n"
                            "memory=SIZE (what the machine has);\n"
                            "of bytes and memory also as in 100K, 100M, 2G",
                            defaults.bytes, defaults.depth, defaults.nodes, defaults.values,
                            defaults.facets),
                [&limits](const std::string& text) { set(limits, text); });
}

Result<Read> with_limit_option(Result<Read> read) {
  const auto name_option = [](std::string& message) {
    for (const char* limit : {"bytes", "depth", "nodes", "values", "facets"}) {
      const std::string hint = limit_hint(limit);
      const size_t at = message.find(hint);
      if (at == std::string::npos) continue;
      message.replace(at, hint.size(), fmt::format("; {} {}=N raises it", kOption, limit));
    }
  };
  if (!read) {
    std::string message = read.error().message;
    name_option(message);
    return Error{read.error().kind, std::move(message)};
  }
  name_option(read->refusal);
  for (std::string& warning : read->warnings) name_option(warning);
  return read;
}

void limit_memory(uint64_t bytes) {
#if !defined(WHITTLE_SANITIZED)
  rlimit limit{};
  ::getrlimit(RLIMIT_DATA, &limit);
  limit.rlim_cur = std::min<rlim_t>(bytes, limit.rlim_max);
  ::setrlimit(RLIMIT_DATA, &limit);
#else
  (void)bytes;
#endif
}

uint64_t memory_limit() {
  rlimit limit{};
  ::getrlimit(RLIMIT_DATA, &limit);
  return std::min<uint64_t>(limit.rlim_cur, physical_memory());
}

uint64_t physical_memory() {
  return uint64_t(::sysconf(_SC_PHYS_PAGES)) * uint64_t(::sysconf(_SC_PAGESIZE));
}

std::string out_of_memory() {
  rlimit ours{}, around{};
  ::getrlimit(RLIMIT_DATA, &ours);
  ::getrlimit(RLIMIT_AS, &around);
  if (around.rlim_cur <= ours.rlim_cur && around.rlim_cur != RLIM_INFINITY) {
    return fmt::format("out of memory: the limit of the shell (ulimit -v) is {}",
                       describe_bytes(around.rlim_cur));
  }
  if (ours.rlim_cur == RLIM_INFINITY) return "out of memory";
  return fmt::format("out of memory: the limit is {}; --limit memory=SIZE raises it",
                     describe_bytes(ours.rlim_cur));
}

}  // namespace whittle
